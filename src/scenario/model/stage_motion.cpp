#include "scenario/model/stage_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vibrotrough::scenario {
namespace {

constexpr double full_turn = 2 * std::numbers::pi;

/// Displacement and its derivative by the angle.
struct Place {
    double displacement, slope;
};

Place place_at(std::vector<DriveTerm> const& terms, double angle) {
    Place place{0, 0};
    for (DriveTerm const& term : terms) {
        double const argument = term.order * angle + term.phase;
        place.displacement += term.amplitude * (std::sin(argument) - std::sin(term.phase));
        place.slope += term.amplitude * term.order * std::cos(argument);
    }
    return place;
}

/// The displacement along one axis at a share of the time of a part, and the velocity.
std::pair<double, double> along_axis(DrivePart const& part, std::vector<DriveTerm> const& from,
                                     std::vector<DriveTerm> const& to, double share) {
    double const angle = part.angle(share);
    double const omega = full_turn * (part.first_frequency + share * (part.frequency - part.first_frequency));
    Place const after = place_at(to, angle);
    if (!part.ramp) return {after.displacement, omega * after.slope};
    Place const before = place_at(from, angle);
    double const slope = (1 - share) * before.slope + share * after.slope;
    return {(1 - share) * before.displacement + share * after.displacement,
            omega * slope + (after.displacement - before.displacement) / part.time};
}

DriveMotion motion_of(Stage const& stage) {
    return stage.standstill ? DriveMotion{} : drive_motion(stage.trough);
}

}  // namespace

double DrivePart::angle(double u) const {
    double const mean = (first_frequency + frequency) / 2;
    return full_turn * cycles * (first_frequency * u + (frequency - first_frequency) / 2 * u * u) / mean;
}

std::vector<DrivePart> drive_parts(std::vector<Stage> const& stages) {
    std::vector<DrivePart> parts;
    DriveMotion before;
    for (std::size_t i = 0; i < stages.size(); ++i) {
        Stage const& stage = stages[i];
        DriveMotion motion = motion_of(stage);
        double const ramp = stage.ramp_time(), frequency = stage.trough.frequency;
        int const number = static_cast<int>(i), rest = stage.cycles - stage.ramp_cycles;
        if (stage.ramp_cycles > 0)
            parts.push_back({number, true, stage.first_cycle, stage.ramp_cycles, stage.start, ramp,
                             stage.first_frequency, frequency, before, motion});
        if (rest > 0)
            parts.push_back({number,
                             false,
                             stage.first_cycle + stage.ramp_cycles,
                             rest,
                             stage.start + ramp,
                             rest / frequency,
                             frequency,
                             frequency,
                             {},
                             motion});
        before = std::move(motion);
    }
    return parts;
}

DrivePart const& part_at(std::vector<DrivePart> const& parts, double time) {
    auto const next = std::ranges::upper_bound(parts, time, {}, &DrivePart::start);
    return next == parts.begin() ? parts.front() : *std::prev(next);
}

TroughState trough_at(std::vector<DrivePart> const& parts, double time) {
    DrivePart const& part = part_at(parts, time);
    double const share = std::clamp((time - part.start) / part.time, 0.0, 1.0);
    auto const [x, vx] = along_axis(part, part.from.along, part.to.along, share);
    auto const [z, vz] = along_axis(part, part.from.normal, part.to.normal, share);
    return {x, z, vx, vz};
}

double time_of_step(std::vector<DrivePart> const& parts, int steps_per_cycle, long step) {
    double const cycle = static_cast<double>(step) / steps_per_cycle;
    auto const before = [&](DrivePart const& part) { return part.first_cycle <= cycle; };
    auto const next = std::ranges::partition_point(parts, before);
    DrivePart const& part = next == parts.begin() ? parts.front() : *std::prev(next);
    return part.start + (cycle - part.first_cycle) * part.cycle_time();
}

}  // namespace vibrotrough::scenario
