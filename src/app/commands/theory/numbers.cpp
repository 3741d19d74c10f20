#include "app/commands/theory/options.hpp"
#include "core/error.hpp"
#include "core/quantity.hpp"

#include <charconv>
#include <cmath>

#include <fmt/format.h>

namespace vibrotrough::app {
namespace {

double read_quantity(std::string const& option, std::string const& text, std::string const& unit,
                     std::string const& example) {
    try {
        return core::parse_quantity(text, unit);
    } catch (core::QuantityError const& error) {
        throw core::InputError(fmt::format("{} {}: {}; write a number with its unit, for example {} \"{}\"",
                                           option, text, error.what(), option, example));
    }
}

}  // namespace

std::string required(std::string const& option, Text const& text, std::string const& example) {
    if (!text)
        throw core::InputError(
            fmt::format("{} is missing; write for example {} {}", option, option, example));
    return *text;
}

double read_number(std::string const& option, std::string const& text, std::string const& example) {
    double value = 0;
    char const* const end = text.data() + text.size();
    auto const [stop, failure] = std::from_chars(text.data() + (text.starts_with('+') ? 1 : 0), end, value);
    if (failure != std::errc() || stop != end || !std::isfinite(value)) {
        throw core::InputError(fmt::format("{} {}: '{}' is not a finite number; write for example {} {}",
                                           option, text, text, option, example));
    }
    return value;
}

double read_number_within(std::string const& option, std::string const& text, std::string const& example,
                          double low, double high) {
    double const value = read_number(option, text, example);
    if (value >= low && value <= high) return value;
    throw core::InputError(
        fmt::format("{} {}: must be at least {:g} and at most {:g}; write for example {} {}", option, text,
                    low, high, option, example));
}

int read_count(std::string const& option, std::string const& text, std::string const& example, int low,
               int high) {
    double const value = read_number_within(option, text, example, low, high);
    if (value == std::floor(value)) return static_cast<int>(value);
    throw core::InputError(
        fmt::format("{} {}: must be a whole number; write for example {} {}", option, text, option, example));
}

double read_positive_quantity(std::string const& option, std::string const& text, std::string const& unit,
                              std::string const& example) {
    double const value = read_quantity(option, text, unit, example);
    if (value > 0) return value;
    throw core::InputError(
        fmt::format("{} {}: must be above zero; write for example {} \"{}\"", option, text, option, example));
}

theory::Range read_range(std::string const& option, std::string const& text, std::string const& example,
                         std::function<double(std::string const&)> const& read_one) {
    auto const middle = text.find(" to ");
    if (middle == std::string::npos) {
        double const value = read_one(text);
        return {value, value};
    }
    theory::Range const range{read_one(text.substr(0, middle)), read_one(text.substr(middle + 4))};
    if (range.low <= range.high) return range;
    throw core::InputError(
        fmt::format("{} {}: the first value is above the second; write for example {} \"{}\"", option, text,
                    option, example));
}

double read_angle(std::string const& option, std::string const& text, std::string const& example,
                  double low_deg, double high_deg) {
    double const angle = read_quantity(option, text, "radian", example);
    if (angle > low_deg * degree && angle < high_deg * degree) return angle;
    throw core::InputError(
        fmt::format("{} {}: must lie between {:g} and {:g} degrees; write for example {} \"{}\"", option,
                    text, low_deg, high_deg, option, example));
}

}  // namespace vibrotrough::app
