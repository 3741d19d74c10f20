#include "campaign/execute/settled_packings.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "engine/outcome.hpp"

#include <cmath>
#include <optional>

#include <boost/asio/post.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace vibrotrough::campaign {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// A layer that is called settled still trembles: its kinetic energy is below 1e-7 m g d, its force was seen
/// within 0.4 % of its weight (20 packings of 20 to 500 grains; 2.5 % below 1e-5 m g d).
constexpr double rest_tolerance = 0.02;

constexpr char const* seal_file = "settled.json";

/// Whether the folder holds a packing that was sealed and is still what it was.
bool is_whole(fs::path const& folder) {
    try {
        if (!fs::is_regular_file(folder / seal_file) || !fs::is_regular_file(folder / deck::settled_file))
            return false;
        Json const seal = Json::parse(core::read_file(folder / seal_file));
        return seal.at("restart_sha256") == core::sha256_hex(core::read_file(folder / deck::settled_file));
    } catch (Json::exception const&) {
        return false;
    } catch (core::Error const&) {
        return false;
    }
}

Settled judge(fs::path const& folder, engine::ExitStatus status, double weight) {
    engine::RunReport const report = engine::examine_run(folder, status, engine::Stage::settling);
    if (report.outcome != engine::Outcome::completed)
        return {false, to_string(report.outcome), report.message, {}};
    if (!fs::is_regular_file(folder / deck::settled_file))
        return {false, "outputs-incomplete", "the engine left no settled.restart; is the disk full?", {}};
    if (std::abs(report.settled_force - weight) > rest_tolerance * weight) {
        return {false,
                "wrong-weight",
                fmt::format("the layer presses with {:.4g} N on the trough at rest, its weight is {:.4g} N",
                            report.settled_force, weight),
                {}};
    }
    Json const seal{{"floor_force_N", report.settled_force},
                    {"weight_N", weight},
                    {"restart_sha256", core::sha256_hex(core::read_file(folder / deck::settled_file))}};
    core::write_file_atomically(folder / seal_file, seal.dump(2) + "\n");
    return {true, {}, {}, folder / deck::settled_file};
}

/// Puts the finished folder in its place, unless another driver was faster.
void publish(fs::path const& made, fs::path const& place) {
    if (is_whole(place)) {
        fs::remove_all(made);
        return;
    }
    fs::remove_all(place);
    std::error_code failure;
    fs::rename(made, place, failure);
    if (failure && !is_whole(place)) {
        throw core::MissingError(fmt::format("cannot put the settled packing in {} ({}); check the disk",
                                             place.string(), failure.message()));
    }
    fs::remove_all(made);
}

}  // namespace

/// A packing that the engine is settling, and who waits for it.
struct SettledPackings::Making {
    fs::path folder;
    double weight;
    std::vector<Ready> waiting;
    bool interrupted = false;
    std::unique_ptr<engine::EngineProcess> process;
};

std::string packing_key(deck::Deck const& deck, std::string const& engine_version) {
    std::string all = engine_version;
    for (auto const& [name, content] : deck.settle_files) all += name + content;
    return core::sha256_hex(all).substr(0, 12);
}

SettledPackings::SettledPackings(boost::asio::io_context& context, engine::Engine const& engine,
                                 fs::path const& campaign_folder)
    : context_(context), engine_(engine), folder_(campaign_folder / "packings") {}

SettledPackings::~SettledPackings() = default;

void SettledPackings::obtain(deck::Deck const& deck, Ready ready) {
    std::string const key = packing_key(deck, engine_.version);
    if (auto const found = making_.find(key); found != making_.end()) {
        found->second->waiting.push_back(std::move(ready));
        return;
    }
    if (is_whole(folder_ / key)) {
        boost::asio::post(context_, [ready = std::move(ready), restart = folder_ / key / deck::settled_file] {
            ready({true, {}, {}, restart});
        });
        return;
    }
    auto making = std::make_unique<Making>();
    making->folder = folder_ / fmt::format("{}.making-{}", key, ::getpid());
    making->weight = deck.weight;
    making->waiting.push_back(std::move(ready));
    fs::remove_all(making->folder);
    deck::write_files(deck::for_ranks(deck.settle_files, engine_.ranks), making->folder);
    making->process = std::make_unique<engine::EngineProcess>(
        context_, engine_, making->folder, [this, key](engine::ExitStatus status) { ended(key, status); },
        engine::Launch{deck::settle_file, {}});
    making_.emplace(key, std::move(making));
}

void SettledPackings::remove_leftovers() {
    std::vector<fs::path> leftovers;
    std::error_code missing;
    for (auto const& entry : fs::directory_iterator(folder_, missing)) {
        if (entry.path().filename().string().find(".making-") != std::string::npos)
            leftovers.push_back(entry.path());
    }
    for (fs::path const& leftover : leftovers) fs::remove_all(leftover);
}

void SettledPackings::interrupt() {
    for (auto& [key, making] : making_) {
        making->interrupted = true;
        making->process->terminate();
    }
}

void SettledPackings::ended(std::string const& key, engine::ExitStatus status) {
    // Whoever is told may ask for the next packing: the entry is gone by then.
    std::shared_ptr<Making> const making = std::move(making_.at(key));
    making_.erase(key);
    boost::asio::post(context_, [making] {});  // the process is in the middle of its own call
    Settled settled{false, "interrupted", "the settling was interrupted", {}};
    if (!making->interrupted) settled = judge(making->folder, status, making->weight);
    if (settled.well) {
        publish(making->folder, folder_ / key);
        settled.restart = folder_ / key / deck::settled_file;
    } else if (making->interrupted) {
        fs::remove_all(making->folder);
    } else {
        // Kept for whoever wants to see why, in place of an earlier failure.
        fs::path const kept = folder_ / (key + ".failed");
        fs::remove_all(kept);
        fs::rename(making->folder, kept);
        settled.message += fmt::format(" (see {})", (kept / engine::output_file).string());
    }
    for (Ready const& ready : making->waiting) ready(settled);
}

}  // namespace vibrotrough::campaign
