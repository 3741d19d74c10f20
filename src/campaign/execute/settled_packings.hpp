#pragma once

#include "core/outcome.hpp"
#include "deck/deck.hpp"
#include "engine/engine.hpp"

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace vibrotrough::campaign {

/// How a packing's run ended.
struct PackingEnd {
    std::optional<core::Outcome> failure;  ///< none when the packing is finished and marked so, or settled
    std::string message;                   ///< of a failure
    int signal = 0;                        ///< that killed the engine; 0 when none did
};

/// The campaign's settled packings, each made once and used by all cases that share grains, layer and trough:
/// packings/KEY/, the key a hash of the commands of the settling deck and of the engine's version. Each is
/// made in a folder of its own and appears by rename, so that several drivers may make them at the same time.
class SettledPackings {
  public:
    /// Deck and engine must outlive the calls they are given to.
    SettledPackings(boost::asio::io_context& context, engine::Engine const& engine,
                    std::filesystem::path const& campaign_folder);
    ~SettledPackings();

    /// Receives how the settling ended, and if it did well the file with the settled packing.
    using Ready = std::function<void(PackingEnd const& end, std::filesystem::path const& restart)>;

    /// Calls `ready` once, from the context, when the packing is there: soon if it was made before, whole and
    /// undamaged, else after the engine has settled it. Asked twice for one packing, the engine runs once.
    /// @throws MissingError when the disk refuses or the engine cannot be started
    /// @param prepared  the case of the deck
    void obtain(deck::Deck const& deck, prepare::PreparedCase const& prepared, Ready ready);

    /// Removes what killed drivers left half made. For a driver that is alone in the folder.
    void remove_leftovers();

    /// Ends all settling soon; whoever waits is told "interrupted".
    void interrupt();

  private:
    struct Settling;
    std::unique_ptr<Settling> begin(std::string const& key) const;
    void ended(std::string const& key, engine::ExitStatus status);

    boost::asio::io_context& context_;
    engine::Engine const& engine_;
    std::filesystem::path folder_;
    std::map<std::string, std::unique_ptr<Settling>> settling_;
};

/// The key of a deck's settled packing: 12 hexadecimal digits.
std::string packing_key(deck::Deck const& deck, std::string const& engine_version);

}  // namespace vibrotrough::campaign
