#include "campaign/execute/packing_run.hpp"

#include "campaign/layer.hpp"
#include "campaign/state/case_state.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/time.hpp"
#include "core/version.hpp"
#include "engine/outcome.hpp"
#include "measure/cycle_series.hpp"

#include <cmath>

#include <boost/asio/post.hpp>
#include <fmt/format.h>

namespace vibrotrough::campaign {
namespace {

/// The balance of momentum over whole cycles is exact up to the integrator; 1e-5 was seen.
constexpr double balance_tolerance = 0.002;

PackingOutcome wrong_weight(double force, double weight) {
    return {false, "wrong-weight",
            fmt::format("the layer presses with {:.4g} N on the trough over the cycles, less its gain of "
                        "momentum; its weight is {:.4g} N",
                        force, weight)};
}

/// What an earlier run left behind. (The folder itself stays: to make a new one costs more than to look.)
void remove_content(std::filesystem::path const& folder) {
    std::vector<std::filesystem::path> left;
    std::error_code ignored;
    for (auto const& entry : std::filesystem::directory_iterator(folder, ignored))
        left.push_back(entry.path());
    for (std::filesystem::path const& path : left) std::filesystem::remove_all(path, ignored);
}

/// The packing's folder holds its settled packing, so that the deck runs there by hand.
void link_file(std::filesystem::path const& from, std::filesystem::path const& to) {
    std::error_code failure;
    std::filesystem::create_hard_link(from, to, failure);
    if (!failure) return;
    std::filesystem::copy_file(from, to, std::filesystem::copy_options::overwrite_existing, failure);
    if (failure) {
        throw core::MissingError(fmt::format("cannot copy {} to {} ({}); check the disk", from.string(),
                                             to.string(), failure.message()));
    }
}

}  // namespace

PackingRun::PackingRun(boost::asio::io_context& context, engine::Engine const& engine,
                       SettledPackings& settled, PlannedCase const& planned, int packing,
                       std::function<void(PackingOutcome const&)> on_end)
    : context_(context),
      engine_(engine),
      settled_(settled),
      planned_(planned),
      packing_(packing),
      on_end_(std::move(on_end)),
      folder_(planned.packing_folder(packing)),
      deck_(deck::make_deck(planned.scenario, packing)),
      start_(std::chrono::steady_clock::now()),
      started_(core::utc_now()),
      engine_certificate_(std::filesystem::is_regular_file(planned.certificate_file())
                              ? core::read_file(planned.certificate_file())
                              : std::string()) {
    if (auto const checkpoint = read_checkpoint(folder_, deck_)) {
        cut_outputs(folder_, deck_, *checkpoint);
        start_engine(checkpoint);
        return;
    }
    // From now on the packing is seen as under way.
    core::make_folder(folder_);
    settled_.obtain(deck_, [this, alive = std::weak_ptr<bool>(alive_)](Settled const& made) {
        if (!alive.expired()) start_on(made);
    });
}

PackingRun::~PackingRun() = default;

void PackingRun::start_on(Settled const& settled) {
    if (!settled.well || interrupted_) {
        // Posted: whoever is told may destroy this run.
        PackingOutcome const outcome = interrupted_
                                           ? PackingOutcome{false, "interrupted", "the run was interrupted"}
                                           : PackingOutcome{false, settled.outcome, settled.message};
        boost::asio::post(context_, [on_end = on_end_, alive = std::weak_ptr<bool>(alive_), outcome] {
            if (!alive.expired()) on_end(outcome);
        });
        return;
    }
    remove_content(folder_);
    deck::write_deck(deck_, folder_, engine_.ranks);
    link_file(settled.restart, folder_ / deck::settled_file);
    start_engine({});
}

void PackingRun::start_engine(std::optional<Checkpoint> const& checkpoint) {
    engine::Launch launch{deck::drive_file, {}};
    if (checkpoint) {
        launch.arguments = {"-var", "start", checkpoint->file,
                            "-var", "done",  std::to_string(checkpoint->cycle)};
        started_ = checkpoint->started;
        earlier_wall_time_ = checkpoint->wall_time;
        sealed_cycle_ = checkpoint->cycle;
        // Perhaps on another number of ranks than before.
        deck::write_files(deck::for_ranks(deck_.files, engine_.ranks), folder_);
    }
    start_ = std::chrono::steady_clock::now();
    process_ = std::make_unique<engine::EngineProcess>(
        context_, engine_, folder_, [this](engine::ExitStatus status) { on_end_(judge(status)); }, launch);
}

double PackingRun::wall_time() const {
    return earlier_wall_time_ +
           std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void PackingRun::seal() {
    auto const cycle = last_checkpoint(folder_);
    if (!cycle || *cycle <= sealed_cycle_) return;
    seal_checkpoint(folder_, deck_, {*cycle, deck::checkpoint_file(*cycle), started_, wall_time()});
    sealed_cycle_ = *cycle;
}

void PackingRun::look() {
    if (!process_) return;  // the packing is still settling
    seal();
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
    } catch (core::InputError const&) {
        return;  // judged when the engine has ended
    }
    core::replace_file(folder_ / deck::control_file, deck::control_stop);
    told_to_end_ = true;
}

void PackingRun::interrupt() {
    interrupted_ = true;
    if (process_) {
        process_->terminate();
    } else {
        settled_.interrupt();
    }
}

PackingOutcome PackingRun::judge(engine::ExitStatus status) {
    // By hand the deck runs on as far as max_cycles.
    if (told_to_end_) core::replace_file(folder_ / deck::control_file, deck::control_go_on);
    if (interrupted_) return {false, "interrupted", "the run was interrupted"};
    engine::RunReport const report = engine::examine_run(folder_, status, engine::Stage::driving);
    if (report.outcome != engine::Outcome::completed)
        return {false, to_string(report.outcome), report.message};
    auto const outputs = read_outputs(folder_);
    try {
        PackingOutcome const outcome = judge_outputs(outputs, report.last_step);
        if (!outcome.well) return outcome;
    } catch (core::Error const& error) {
        return {false, "outputs-incomplete", error.what()};
    }
    remove_checkpoints(folder_);
    write_finished_packing(planned_, packing_, measured_->run, outputs);
    return {true, {}, {}};
}

/// What the case's result needs must be there now; later it would be too late to run again.
PackingOutcome PackingRun::judge_outputs(PackingOutputs const& outputs, long last_step) {
    scenario::Scenario const& scenario = planned_.scenario;
    auto const series =
        measure::parse_cycles(outputs.cycles, deck_.time.steps_per_cycle, scenario.layer.grains);
    if (static_cast<long>(series.cycles()) * deck_.time.steps_per_cycle != last_step) {
        return {false, "outputs-incomplete",
                fmt::format("cycles.csv holds {} cycles, the engine ended at step {}", series.cycles(),
                            last_step)};
    }
    auto const phases = packing_phases(scenario, deck_, outputs.phases);
    if (phases.cycles() != series.cycles()) {
        return {false, "outputs-incomplete",
                fmt::format("phases.csv holds {} cycles, cycles.csv {}", phases.cycles(), series.cycles())};
    }
    double const carried = measure::weight_by_momentum(series, deck_.mass, 1 / scenario.trough.frequency);
    if (!(std::abs(carried - deck_.weight) <= balance_tolerance * deck_.weight))
        return wrong_weight(carried, deck_.weight);
    measured_ = {{wall_time(), started_, core::utc_now(), std::string(core::program_version()),
                  std::string(core::program_commit()), core::host_name(), engine_certificate_},
                 measure_packing(scenario, deck_, outputs, series, phases)};
    measured_->record.wall_time = measured_->run.wall_time;
    measured_->record.deck = deck::for_ranks(deck_.files, engine_.ranks).at(deck::drive_file);
    return {true, {}, {}};
}

}  // namespace vibrotrough::campaign
