#include "store/stage_quantities.hpp"

#include "measure/stage_means.hpp"

#include <optional>

namespace vibrotrough::store {
namespace {

using Case = CaseRecord const&;
using scenario::Stage;

bool has_stages(Case record) {
    return !record.scenario.stages.empty() && !record.packings.empty();
}

/// The mean velocity along the trough in each cycle, m/s. The positions of rigid bodies are not unwrapped,
/// and the grains of an open trough come and go.
std::vector<double> velocity_of(Case record, PackingRecord const& packing,
                                std::vector<double> const& durations) {
    if (is_clump(record.scenario.grains) || is_open(record.scenario)) return packing.series.mean_velocity;
    std::vector<double> velocity;
    for (std::size_t i = 0; i < durations.size(); ++i)
        velocity.push_back((packing.series.x[i + 1] - packing.series.x[i]) / durations[i]);
    return velocity;
}

measure::StagedVelocities velocities_of(Case record, std::vector<Stage> const& stages) {
    measure::StagedVelocities all{cycle_durations(stages), {}};
    for (PackingRecord const& packing : record.packings)
        all.packings.push_back(velocity_of(record, packing, all.durations));
    return all;
}

std::vector<measure::StageMeans> means_of(Case record, std::vector<Stage> const& stages) {
    std::vector<measure::StageCycles> cycles;
    for (Stage const& stage : stages) cycles.push_back({stage.first_cycle, stage.ramp_cycles, stage.cycles});
    return measure_stages(cycles, velocities_of(record, stages), record.scenario.measure.confidence);
}

/// The index of the last stage that moves, or that does not.
std::optional<std::size_t> last_stage(std::vector<Stage> const& stages, bool standstill) {
    for (std::size_t i = stages.size(); i-- > 0;)
        if (stages[i].standstill == standstill) return i;
    return {};
}

/// A column with one number for each stage.
template <typename Of>
std::vector<double> numbers(std::vector<Stage> const& stages, Of const& of) {
    std::vector<double> values;
    for (Stage const& stage : stages) values.push_back(of(stage));
    return values;
}

std::size_t last_end(Stage const& stage) {
    return static_cast<std::size_t>(stage.first_cycle + stage.cycles);
}

/// kg, of an open trough.
double fed_in(measure::OpenSeries const& open, Stage const& stage) {
    return open.fed_mass[last_end(stage)] - open.fed_mass[static_cast<std::size_t>(stage.first_cycle)];
}

double left_in(measure::OpenSeries const& open, Stage const& stage) {
    double mass = 0;
    for (auto i = static_cast<std::size_t>(stage.first_cycle) + 1; i <= last_end(stage); ++i)
        mass += open.left_mass[i];
    return mass;
}

double held_after(measure::OpenSeries const& open, Stage const& stage) {
    return open.held_mass[last_end(stage)];
}

/// Mean and half-width of a number for each stage.
void add_values(std::vector<CaseValues>& columns, std::vector<measure::StageMeans> const& means,
                measure::EnsembleNumber measure::StageMeans::*number, double confidence) {
    MeasuredColumn measured(confidence);
    for (measure::StageMeans const& one : means) measured.add(one.*number);
    measured.put_into(columns);
}

std::vector<CaseValues> stages_values(Case record) {
    if (record.scenario.stages.empty()) return {};
    std::vector<Stage> const all = stages(record.scenario);
    auto const moving = [](Stage const& stage, double value) { return stage.standstill ? 0 : value; };
    std::vector<CaseValues> columns{
        numbers(all, [](Stage const& s) { return s.start; }),
        numbers(all, [](Stage const& s) { return s.time(); }),
        numbers(all, [](Stage const& s) { return s.first_cycle + 1; }),
        numbers(all, [](Stage const& s) { return s.cycles; }),
        numbers(all, [](Stage const& s) { return s.ramp_cycles; }),
        numbers(all, [](Stage const& s) { return s.standstill ? 1 : 0; }),
        numbers(all, [&](Stage const& s) { return moving(s, throw_number(s.trough)); }),
        numbers(all, [](Stage const& s) { return s.trough.frequency; }),
        numbers(all, [&](Stage const& s) { return moving(s, s.trough.amplitude); }),
    };
    if (record.packings.empty()) return columns;
    auto const means = means_of(record, all);
    double const confidence = record.scenario.measure.confidence;
    for (auto const number : {&measure::StageMeans::speed, &measure::StageMeans::change,
                              &measure::StageMeans::distance, &measure::StageMeans::time_to_speed})
        add_values(columns, means, number, confidence);
    if (!is_open(record.scenario)) return columns;
    for (auto const of : {fed_in, left_in, held_after}) {
        MeasuredColumn measured(confidence);
        for (Stage const& stage : all) {
            measure::EnsembleNumber number;
            for (PackingRecord const& packing : record.packings)
                number.values.push_back(of(packing.series.open, stage));
            measured.add(number);
        }
        measured.put_into(columns);
    }
    return columns;
}

std::vector<CaseValues> stage_cycles_values(Case record) {
    if (!has_stages(record)) return {};
    std::vector<Stage> const all = stages(record.scenario);
    measure::StagedVelocities const velocities = velocities_of(record, all);
    std::vector<double> times, numbers;
    MeasuredColumn speeds(record.scenario.measure.confidence);
    double time = 0;
    for (std::size_t i = 0; i < velocities.durations.size(); ++i) {
        times.push_back(time + velocities.durations[i] / 2);
        time += velocities.durations[i];
        measure::EnsembleNumber speed;
        for (auto const& packing : velocities.packings) speed.values.push_back(packing[i]);
        speeds.add(speed);
    }
    for (std::size_t i = 0; i < all.size(); ++i)
        numbers.insert(numbers.end(), static_cast<std::size_t>(all[i].cycles), static_cast<double>(i + 1));
    std::vector<CaseValues> columns{times, numbers};
    speeds.put_into(columns);
    return columns;
}

CaseTable stages_table() {
    std::vector<Entry> entries{
        {"start", "s", "When the stage begins; only of drives with stages"},
        {"time", "s", "How long it is, with its ramp"},
        {"first_cycle", "1", "Number of its first cycle, from 1"},
        {"cycles", "1", "Number of its cycles, with its ramp"},
        {"ramp_cycles", "1", "Number of cycles of its ramp"},
        {"standstill", "1", "1 when the trough stands still, else 0"},
        {"throw_number", "1", "Throw number Gamma behind the ramp; 0 at a standstill"},
        {"frequency", "Hz", "Frequency behind the ramp; at a standstill that of the stage before"},
        {"amplitude", "m", "Amplitude r behind the ramp; 0 at a standstill"},
    };
    add_measured(entries, {"conveying_speed", "m/s",
                           "Mean velocity of the layer along the trough over the second half of the cycles "
                           "behind the ramp, mean over the packings; in an open trough that in the window, 0 "
                           "while it is empty; NaN without such cycles"});
    add_measured(entries, {"speed_change", "m/s",
                           "Mean velocity in the second half of these cycles less that in the first: not 0 "
                           "while the speed is not steady"});
    add_measured(entries,
                 {"distance", "m",
                  "Displacement of the layer along the trough in the whole stage; at a standstill the "
                  "distance in which it stops"});
    add_measured(entries,
                 {"time_to_speed", "s",
                  "Time from the start of the stage until the mean of the packings has gone 95 % of "
                  "the way from the speed before to `conveying_speed`; NaN when the two do not differ"});
    entries.back().meaning = "Half-width of its interval, by the jackknife over the packings";
    add_measured(entries, {"fed_mass", "kg", "What was fed in the stage; only of open troughs"});
    add_measured(entries, {"left_mass", "kg",
                           "What left the trough in the stage; at a standstill what still runs out"});
    add_measured(entries, {"held_mass", "kg", "What the trough holds at the end of the stage"});
    return {"stages", "stages", entries, stages_values};
}

CaseTable stage_cycles_table() {
    std::vector<Entry> entries{
        {"time", "s", "Middle of the cycle after the start of the run; only of drives with stages"},
        {"stage", "1", "Number of its stage, from 1"}};
    add_measured(entries,
                 {"conveying_speed", "m/s",
                  "Mean velocity of the layer along the trough in the cycle, mean over the packings"});
    return {"stage_cycles", "cycles", entries, stage_cycles_values};
}

/// A column of a number in tables for people.
View shown(std::string_view heading, std::string_view format) {
    return {.format = format, .terminal = terminal_when_known(heading), .report = ReportView{heading}};
}

}  // namespace

std::vector<CaseTable> stages_case_tables() {
    return {stages_table(), stage_cycles_table()};
}

void add_stages(CaseRecord& record) {
    if (!has_stages(record)) return;
    std::vector<Stage> const all = stages(record.scenario);
    auto const means = means_of(record, all);
    auto const moving = last_stage(all, false), standing = last_stage(all, true);
    for (std::size_t i = 0; i < record.packings.size(); ++i) {
        PackingRecord& packing = record.packings[i];
        if (moving) from_stored(means[*moving].speed.values[i], packing.stage_speed);
        if (moving) from_stored(means[*moving].time_to_speed.values[i], packing.time_to_speed);
        if (standing) from_stored(means[*standing].distance.values[i], packing.stopping_distance);
    }
}

std::vector<Quantity> stage_quantities() {
    std::vector<Quantity> rows;
    add_measured(
        rows, field(&PackingRecord::stage_speed), {"stage_speed", "stage_speed_half_width"}, "m/s",
        "Speed of the layer at the end of the last stage of the drive in which the trough moves, see "
        "the table stages; NaN without stages",
        shown("stage speed", "{:.4f}"));
    add_measured(
        rows, field(&PackingRecord::time_to_speed), {"time_to_speed", "time_to_speed_half_width"}, "s",
        "Time in this stage until the mean of the packings has gone 95 % of the way to that speed; of "
        "a packing its pseudo-value (jackknife); NaN without stages",
        shown("time to speed", "{:.3f}"));
    rows.back().meaning = "Half-width of the interval of time_to_speed, by the jackknife over the packings";
    add_measured(rows, field(&PackingRecord::stopping_distance),
                 {"stopping_distance", "stopping_distance_half_width"}, "m",
                 "Displacement of the layer along the trough in the last stage in which the trough stands "
                 "still, with its ramp; NaN without one",
                 shown("stopping distance", "{:.5f}"));
    return rows;
}

}  // namespace vibrotrough::store
