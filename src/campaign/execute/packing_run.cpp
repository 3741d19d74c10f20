#include "campaign/execute/packing_run.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/time.hpp"
#include "core/version.hpp"
#include "engine/run_report.hpp"
#include "engine/sole_writer.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include <boost/asio/post.hpp>
#include <fmt/format.h>

namespace vibrotrough::campaign {
namespace {

/// s, for which an engine that was asked to stop may take to end its cycle.
double patience_with(double seconds_per_cycle) {
    return std::max(60.0, 4 * seconds_per_cycle);
}

/// Gives a file a second name, or copies it where the file system knows no hard links.
void link_or_copy(std::filesystem::path const& from, std::filesystem::path const& to) {
    std::error_code failure;
    std::filesystem::create_hard_link(from, to, failure);
    if (failure) std::filesystem::copy_file(from, to);
}

PackingEnd interrupted_end() {
    return {core::Outcome::interrupted, "the run was interrupted"};
}

}  // namespace

PackingRun::PackingRun(boost::asio::io_context& context, engine::Engine const& engine,
                       SettledPackings& settled, PlannedCase const& planned, deck::PackingPlan const& packing,
                       std::function<void(PackingEnd const&)> on_end)
    : context_(context),
      engine_(engine),
      settled_(settled),
      planned_(planned),
      packing_(packing),
      on_end_(std::move(on_end)),
      folder_(planned.packing_folder(packing.number)),
      deck_(deck::make_deck(*planned.prepared, packing)),
      start_(std::chrono::steady_clock::now()),
      started_(core::utc_now()),
      engine_certificate_(std::filesystem::is_regular_file(planned.certificate_file())
                              ? core::read_file(planned.certificate_file(), core::largest_note)
                              : std::string()) {
    engine::make_sole_writer(folder_);
    auto const checkpoint = read_checkpoint(folder_, deck_, planned_.prepared->time.steps_per_cycle);
    if (checkpoint && checkpoint->cycle <= packing_.cycles) {
        cut_outputs(folder_, *checkpoint, planned_.prepared->time.steps_per_cycle);
        continue_from(*checkpoint);
        return;
    }
    begin();
}

void PackingRun::begin() {
    // From now on the packing is seen as under way.
    core::make_folder(folder_);
    settled_.obtain(deck_, *planned_.prepared,
                    [this, alive = std::weak_ptr<bool>(alive_)](PackingEnd const& end, auto const& restart) {
                        if (!alive.expired()) start_on(end, restart);
                    });
}

PackingRun::~PackingRun() = default;

void PackingRun::continue_from(Checkpoint const& checkpoint) {
    if (checkpoint.cycle < packing_.cycles) return start_engine(checkpoint);
    // All cycles are there; only the driver was stopped before it had evaluated them.
    resume(checkpoint);
    long const last_step = static_cast<long>(checkpoint.cycle) * planned_.prepared->time.steps_per_cycle;
    boost::asio::post(context_, [this, last_step, alive = std::weak_ptr<bool>(alive_)] {
        if (alive.expired()) return;
        PackingEnd const end = conclude(last_step);
        if (!end.failure) return on_end_(end);
        // Damaged: as if there were no checkpoint.
        remove_checkpoints(folder_);
        sealed_cycle_ = 0;
        earlier_wall_time_ = earlier_core_time_ = 0;
        begin();
    });
}

/// Takes over what is known of the run up to a checkpoint.
void PackingRun::resume(Checkpoint const& checkpoint) {
    started_ = checkpoint.started;
    earlier_wall_time_ = checkpoint.wall_time;
    earlier_core_time_ = checkpoint.core_time;
    sealed_cycle_ = checkpoint.cycle;
}

void PackingRun::start_on(PackingEnd const& settled, std::filesystem::path const& restart) {
    if (settled.failure || interrupted_) {
        // Posted, because the receiver may destroy this run.
        PackingEnd const outcome = interrupted_ ? interrupted_end() : settled;
        boost::asio::post(context_, [on_end = on_end_, alive = std::weak_ptr<bool>(alive_), outcome] {
            if (!alive.expired()) on_end(outcome);
        });
        return;
    }
    std::filesystem::remove_all(folder_);  // what an earlier run left behind
    deck::write_deck(deck_, folder_, engine_.ranks);
    // The packing's folder holds its settled packing, so that the deck can be run there by hand.
    link_or_copy(restart, folder_ / deck::settled_file);
    has_settled_ = true;
    start_engine({});
}

void PackingRun::start_engine(std::optional<Checkpoint> const& checkpoint) {
    engine::Launch launch{deck::drive_file, {}};
    if (checkpoint) {
        launch.arguments = {"-var", "start", checkpoint->file,
                            "-var", "done",  std::to_string(checkpoint->cycle)};
        resume(*checkpoint);
        // Perhaps on another number of ranks than before.
        deck::write_files(deck::for_ranks(deck_.files, engine_.ranks), folder_);
    }
    stop_ = packing_.next_stop(sealed_cycle_);
    core::replace_file(folder_ / deck::control_file, deck::control_until(stop_));
    start_ = std::chrono::steady_clock::now();
    process_ = std::make_unique<engine::EngineProcess>(
        context_, engine_, folder_,
        [this](engine::ExitStatus status) {
            if (auto const end = judge(status)) on_end_(*end);
        },
        launch);
}

double PackingRun::wall_time() const {
    return earlier_wall_time_ +
           std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

double PackingRun::seconds_per_cycle() const {
    return process_ && cycles_ > 0 ? wall_time() / cycles_ : 0;
}

double PackingRun::core_time() const {
    // What the engine took in the end is known when it has ended.
    double const so_far = core_time_ > 0 || !process_ ? core_time_ : process_->core_time();
    return core_time_of_pauses_ + so_far;
}

void PackingRun::seal() {
    auto const cycle = last_checkpoint(folder_);
    if (!cycle || *cycle <= sealed_cycle_) return;
    seal_checkpoint(folder_, deck_,
                    {*cycle, deck::checkpoint_file(*cycle), started_, wall_time(),
                     earlier_core_time_ + (core_time_ > 0 ? core_time_ : process_->core_time())});
    sealed_cycle_ = *cycle;
}

void PackingRun::inspect() {
    if (!process_) return;  // the packing is still settling
    seal();
    std::error_code missing;
    auto const size = std::filesystem::file_size(folder_ / "cycles.csv", missing);
    auto const now = std::chrono::steady_clock::now();
    if (missing || size == seen_size_) {
        bool const is_stuck =
            now - grown_ > std::chrono::duration<double>(patience_with(seconds_per_cycle()));
        if (interrupted_ && is_stuck) process_->terminate();
        return;
    }
    seen_size_ = size;
    grown_ = now;
    try {
        auto const interim = evaluate::estimate_so_far(*planned_.prepared, folder_);
        cycles_ = interim.cycles;
        if (interim.estimate) estimate_ = interim.estimate;
    } catch (core::Error const&) {
        // Damaged, or larger than is read: judged when the engine has ended.
    }
}

void PackingRun::interrupt(Stop stop) {
    interrupted_ = true;
    grown_ = std::chrono::steady_clock::now();
    if (process_ && stop == Stop::with_checkpoint) {
        core::replace_file(folder_ / deck::control_file, deck::control_at_once());
    } else if (process_) {
        process_->terminate();
    } else {
        settled_.interrupt();
    }
}

/// Continues a run that has paused at its checkpoint; why it cannot, if so.
std::optional<PackingEnd> PackingRun::go_on() {
    seal();
    engine::make_sole_writer(folder_);
    auto const checkpoint = read_checkpoint(folder_, deck_, planned_.prepared->time.steps_per_cycle);
    if (!checkpoint || checkpoint->cycle != stop_) {
        return PackingEnd{core::Outcome::outputs_incomplete,
                          fmt::format("the engine left no checkpoint after cycle {}", stop_)};
    }
    core_time_of_pauses_ += std::exchange(core_time_, 0);
    start_engine(checkpoint);
    return {};
}

std::optional<PackingEnd> PackingRun::judge(engine::ExitStatus status) {
    core_time_ = status.core_time;
    require_unchanged(engine_);
    engine::RunReport const report = engine::examine_run(folder_, status, engine::Stage::driving);
    bool const is_over = interrupted_ || report.failure || stop_ >= packing_.cycles;
    // The policy may want more cycles of this packing, which then continue from its end.
    if (is_over && !report.failure) seal();
    if (interrupted_) return interrupted_end();
    if (report.failure) return PackingEnd{report.failure, report.message, report.signal};
    return is_over ? conclude(report.last_step) : go_on();
}

/// Evaluates what the engine wrote, and marks the packing as finished.
PackingEnd PackingRun::conclude(long last_step) {
    evaluate::PackingFiles files;
    try {
        files = evaluate::read_packing_files(folder_);
    } catch (core::MissingError const& error) {  // too large: the other packings go on
        return {core::Outcome::outputs_incomplete, error.what()};
    }
    auto evaluation = evaluate::evaluate_outputs(*planned_.prepared, packing_.number, files, last_step);
    if (auto const* const fault = std::get_if<evaluate::UnusableOutputs>(&evaluation)) {
        remove_checkpoints(folder_);  // or a later run would only read the same outputs again
        return {fault->outcome, fault->message};
    }
    std::string const deck = deck::for_ranks(deck_.files, engine_.ranks).at(deck::drive_file);
    evaluate::PackingMarker const marker{wall_time(),
                                         started_,
                                         core::utc_now(),
                                         std::string(core::program_version()),
                                         std::string(core::program_commit()),
                                         core::host_name(),
                                         engine_certificate_,
                                         earlier_core_time_ + core_time_,
                                         packing_.start_efficiency,
                                         core::sha256_hex(deck)};
    evaluated_ = {marker, std::get<store::PackingRecord>(std::move(evaluation))};
    evaluate::add_run(evaluated_->record, marker);
    evaluated_->record.deck = deck;
    evaluate::write_marker(files, marker);
    return {};
}

}  // namespace vibrotrough::campaign
