#include "theory/detail/conveyor/check.hpp"

#include "theory/detail/common/input_check.hpp"

#include <cmath>

namespace vibrotrough::theory::detail {

void check_ranges(Conveyor const& c) {
    check_ranges(c.point);
    require_range(
        c.static_friction == 0 || (c.static_friction >= c.point.friction && c.static_friction <= 1e6),
        "static_friction", c.static_friction, "[friction, 1e6]");
    require_range(c.restitution >= 0 && c.restitution <= 0.99, "restitution", c.restitution, "[0, 0.99]");
    require_range(c.slowest_rebound >= 1e-9 && c.slowest_rebound <= 1, "slowest_rebound", c.slowest_rebound,
                  "[1e-9, 1]");
    require_range(!c.landing_friction || (*c.landing_friction >= 0 && *c.landing_friction <= 1e6),
                  "landing_friction", c.landing_friction.value_or(0), "[0, 1e6]");
    require_range(c.air_drag >= 0 && c.air_drag <= 1e3, "air_drag", c.air_drag, "[0, 1000]");
    require_range(std::abs(c.along_ratio) <= 1e3, "along_ratio", c.along_ratio, "[-1000, 1000]");
    require_range(std::abs(c.along_phase) <= 100, "along_phase", c.along_phase, "[-100, 100]");
    for (auto const* harmonics : {&c.along, &c.normal}) {
        for (Harmonic const& h : *harmonics) {
            require_range(h.order >= 1 && h.order <= 100, "order", h.order, "[1, 100]");
            require_range(std::abs(h.amplitude) <= 1e3, "amplitude", h.amplitude, "[-1000, 1000]");
            require_range(std::abs(h.phase) <= 100, "phase", h.phase, "[-100, 100]");
        }
    }
    require_range(c.wall_friction >= 0 && c.wall_friction <= 1e3, "wall_friction", c.wall_friction,
                  "[0, 1000]");
    require_range(c.wall_pressure_ratio >= 0 && c.wall_pressure_ratio <= 1, "wall_pressure_ratio",
                  c.wall_pressure_ratio, "[0, 1]");
    require_range(c.height_over_width >= 0 && c.height_over_width <= 1e3, "height_over_width",
                  c.height_over_width, "[0, 1000]");
}

std::string inputs_text(Conveyor const& c) {
    auto const number = [](char const* name, double value) {
        return std::string(" ") + name + "=" + number_text(value);
    };
    auto const harmonics = [&](char const* name, std::vector<Harmonic> const& all) {
        std::string text;
        for (Harmonic const& h : all) {
            text += std::string(" ") + name + "=" + std::to_string(h.order) + "," + number_text(h.amplitude) +
                    "," + number_text(h.phase);
        }
        return text;
    };
    return inputs_text(c.point) + number("static_friction", c.static_friction) +
           number("restitution", c.restitution) + number("slowest_rebound", c.slowest_rebound) +
           (c.landing_friction ? number("landing_friction", *c.landing_friction) : "") +
           number("air_drag", c.air_drag) + number("along_ratio", c.along_ratio) +
           number("along_phase", c.along_phase) + harmonics("along", c.along) +
           harmonics("normal", c.normal) + number("wall_friction", c.wall_friction) +
           number("wall_pressure_ratio", c.wall_pressure_ratio) +
           number("height_over_width", c.height_over_width);
}

}  // namespace vibrotrough::theory::detail
