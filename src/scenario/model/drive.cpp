#include "scenario/model/drive.hpp"

#include "scenario/model/scenario.hpp"

#include <algorithm>
#include <cmath>

namespace vibrotrough::scenario {
namespace {

DriveMotion up_to_order(DriveMotion motion, int order) {
    for (auto* terms : {&motion.along, &motion.normal})
        std::erase_if(*terms, [order](DriveTerm const& term) { return term.order > order; });
    return motion;
}

double sum_of(std::vector<DriveTerm> const& terms, int power) {
    double sum = 0;
    for (DriveTerm const& term : terms) sum += std::abs(term.amplitude) * std::pow(term.order, power);
    return sum;
}

}  // namespace

DriveMotion drive_motion(Trough const& trough) {
    if (trough.waveform && !trough.waveform_order) return trough.waveform->motion;
    if (trough.waveform) return up_to_order(trough.waveform->all, *trough.waveform_order);
    DriveMotion motion;
    double const along = is_vertical(trough) ? 0 : trough.amplitude * std::cos(trough.vibration_angle);
    double const normal = trough.amplitude * std::sin(trough.vibration_angle);
    if (along != 0) motion.along.push_back({1, along, trough.along_phase});
    if (normal != 0) motion.normal.push_back({1, normal, 0});
    for (DriveHarmonic const& harmonic : trough.harmonics) {
        // Integrating X'' = -a sin(k t + phase) twice gives X = a / k^2 sin(k t + phase).
        double const ratio = harmonic.ratio / (static_cast<double>(harmonic.order) * harmonic.order);
        if (along != 0) motion.along.push_back({harmonic.order, along * ratio, harmonic.phase});
        if (normal != 0) motion.normal.push_back({harmonic.order, normal * ratio, harmonic.phase});
    }
    return motion;
}

double largest_excursion(DriveMotion const& motion) {
    return std::hypot(sum_of(motion.along, 0), sum_of(motion.normal, 0));
}

double largest_speed(DriveMotion const& motion, double omega) {
    return omega * std::hypot(sum_of(motion.along, 1), sum_of(motion.normal, 1));
}

int highest_order(DriveMotion const& motion) {
    int order = 1;
    for (auto const* terms : {&motion.along, &motion.normal}) {
        for (DriveTerm const& term : *terms) order = std::max(order, term.order);
    }
    return order;
}

}  // namespace vibrotrough::scenario
