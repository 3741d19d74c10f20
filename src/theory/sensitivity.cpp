#include "theory/sensitivity.hpp"

#include "theory/map.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace vibrotrough::theory {
namespace {

constexpr double relative_step = 1e-5;

double efficiency(Inputs const& inputs, PointSolver& solver) {
    Efficiency const point = solver(inputs);
    if (point.outcome != Outcome::periodic) {
        throw std::invalid_argument("sensitivities cannot be computed: " + to_string(point.outcome));
    }
    return point.velocity_efficiency;
}

/// Whether an input that cannot be negative is zero, so that it can only be increased.
bool at_lower_limit(Input input, double value) {
    return value == 0 && input != Input::inclination_deg && input != Input::tan_inclination &&
           input != Input::along_phase_deg;
}

}  // namespace

std::vector<Sensitivity> sensitivities(Inputs const& inputs, std::optional<RollingLaw> const& rolling) {
    PointSolver solver(rolling);
    double const eta = efficiency(inputs, solver);
    std::vector<Sensitivity> answers;
    for (std::size_t i = 0; i < input_count; ++i) {
        auto const input = static_cast<Input>(i);
        auto const value = inputs.get(input);
        bool const is_scale = input == Input::amplitude_m || input == Input::stroke_mm;
        if (!value || (is_scale && !inputs.get(Input::frequency_hz))) continue;
        double const step = *value == 0 ? relative_step : std::abs(*value) * relative_step;
        double const low = at_lower_limit(input, *value) ? *value : *value - step, high = *value + step;
        Inputs changed = inputs;
        changed.set(input, low);
        double const below = efficiency(changed, solver);
        changed.set(input, high);
        double const slope = (efficiency(changed, solver) - below) / (high - low);
        answers.push_back({input, *value, slope, eta == 0 ? 0 : slope * *value / eta});
    }
    return answers;
}

}  // namespace vibrotrough::theory
