#include "campaign/packing_run.hpp"

#include "campaign/assemble.hpp"
#include "campaign/case_state.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/time.hpp"
#include "core/version.hpp"
#include "engine/outcome.hpp"
#include "measure/cycle_series.hpp"

#include <cmath>

#include <fmt/format.h>

namespace vibrotrough::campaign {
namespace {

/// A layer that is called settled still trembles: its kinetic energy is below 1e-7 m g d, its force was seen
/// within 0.4 % of its weight (20 packings of 20 to 500 grains; 2.5 % below 1e-5 m g d).
constexpr double rest_tolerance = 0.02;

/// The balance of momentum over whole cycles is exact up to the integrator; 1e-5 was seen.
constexpr double balance_tolerance = 0.002;

PackingOutcome wrong_weight(char const* when, double force, double weight) {
    return {false, "wrong-weight",
            fmt::format("the layer presses with {:.4g} N on the trough {}, its weight is {:.4g} N", force,
                        when, weight)};
}

}  // namespace

PackingRun::PackingRun(boost::asio::io_context& context, engine::Engine const& engine,
                       PlannedCase const& planned, int packing,
                       std::function<void(PackingOutcome const&)> on_end)
    : planned_(planned),
      packing_(packing),
      folder_(planned.packing_folder(packing)),
      deck_(deck::make_deck(planned.scenario, packing)),
      started_(utc_now()) {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
    deck::write_deck(deck_, folder_);
    process_ = std::make_unique<engine::EngineProcess>(
        context, engine, folder_,
        [this, on_end = std::move(on_end)](engine::ExitStatus status) { on_end(judge(status)); });
}

void PackingRun::look() {
    std::error_code missing;
    auto const size = std::filesystem::file_size(folder_ / "cycles.csv", missing);
    if (missing || size == seen_size_ || told_to_end_) return;
    seen_size_ = size;
    try {
        auto const series = measure::read_cycles(folder_ / "cycles.csv", deck_.time.steps_per_cycle,
                                                 planned_.scenario.layer.grains);
        cycles_ = series.cycles();
        if (cycles_ >= 2) estimate_ = estimate_series(planned_.scenario, series).estimate;
        if (!enough_cycles(planned_.scenario, series)) return;
    } catch (InputError const&) {
        return;  // judged when the engine has ended
    }
    write_file_atomically(folder_ / deck::control_file, deck::control_stop);
    told_to_end_ = true;
}

void PackingRun::interrupt() {
    interrupted_ = true;
    process_->terminate();
}

PackingOutcome PackingRun::judge(engine::ExitStatus status) {
    // By hand the deck runs on as far as max_cycles.
    write_file_atomically(folder_ / deck::control_file, deck::control_go_on);
    if (interrupted_) return {false, "interrupted", "the run was interrupted"};
    engine::RunReport const report = engine::examine_run(folder_, status);
    if (report.outcome != engine::Outcome::completed)
        return {false, to_string(report.outcome), report.message};
    double const weight = deck_.weight;
    if (std::abs(report.settled_force - weight) > rest_tolerance * weight) {
        return wrong_weight("at rest", report.settled_force, weight);
    }
    try {
        auto const series = measure::read_cycles(folder_ / "cycles.csv", deck_.time.steps_per_cycle,
                                                 planned_.scenario.layer.grains);
        if (static_cast<long>(series.cycles()) * deck_.time.steps_per_cycle != report.last_step) {
            return {false, "outputs-incomplete",
                    fmt::format("cycles.csv holds {} cycles, the engine ended at step {}", series.cycles(),
                                report.last_step)};
        }
        double const carried =
            measure::weight_by_momentum(series, deck_.mass, 1 / planned_.scenario.trough.frequency);
        if (!(std::abs(carried - weight) <= balance_tolerance * weight)) {
            return wrong_weight("over the cycles, less its gain of momentum,", carried, weight);
        }
    } catch (Error const& error) {
        return {false, "outputs-incomplete", error.what()};
    }
    std::chrono::duration<double> const wall = std::chrono::steady_clock::now() - start_;
    write_finished_packing(planned_, packing_,
                           {wall.count(), started_, utc_now(), std::string(program_version()),
                            std::string(program_commit()), host_name()});
    return {true, {}, {}};
}

}  // namespace vibrotrough::campaign
