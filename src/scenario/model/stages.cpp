#include "scenario/model/stages.hpp"

#include "core/error.hpp"
#include "scenario/model/scenario.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace vibrotrough::scenario {
namespace {

/// The nearest whole number of cycles; 0 when the number is not finite.
int whole(double cycles) {
    constexpr double most = 1e8;
    return std::isfinite(cycles) ? static_cast<int>(std::lround(std::clamp(cycles, 0.0, most))) : 0;
}

/// The drive of a stage: what it gives replaces what its trough had before.
Trough with_drive(Trough trough, GivenStage const& given) {
    if (given.vibration_angle) {
        trough.vibration_angle = *given.vibration_angle;
        trough.given.tan_vibration_angle.reset();
    }
    if (given.tan_vibration_angle) {
        trough.vibration_angle = std::atan(*given.tan_vibration_angle);
        trough.given.tan_vibration_angle = given.tan_vibration_angle;
    }
    trough.amplitude = given.amplitude.value_or(trough.amplitude);
    trough.along_phase = given.along_phase.value_or(trough.along_phase);
    if (given.waveform) trough.waveform = given.waveform;
    if (given.throw_number || given.machine_number || given.frequency) {
        trough.given.throw_number = given.throw_number;
        trough.given.machine_number = given.machine_number;
        trough.frequency = given.frequency.value_or(trough.frequency);
    }
    trough.frequency = frequency_of(trough);
    return trough;
}

int ramp_cycles_of(GivenStage const& given, double mean_frequency) {
    if (given.ramp_cycles) return *given.ramp_cycles;
    if (given.ramp) return std::max(1, whole(*given.ramp * mean_frequency));
    return 0;
}

}  // namespace

double Stage::ramp_time() const {
    return 2 * ramp_cycles / (first_frequency + trough.frequency);
}

double Stage::time() const {
    return ramp_time() + (cycles - ramp_cycles) / trough.frequency;
}

std::vector<Stage> stages(Scenario const& scenario) {
    std::vector<Stage> all;
    Trough trough = scenario.trough;
    bool stood = true;  // before the first stage
    int first_cycle = 0;
    double start = 0, mass_flow = scenario.feed.mass_flow.value_or(0);
    for (GivenStage const& given : scenario.stages) {
        double const before = trough.frequency;
        trough = with_drive(trough, given);
        double const first = stood ? trough.frequency : before;
        mass_flow = given.mass_flow.value_or(mass_flow);
        Stage stage{trough, given.standstill, first_cycle, 0, 0, first, start, mass_flow};
        stage.ramp_cycles = ramp_cycles_of(given, (first + trough.frequency) / 2);
        if (given.cycles) stage.cycles = *given.cycles;
        if (given.time)
            stage.cycles = stage.ramp_cycles + whole((*given.time - stage.ramp_time()) * trough.frequency);
        first_cycle += stage.cycles;
        start += stage.time();
        stood = given.standstill;
        all.push_back(std::move(stage));
    }
    return all;
}

std::vector<double> cycle_durations(std::vector<Stage> const& stages) {
    std::vector<double> durations;
    for (Stage const& stage : stages) {
        for (int cycle = 0; cycle < stage.cycles; ++cycle) {
            bool const in_ramp = cycle < stage.ramp_cycles;
            durations.push_back(in_ramp ? stage.ramp_time() / stage.ramp_cycles : 1 / stage.trough.frequency);
        }
    }
    return durations;
}

void require_steady_drive(Scenario const& scenario, std::string_view what) {
    if (is_screen(scenario))
        throw core::InputError(fmt::format(
            "{}: the campaign '{}' has a screen, and this needs a layer that keeps its grains; give "
            "it a campaign without [screen]",
            what, scenario.campaign));
    if (scenario.stages.empty()) return;
    throw core::InputError(
        fmt::format("{}: the campaign '{}' has [[stages]], and this needs a drive that never ends; give it a "
                    "campaign without them, with the drive of one stage below [trough]",
                    what, scenario.campaign));
}

int cycles_of(std::vector<Stage> const& stages) {
    return stages.empty() ? 0 : stages.back().first_cycle + stages.back().cycles;
}

}  // namespace vibrotrough::scenario
