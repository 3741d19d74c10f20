#include "app/commands/command.hpp"
#include "core/quantity.hpp"
#include "core/typed_unit.hpp"
#include "theory/unusual.hpp"

#include <regex>

namespace vibrotrough::app {
namespace {

// "25 deg to 35 deg", "25 to 35 deg" and "25-35 deg". A minus is a separator between plain numbers only:
// "-5 deg" and "25 s^-1" are single values.
bool is_range(std::string const& text, std::smatch& ends) {
    static std::regex const with_word(R"((.+?) (?:to|bis) (.+))");
    static std::regex const with_dash(R"(\s*(\d[\d.,]*)\s*(?:-|\xE2\x80\x93)\s*(\d.*))");
    static std::regex const between_units(R"((.+?) (?:-|\xE2\x80\x93) (\d.*))");  // "25 deg - 35 deg"
    return std::regex_match(text, ends, with_word) || std::regex_match(text, ends, with_dash) ||
           std::regex_match(text, ends, between_units);
}

/// What is wrong with the text of an option, and what to write, unless the error says that itself.
[[noreturn]] void fail(std::string const& option, std::string const& text, core::QuantityError const& error,
                       std::string const& advice) {
    std::smatch ends;
    bool const is_whole_range = is_range(text, ends);
    throw core::InputError(
        fmt::format("{} {}: {}; {}", option, text,
                    is_whole_range ? "is a range, and here one value is needed" : error.problem(),
                    is_whole_range || error.advice().empty() ? advice : error.advice()));
}

/// Of a plain number that is out of its range, which slip would explain it.
std::string slip_of_number(std::string const& option, double value) {
    std::string slip;
    if (option.ends_with("friction")) slip = theory::slip_of_friction(value);
    if (option.starts_with("--tan-")) slip = theory::slip_of_tangent(value);
    return slip.empty() ? "" : fmt::format(" ({})", slip);
}

double read_quantity(std::string const& option, std::string const& text, std::string const& unit,
                     std::string const& example) {
    try {
        return core::parse_quantity(text, unit);
    } catch (core::QuantityError const& error) {
        fail(option, text, error,
             fmt::format("write a number with its unit, for example {} \"{}\"", option, example));
    }
}

}  // namespace

std::string required(std::string const& option, Text const& text, std::string const& example) {
    if (!text)
        throw core::InputError(
            fmt::format("{} is missing; write for example {} {}", option, option, example));
    return *text;
}

void refuse_both(std::string const& first, Text const& a, std::string const& second, Text const& b) {
    if (!a || !b) return;
    throw core::InputError(
        fmt::format("{} {} and {} {} are both given; write only one of them", first, *a, second, *b));
}

double read_number(std::string const& option, std::string const& text, std::string const& example) {
    try {
        return core::parse_number(text);
    } catch (core::QuantityError const& error) {
        fail(option, text, error, fmt::format("write for example {} {}", option, example));
    }
}

double read_number_within(std::string const& option, std::string const& text, std::string const& example,
                          double low, double high) {
    double const value = read_number(option, text, example);
    if (value >= low && value <= high) return value;
    throw core::InputError(
        fmt::format("{} {}: must be at least {:g} and at most {:g}{}; write for example {} {}", option, text,
                    low, high, slip_of_number(option, value), option, example));
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

bool is_volume_flow(std::string const& text) {
    try {
        core::parse_quantity(text, "m3/s");
    } catch (core::QuantityError const&) {
        return false;
    }
    return true;
}

double read_mass_flow(std::string const& option, std::string const& text,
                      std::optional<double> bulk_density) {
    std::string const example = "12 t/h";
    if (!is_volume_flow(text)) return read_positive_quantity(option, text, "kg/s", example);
    if (bulk_density) return *bulk_density * read_positive_quantity(option, text, "m3/s", "20 m3/h");
    throw core::InputError(fmt::format(
        "{} {}: is a flow of volume, for which the bulk density must be known; write --bulk-density, or a "
        "flow of mass, for example {} \"{}\"",
        option, text, option, example));
}

double read_turns(std::string const& option, std::string const& text) {
    bool const plain = text.find_first_not_of("0123456789.+eE- \t,") == std::string::npos;
    double const frequency =
        plain ? read_number(option, text, "960") / 60 : read_quantity(option, text, "Hz", "960 rpm");
    if (frequency * 60 >= 1 && frequency * 60 <= 1e5) return frequency;
    throw core::InputError(
        fmt::format("{} {}: must be at least 1 and at most 100000 turns per minute; write for example {} 960",
                    option, text, option));
}

std::string last_of_range(std::string const& text) {
    std::smatch ends;
    return is_range(text, ends) ? ends[2].str() : text;
}

theory::Range read_range(std::string const& option, std::string const& text, std::string const& example,
                         std::function<double(std::string const&)> const& read_one) {
    static std::regex const number_and_unit(R"(\s*[+-]?[\d.,]+(?:[eE][+-]?\d+)?\s*(.*))");
    std::smatch ends, first, second;
    if (!is_range(text, ends)) {
        double const value = read_one(text);
        return {value, value};
    }
    std::string low = ends[1].str();
    std::string const high = ends[2].str();
    bool const has_no_unit = std::regex_match(low, first, number_and_unit) && first[1].length() == 0;
    if (has_no_unit && std::regex_match(high, second, number_and_unit)) low += " " + second[1].str();
    theory::Range const range{read_one(low), read_one(high)};
    if (range.low <= range.high) return range;
    throw core::InputError(
        fmt::format("{} {}: the first value is above the second; write for example {} \"{}\"", option, text,
                    option, example));
}

double read_option(std::string_view name, std::string const& text) {
    OptionRow const& row = option_row(name);
    if (row.is_whole)
        return read_count(row.name, text, row.example, static_cast<int>(row.least),
                          static_cast<int>(row.most));
    if (row.unit.empty()) return read_number_within(row.name, text, row.example, row.least, row.most);
    double const value = read_quantity(row.name, text, row.unit, row.example);
    if (value >= row.least && value <= row.most) return value;
    throw core::InputError(fmt::format("{} {}: must lie between {}{}; write for example {}", row.name, text,
                                       core::range_in_unit_of(text, row.least, row.most, row.unit, " and "),
                                       core::slip_of_unit(text, row.least, row.most, row.unit),
                                       row.written_example()));
}

theory::Range read_option_range(std::string_view name, std::string const& text) {
    return read_range(std::string(name), text, option_row(name).example,
                      [&](std::string const& one) { return read_option(name, one); });
}

learn::Uncertain read_uncertain_option(std::string_view name, std::string const& text) {
    for (std::string const sign : {"+-", "\u00b1", "+/-"}) {
        auto const at = text.find(sign);
        if (at == std::string::npos) continue;
        std::string mean = text.substr(0, at);
        std::string const sd = text.substr(at + sign.size());
        bool const has_unit = mean.find_first_not_of("0123456789.,eE+- ") != std::string::npos;
        OptionRow const& row = option_row(name);
        // The unit of the second stands for both.
        if (!row.unit.empty() && !has_unit)
            mean += " " + sd.substr(std::min(sd.find_first_not_of("0123456789.,eE+- "), sd.size()));
        double const error = row.unit.empty() ? read_number_within(row.name, sd, row.example, 0, row.most)
                                              : read_positive_quantity(row.name, sd, row.unit, row.example);
        return {read_option(name, mean), error};
    }
    auto const [low, high] = read_option_range(name, text);
    return low == high ? learn::Uncertain{low} : learn::between_ends(low, high);
}

}  // namespace vibrotrough::app
