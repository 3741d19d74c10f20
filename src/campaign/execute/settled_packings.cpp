#include "campaign/execute/settled_packings.hpp"

#include "campaign/state/file_lock.hpp"
#include "campaign/state/notes.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/time.hpp"
#include "deck/deck.hpp"
#include "deck/estimates.hpp"
#include "engine/run_report.hpp"
#include "engine/sole_writer.hpp"

#include <cmath>
#include <optional>
#include <regex>
#include <set>

#include <boost/asio/post.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace vibrotrough::campaign {
namespace {

namespace fs = std::filesystem;

constexpr char const* seal_file = "settled.json";

/// Whether the engine wrote the settled packing. An empty file is what a full disk or a killed copy leaves.
bool has_restart(fs::path const& folder) {
    std::error_code missing;
    fs::path const file = folder / deck::settled_file;
    return fs::is_regular_file(file, missing) && fs::file_size(file, missing) > 0;
}

/// Whether the folder holds the packing of this deck, sealed, and still what it was. A packing that was
/// copied here from elsewhere has a whole seal, but not the deck.
bool is_whole(fs::path const& folder, deck::Deck const& deck) {
    try {
        if (!fs::is_regular_file(folder / seal_file) || !has_restart(folder)) return false;
        if (deck::read_files(folder, deck.settle_files) != deck.settle_files) return false;
        return parse_settled(core::read_file(folder / seal_file, core::largest_note)) ==
               core::sha256_hex(core::read_file(folder / deck::settled_file));
    } catch (core::Error const&) {
        return false;
    }
}

PackingEnd judge(fs::path const& folder, engine::ExitStatus status, double weight, double tolerance) {
    engine::RunReport const report = engine::examine_run(folder, status, engine::Stage::settling);
    if (report.failure) return {report.failure, report.message, report.signal};
    if (!has_restart(folder)) {
        return {core::Outcome::outputs_incomplete,
                fmt::format("the engine left no {}, or an empty one; is the disk full?", deck::settled_file)};
    }
    if (std::abs(report.settled_force - weight) > tolerance * weight) {
        return {core::Outcome::wrong_weight,
                fmt::format("the layer at rest presses on the trough with {:.4g} N; it weighs {:.4g} N",
                            report.settled_force, weight)};
    }
    core::note::Json const seal{
        {"floor_force_N", report.settled_force},
        {"weight_N", weight},
        {"restart_sha256", core::sha256_hex(core::read_file(folder / deck::settled_file))}};
    core::write_file_atomically(folder / seal_file, seal.dump(2) + "\n");
    return {};
}

/// Puts the finished folder in its place, unless another driver was faster. What lies there and is whole is
/// never taken away, because another process may use it already.
void publish(fs::path const& made, fs::path const& place, deck::Deck const& deck) {
    std::error_code taken;
    fs::rename(made, place, taken);  // fails unless the place is free
    if (!taken) return;
    if (!is_whole(place, deck)) {
        fs::remove_all(place);
        fs::rename(made, place);
    }
    fs::remove_all(made);
}

/// The file that whoever settles a packing in this folder holds locked.
fs::path lock_of(fs::path const& folder) {
    return folder.native() + ".lock";
}

}  // namespace

/// A packing that the engine is settling, and what waits for it.
struct SettledPackings::Settling {
    fs::path folder;
    FileLock lock;
    deck::Deck deck = {};
    double weight = 0;     ///< N
    double tolerance = 0;  ///< deck::rest_tolerance()
    std::vector<Ready> waiting = {};
    bool interrupted = false;
    std::unique_ptr<engine::EngineProcess> process = {};
};

std::string packing_key(deck::Deck const& deck, std::string const& engine_version) {
    return core::sha256_hex(engine_version + "\n" + deck::digest_of(deck.settle_files)).substr(0, 12);
}

SettledPackings::SettledPackings(boost::asio::io_context& context, engine::Engine const& engine,
                                 fs::path const& campaign_folder)
    : context_(context), engine_(engine), folder_(campaign_folder / "packings") {}

SettledPackings::~SettledPackings() = default;

