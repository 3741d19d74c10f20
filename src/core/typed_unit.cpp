#include "core/typed_unit.hpp"

#include "core/quantity.hpp"
#include "core/text.hpp"

#include <array>

#include <fmt/format.h>

namespace vibrotrough::core {
namespace {

struct CommonUnit {
    std::string_view of;       ///< the SI unit of the quantity
    std::string_view written;  ///< as people write it; of two that fit, the first is offered
};

constexpr std::array common_units{
    CommonUnit{"m", "mm"},        CommonUnit{"m", "m"},        CommonUnit{"Hz", "Hz"},
    CommonUnit{"Hz", "rpm"},      CommonUnit{"radian", "deg"}, CommonUnit{"radian", "rad"},
    CommonUnit{"kg/m3", "kg/m3"}, CommonUnit{"kg/m3", "t/m3"}, CommonUnit{"m/s", "m/s"},
    CommonUnit{"m/s", "m/min"},   CommonUnit{"m/s", "mm/s"},   CommonUnit{"kg/s", "t/h"},
    CommonUnit{"kg/s", "kg/h"},   CommonUnit{"Pa", "MPa"},     CommonUnit{"Pa", "Pa"},
};

}  // namespace

std::string range_in_unit_of(std::string_view text, double low, double high, std::string const& unit,
                             std::string_view between) {
    std::string const written = unit_of(text);
    double const one = parse_quantity("1 " + written, unit);
    return fmt::format("{:.6g}{}{:.6g} {}", low / one, between, high / one, written);
}

std::string slip_of_unit(std::string_view text, double low, double high, std::string const& unit) {
    std::string_view const whole = trimmed(text);
    std::string const number(trimmed(whole.substr(0, whole.size() - unit_of(text).size())));
    double const as_written = parse_quantity(text, unit);
    if (as_written >= low && as_written <= high) return "";
    for (CommonUnit const& common : common_units) {
        if (common.of != unit) continue;
        std::string const meant = fmt::format("{} {}", number, common.written);
        double const value = parse_quantity(meant, unit);
        if (value >= low && value <= high) return fmt::format(" (were {} meant?)", meant);
    }
    return "";
}

}  // namespace vibrotrough::core
