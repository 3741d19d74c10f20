#include "theory/design.hpp"

#include "theory/detail/input_check.hpp"
#include "theory/map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <stdexcept>

#include <nlopt.hpp>

namespace vibrotrough::theory {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double near_limit = 1e-3;
constexpr double max_friction_used = 0.95;  // largest |tan(alpha)| / mu
constexpr int global_evaluations = 60000, local_evaluations = 4000;

/// The search variables: logarithms of frequency and amplitude, vibration angle, inclination.
using Variables = std::vector<double>;

class Search {
  public:
    explicit Search(DesignLimits const& limits) : limits_(limits), solver_(limits.rolling) {}

    Design at(Variables const& x) {
        DesignLimits const& l = limits_;
        Design d{};
        d.frequency = std::exp(x[0]);
        d.amplitude = std::exp(x[1]);
        d.vibration_angle = x[2];
        d.inclination = x[3];
        double const omega = 2 * pi * d.frequency;
        d.machine_number = omega * omega * d.amplitude / l.gravity;
        d.throw_number = d.machine_number * std::sin(x[2]) / std::cos(x[3]);
        Inputs inputs;
        inputs.set(Input::throw_number, std::min(d.throw_number, 1e4));
        inputs.set(Input::tan_vibration_angle, std::tan(x[2]));
        inputs.set(Input::tan_inclination, std::tan(x[3]));
        inputs.set(Input::friction, l.friction);
        MapPoint const e = solver_(inputs);
        d.velocity_efficiency = e.velocity_efficiency;
        d.conveying_speed = e.velocity_efficiency * omega * d.amplitude * std::cos(x[2]);
        d.mass_flow = l.bulk_density * l.layer_height * l.layer_width * d.conveying_speed;
        d.mode = to_string(e.mode);
        return d;
    }
    /// log(K / K_max) and log(Gamma / Gamma_max), which must not be positive.
    double over_machine_number(Variables const& x) const {
        return 2 * (std::log(2 * pi) + x[0]) + x[1] - std::log(limits_.gravity * limits_.max_machine_number);
    }
    double over_throw_number(Variables const& x) const {
        return 2 * (std::log(2 * pi) + x[0]) + x[1] + std::log(std::sin(x[2]) / std::cos(x[3])) -
               std::log(limits_.gravity * limits_.max_throw_number);
    }
    Variables low() const {
        return {std::log(limits_.frequency.low), std::log(limits_.amplitude.low), limits_.vibration_angle.low,
                limits_.inclination.low};
    }
    Variables high() const {
        return {std::log(limits_.frequency.high), std::log(limits_.amplitude.high),
                limits_.vibration_angle.high, limits_.inclination.high};
    }

