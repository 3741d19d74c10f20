#pragma once

#include "prepare/prepared_case.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>

namespace vibrotrough::campaign {

/// Cases that an older version of the program began in a campaign's folder. Up to version 0.1 a case's id was
/// a hash that included the comments of its deck, so that a reworded comment gave every case another id. Such
/// a folder is recognised, and its case keeps its old id there.
///
/// A folder counts when its name is the hash that the old program computed from the very files that lie in it
/// (scenario.toml, the deck of the first packing) and from the engine's version, and when the commands of
/// that deck are those of today's deck. As soon as today's program writes into such a folder, it leaves a
/// file with the current id there, because the deck that proved the old id is replaced.
class OlderCases {
  public:
    /// Reads nothing before the first case is asked for that has no folder of its own.
    /// @param new_ids  of today's cases; folders with these names are not old ones. Must outlive this object.
    OlderCases(std::filesystem::path const& campaign_folder, std::string const& engine_version,
               std::set<std::string> const& new_ids);

    /// The id of the old folder of a case.
    /// @param id  that the case has in new folders
    /// @return none when the folder `id` exists, or no old folder holds this case
    std::optional<std::string> find(std::string const& id, prepare::PreparedCase const& prepared);

  private:
    void read_folders();

    std::filesystem::path folder_;
    std::string engine_version_;
    std::set<std::string> const& new_ids_;
    bool have_read_ = false;
    std::map<std::string, std::string> ids_by_current_id_;  ///< of folders that today's program wrote into
    std::map<std::string, std::string> ids_by_identity_;  ///< by digest of the commands and measurement plan
};

/// Leaves a case's current id in its old folder. @throws core::MissingError when the disk refuses
void write_current_id(std::filesystem::path const& case_folder, std::string const& current_id);

/// The key that an older version of the program gave to a settled packing: a hash of the engine's version and
/// of the deck with its comments.
std::string older_packing_key(std::map<std::string, std::string> const& settle_files,
                              std::string const& engine_version);

}  // namespace vibrotrough::campaign
