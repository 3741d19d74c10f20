#include "campaign/state/pace.hpp"

#include "campaign/state/case_state.hpp"
#include "campaign/state/checkpoint.hpp"
#include "core/error.hpp"
#include "deck/deck.hpp"
#include "evaluate/packing.hpp"

#include <chrono>
#include <filesystem>

namespace vibrotrough::campaign {
namespace {

namespace fs = std::filesystem;

/// s, between the last changes of two files.
std::optional<double> time_between(fs::path const& first, fs::path const& last) {
    std::error_code missing;
    auto const from = fs::last_write_time(first, missing);
    if (missing) return {};
    auto const to = fs::last_write_time(last, missing);
    if (missing || to <= from) return {};
    return std::chrono::duration<double>(to - from).count();
}

std::optional<double> seconds_per_cycle(PlannedCase const& planned, fs::path const& folder, int cycles) {
    if (auto const checkpoint = read_own_checkpoint(folder, planned.prepared->time.steps_per_cycle);
        checkpoint && checkpoint->cycle > 0 && checkpoint->wall_time > 0)
        return checkpoint->wall_time / checkpoint->cycle;
    auto const time = time_between(folder / deck::control_file, folder / "cycles.csv");
    if (!time || cycles == 0) return {};
    return *time / cycles;
}

}  // namespace

std::vector<PackingPace> packings_under_way(PlannedCase const& planned) {
    std::vector<PackingPace> found;
    for (int const packing : started_packings(planned)) {
        fs::path const folder = planned.packing_folder(packing);
        if (evaluate::has_marker(folder)) continue;
        try {
            int const cycles = evaluate::extent_of_run(*planned.prepared, folder).cycles;
            found.push_back({packing, cycles, seconds_per_cycle(planned, folder, cycles)});
        } catch (core::Error const&) {
            found.push_back({packing, 0, {}});  // nothing was written yet
        }
    }
    return found;
}

}  // namespace vibrotrough::campaign