  private:
    DesignLimits limits_;
    PointSolver solver_;
};

double speed(Variables const& x, Variables&, void* data) {
    double const v = static_cast<Search*>(data)->at(x).conveying_speed;
    return std::isfinite(v) ? v : -1e6;  // the mass runs away: not a usable machine
}
double machine_excess(Variables const& x, Variables&, void* data) {
    return static_cast<Search*>(data)->over_machine_number(x);
}
double throw_excess(Variables const& x, Variables&, void* data) {
    return static_cast<Search*>(data)->over_throw_number(x);
}

void check(DesignLimits const& l) {
    auto const range = [](Range const& r, double low, double high, char const* name, char const* text) {
        detail::require_range(r.low >= low && r.low <= r.high && r.high <= high, name, r.high, text);
    };
    range(l.frequency, 1e-3, 1e4, "frequency", "from low to high within [0.001, 10000] Hz");
    range(l.amplitude, 1e-7, 10, "amplitude", "from low to high within [1e-7, 10] m");
    range(l.vibration_angle, 1e-6, pi / 2 - 1e-6, "vibration_angle", "from low to high within (0, pi/2)");
    range(l.inclination, -pi / 2 + 1e-6, pi / 2 - 1e-6, "inclination",
          "from low to high within (-pi/2, pi/2)");
    detail::require_range(l.friction > 0 && l.friction <= 1e3, "friction", l.friction, "(0, 1000]");
    detail::require_range(l.max_machine_number > 0 && l.max_machine_number <= 1e4, "max_machine_number",
                          l.max_machine_number, "(0, 1e4]");
    detail::require_range(l.max_throw_number > 0 && l.max_throw_number <= 1e4, "max_throw_number",
                          l.max_throw_number, "(0, 1e4]");
    bool const layer = l.bulk_density > 0 && l.layer_height > 0 && l.layer_width > 0;
    detail::require_range(l.min_mass_flow == 0 || (l.min_mass_flow > 0 && layer), "min_mass_flow",
                          l.min_mass_flow, "[0, inf), with bulk density, layer height and width given");
}

/// When |tan(alpha)| is close to mu, the speed depends on the last digit of the friction coefficient, and
/// beyond mu it is unbounded.
DesignLimits with_friction_margin(DesignLimits limits) {
    constexpr double degrees = 180 / pi;
    double const steepest = std::atan(max_friction_used * limits.friction);
    // The flattest inclination that is allowed, with its sign, as it was given.
    double const flattest = limits.inclination.low > 0    ? limits.inclination.low
                            : limits.inclination.high < 0 ? limits.inclination.high
                                                          : 0;
    std::string const range = "up to " + detail::number_text(steepest * degrees) +
                              " deg, where tan(alpha) is 95 % of the friction coefficient";
    detail::require_range(std::abs(flattest) <= steepest, "inclination in deg", flattest * degrees,
                          range.c_str());
    limits.inclination.low = std::max(limits.inclination.low, -steepest);
    limits.inclination.high = std::min(limits.inclination.high, steepest);
    return limits;
}

/// The law of rolling layers is used only where it has been tested (outside_tested_range()).
DesignLimits within_tested_range(DesignLimits limits) {
    if (!limits.rolling) return limits;
    auto const narrowed = [](Range const& range, double low, double high, char const* name,
                             char const* text) {
        Range const common{std::max(range.low, low), std::min(range.high, high)};
        detail::require_range(common.low <= common.high, name, range.low, text);
        return common;
    };
    limits.max_throw_number = std::min(limits.max_throw_number, 2.6);
    limits.vibration_angle =
        narrowed(limits.vibration_angle, std::atan(0.25), std::atan(1.0), "vibration_angle",
                 "in rad, tan(beta) within [0.25, 1], of the rolling-layer law");
    limits.inclination = narrowed(limits.inclination, -std::atan(0.08), std::atan(0.08), "inclination",
                                  "in rad, tan(alpha) within [-0.08, 0.08], of the rolling-layer law");
    return limits;
}

Variables optimised(Search& search, nlopt::algorithm algorithm, Variables start, int evaluations,
                    double tolerance) {
    nlopt::opt optimiser(algorithm, 4);
    optimiser.set_lower_bounds(search.low());
    optimiser.set_upper_bounds(search.high());
    optimiser.set_max_objective(speed, &search);
    optimiser.add_inequality_constraint(machine_excess, &search, 1e-9);
    optimiser.add_inequality_constraint(throw_excess, &search, 1e-9);
    optimiser.set_maxeval(evaluations);
    optimiser.set_xtol_rel(tolerance);
    double value = 0;
    try {
        optimiser.optimize(start, value);
    } catch (nlopt::roundoff_limited const&) {
        return start;  // the result is as good as rounding allows
    }
    return start;
}

std::vector<std::string> active_limits(DesignLimits const& l, Design const& d) {
    std::vector<std::string> active;
    auto const text = [](double value) {
        std::array<char, 32> buffer{};
        std::snprintf(buffer.data(), buffer.size(), "%.6g", value);
        return std::string(buffer.data());
    };
    double const degrees = 180 / pi;
    auto const in_degrees = [&](Range const& r) { return Range{r.low * degrees, r.high * degrees}; };
    auto const check_range = [&](char const* name, double value, Range const& r, char const* unit) {
        double const slack = near_limit * std::max({std::abs(r.low), std::abs(r.high), r.high - r.low});
        if (r.high - r.low < 1e-12) return;  // a fixed value, not a limit
        if (value > r.high - slack) active.push_back(std::string(name) + " <= " + text(r.high) + unit);
        if (value < r.low + slack) active.push_back(std::string(name) + " >= " + text(r.low) + unit);
    };
    if (d.machine_number > l.max_machine_number * (1 - near_limit)) {
        active.push_back("machine_number <= " + text(l.max_machine_number));
    }
    if (d.throw_number > l.max_throw_number * (1 - near_limit)) {
        active.push_back("throw_number <= " + text(l.max_throw_number));
    }
    check_range("frequency", d.frequency, l.frequency, " Hz");
    check_range("amplitude", d.amplitude, l.amplitude, " m");
    check_range("vibration_angle", d.vibration_angle * degrees, in_degrees(l.vibration_angle), " deg");
    check_range("inclination", d.inclination * degrees, in_degrees(l.inclination), " deg");
    if (l.min_mass_flow > 0 && d.mass_flow < l.min_mass_flow * (1 + near_limit)) {
        active.push_back("mass_flow >= " + text(l.min_mass_flow) + " kg/s");
    }
    return active;
}

}  // namespace

Design fastest_design(DesignLimits const& requested) {
    check(requested);
    DesignLimits const limits = within_tested_range(with_friction_margin(requested));
    Search search(limits);
    nlopt::srand(1);
    Variables start = search.low();
    Variables const high = search.high();
    for (std::size_t i = 2; i < start.size(); ++i) start[i] = (start[i] + high[i]) / 2;
    if (search.over_machine_number(start) > 0 || search.over_throw_number(start) > 0) {
        start[2] = search.low()[2];  // the least vigorous machine that the ranges allow
        bool const none = search.over_machine_number(start) > 0 || search.over_throw_number(start) > 0;
        if (none)
            throw std::invalid_argument(
                "even the lowest frequency and amplitude exceed the largest machine number or throw number");
    }
    Variables const rough = optimised(search, nlopt::GN_ISRES, start, global_evaluations, 1e-9);
    Variables const fine = optimised(search, nlopt::LN_COBYLA, rough, local_evaluations, 1e-10);
    bool const better = search.over_machine_number(fine) < 1e-6 && search.over_throw_number(fine) < 1e-6 &&
                        search.at(fine).conveying_speed >= search.at(rough).conveying_speed;
    Design design = search.at(better ? fine : rough);
    design.feasible = std::isfinite(design.conveying_speed) && design.conveying_speed > 0 &&
                      design.mass_flow >= limits.min_mass_flow * (1 - 1e-9);
    design.active_limits = active_limits(limits, design);
    return design;
}

std::vector<Sensitivity> sensitivities_at(Design const& design, DesignLimits const& limits) {
    Inputs inputs;
    inputs.set(Input::throw_number, design.throw_number);
    inputs.set(Input::tan_vibration_angle, std::tan(design.vibration_angle));
    inputs.set(Input::tan_inclination, std::tan(design.inclination));
    inputs.set(Input::friction, limits.friction);
    return sensitivities(inputs, limits.rolling);
}

}  // namespace vibrotrough::theory