void SettledPackings::obtain(deck::Deck const& deck, prepare::PreparedCase const& prepared, Ready ready) {
    std::string const key = packing_key(deck, engine_.version);
    if (auto const found = settling_.find(key); found != settling_.end()) {
        found->second->waiting.push_back(std::move(ready));
        return;
    }
    if (fs::path const place = folder_ / key; is_whole(place, deck)) {
        boost::asio::post(context_, [ready = std::move(ready), restart = place / deck::settled_file] {
            ready({}, restart);
        });
        return;
    }
    auto settling = begin(key);
    settling->deck = deck;
    settling->weight = prepared.settled_weight;
    settling->tolerance = deck::rest_tolerance(prepared);
    settling->waiting.push_back(std::move(ready));
    fs::remove_all(settling->folder);
    deck::write_files(deck::for_ranks(deck.settle_files, engine_.ranks), settling->folder);
    settling->process = std::make_unique<engine::EngineProcess>(
        context_, engine_, settling->folder, [this, key](engine::ExitStatus status) { ended(key, status); },
        engine::Launch{deck::settle_file, {}});
    settling_.emplace(key, std::move(settling));
}

/// A folder of this process alone. On a cluster, machines may have the same name.
std::unique_ptr<SettledPackings::Settling> SettledPackings::begin(std::string const& key) const {
    core::make_folder(folder_);
    for (int i = 1;; ++i) {
        fs::path const folder =
            folder_ / fmt::format("{}.settling-{}-{}-{}", key, core::host_name(), ::getpid(), i);
        if (auto lock = FileLock::take(lock_of(folder)))
            return std::make_unique<Settling>(Settling{folder, std::move(*lock)});
    }
}

void SettledPackings::remove_leftovers() {
    std::set<fs::path> leftovers;
    std::error_code missing;
    for (auto const& entry : fs::directory_iterator(folder_, missing)) {
        // 12 hexadecimal digits, machine and numbers; the folder or its lock.
        static std::regex const form("([0-9a-f]{12}\\.settling-.+-[0-9]+)(\\.lock)?");
        std::string const name = entry.path().filename().string();
        if (std::smatch found; std::regex_match(name, found, form))
            leftovers.insert(folder_ / found[1].str());
    }
    for (fs::path const& leftover : leftovers) {
        // A task of a cluster may be settling there now, or what the engine of a killed one had started.
        auto const lock = FileLock::take(lock_of(leftover));
        if (!lock || engine::has_writer(leftover)) continue;
        fs::remove_all(leftover);
        fs::remove(lock_of(leftover));
    }
}

void SettledPackings::interrupt() {
    for (auto& [key, settling] : settling_) {
        settling->interrupted = true;
        if (settling->process) settling->process->terminate();
    }
}

void SettledPackings::ended(std::string const& key, engine::ExitStatus status) {
    // Whoever is told may ask for the next packing: the entry is gone by then.
    std::shared_ptr<Settling> const settling = std::move(settling_.at(key));
    settling_.erase(key);
    boost::asio::post(context_, [settling] {});  // the process is in the middle of its own call
    PackingEnd end{core::Outcome::interrupted, "the settling was interrupted"};
    if (!settling->interrupted) require_unchanged(engine_);
    try {
        if (!settling->interrupted)
            end = judge(settling->folder, status, settling->weight, settling->tolerance);
    } catch (core::DiskFullError const& error) {
        end = {core::Outcome::disk_full, error.what()};
    }
    if (!end.failure) {
        publish(settling->folder, folder_ / key, settling->deck);
    } else if (settling->interrupted || end.failure == core::Outcome::disk_full) {
        fs::remove_all(settling->folder);
    } else {
        // Kept for whoever wants to see why, in place of an earlier failure.
        fs::path const kept = folder_ / (key + ".failed");
        fs::remove_all(kept);
        fs::rename(settling->folder, kept);
        end.message += fmt::format(" (see {})", (kept / engine::output_file).string());
    }
    fs::remove(lock_of(settling->folder));
    for (Ready const& ready : settling->waiting) ready(end, folder_ / key / deck::settled_file);
}

}  // namespace vibrotrough::campaign
