#include "core/quantity.hpp"

#include "core/own_program.hpp"
#include "core/text.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <mutex>
#include <numbers>
#include <regex>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <udunits2.h>

namespace vibrotrough::core {
namespace {

struct FreeSystem {
    void operator()(ut_system* system) const { ut_free_system(system); }
};
struct FreeUnit {
    void operator()(ut_unit* unit) const { ut_free(unit); }
};
struct FreeConverter {
    void operator()(cv_converter* converter) const { cv_free(converter); }
};
using Unit = std::unique_ptr<ut_unit, FreeUnit>;

/// The database of units that a release archive has beside the program; empty when there is none, or when the
/// user names another one (UDUNITS2_XML_PATH), so that udunits2 looks for its own.
std::string bundled_units() {
    if (std::getenv("UDUNITS2_XML_PATH") != nullptr) return "";
    auto const program = find_own_program();
    if (!program) return "";
    std::error_code failure;
    auto const units = program->parent_path().parent_path() / VIBROTROUGH_UNITS;
    return std::filesystem::is_regular_file(units, failure) ? units.string() : "";
}

ut_system* unit_system() {
    static std::unique_ptr<ut_system, FreeSystem> const system = [] {
        ut_set_error_message_handler(ut_ignore);  // the messages of QuantityError replace those of udunits2
        std::string const bundled = bundled_units();
        std::unique_ptr<ut_system, FreeSystem> read(ut_read_xml(bundled.empty() ? nullptr : bundled.c_str()));
        if (read) {
            // The database has "degree" and "arc_degree" but not the abbreviations that engineers write.
            std::unique_ptr<ut_unit, FreeUnit> const degree(ut_get_unit_by_name(read.get(), "arc_degree"));
            ut_map_name_to_unit("deg", UT_ASCII, degree.get());
            ut_map_name_to_unit("Grad", UT_ASCII, degree.get());  // German; else a giga-radian
            std::unique_ptr<ut_unit, FreeUnit> const tonne(ut_get_unit_by_name(read.get(), "metric_ton"));
            ut_map_name_to_unit("to", UT_ASCII, tonne.get());  // German plants write to/h
        }
        return read;
    }();
    if (!system)
        throw QuantityError(
            "the unit database of udunits2 cannot be read; install the package libudunits2-data, or set "
            "UDUNITS2_XML_PATH to the path of udunits2.xml");
    return system.get();
}

Unit parse_unit(std::string const& text) {
    return Unit(ut_parse(unit_system(), text.c_str(), UT_UTF8));
}

/// "5 deg deg" and "3 mm %" are slips, but udunits2 multiplies: by 0.017 and by 0.01.
void check_pure_factors(std::string const& text) {
    static std::regex const divided("/| per ");
    static std::regex const separator("[ .*]+");
    if (std::regex_search(text, divided)) return;
    std::vector<std::string> const words(std::sregex_token_iterator(text.begin(), text.end(), separator, -1),
                                         {});
    if (words.size() < 2) return;
    Unit const one(ut_get_dimensionless_unit_one(unit_system()));
    for (std::string const& word : words) {
        Unit const unit = parse_unit(word);
        if (unit && ut_are_convertible(unit.get(), one.get()) != 0)
            throw QuantityError(
                fmt::format("'{}' multiplies by '{}', which is a pure number; leave it out", text, word));
    }
}

/// udunits2 accepts whole expressions ("mm 3", "mm @ 2", "seconds since 2000"). Only products of powers of
/// unit names are accepted here, because with an expression a typing error could silently give another
/// number.
void check_unit_text(std::string_view text) {
    static std::regex const unit(
        R"((1 ?|1? ?/ ?)?[^\d\s@()*^/.+-]+((\^|\*\*)?-?\d)?([ .*/]{1,3}[^\d\s@()*^/.+-]+((\^|\*\*)?-?\d)?)*)");
    static std::regex const word(R"((^|\W)(from|since|after|ref)(\W|$))", std::regex::icase);
    std::string const owned(text);
    if (owned.size() > 100 || !std::regex_match(owned, unit) || std::regex_search(owned, word)) {
        throw QuantityError(fmt::format("'{}' is not a plain unit", text));
    }
    check_pure_factors(owned);
}

/// A ton is 1000 kg in most countries, 907 kg in the United States and in udunits2, and 1016 kg in Britain.
void check_ton(std::string_view text) {
    static std::regex const ton(R"((^|[^A-Za-z_])tons?($|[^A-Za-z_]))", std::regex::icase);
    if (!std::regex_search(std::string(text), ton)) return;
    throw QuantityError(fmt::format("'{}' can mean three masses", text),
                        "write t for metric tonnes (1000 kg), short_ton (907 kg) or long_ton (1016 kg)");
}

/// udunits2 reads mt as a milli-tonne, a kilogram. Who writes it means metric tonnes.
void check_prefix_of_tonne(std::string_view text) {
    static std::regex const prefixed(
        R"((^|[^A-Za-z_])((da|[dmunh])t|(deci|centi|milli|micro|nano|hecto|deca)(metric_)?tonn?es?)($|[^A-Za-z_]))");
    if (!std::regex_search(std::string(text), prefixed)) return;
    throw QuantityError(fmt::format("'{}' has a prefix that nobody uses with t", text),
                        "write t for metric tonnes (1000 kg), kg for kilograms");
}

/// A frequency counts cycles, and a turn of the shaft is one cycle of the drive: "rpm" becomes "1/minute" and
/// "turns / s" becomes "1 / s". In udunits2 a turn is an angle, 2 pi.
std::string turns_as_cycles(std::string const& text) {
    static std::regex const rpm("rpm|RPM|revolutions?_per_minute");
    static std::regex const turn(
        "(turns?|revolutions?|rotations?|cycles?|rev|r|U|Umdr|Umdrehungen)( ?/.*| per .*)");
    if (std::regex_match(text, rpm)) return "1/minute";
    std::smatch parts;
    if (std::regex_match(text, parts, turn)) return "1" + parts[2].str();
    return text;
}

/// Whether the unit contains an angle, like "deg" and "rad/s".
bool is_angular(ut_unit const* unit) {
    std::array<char, 256> definition{};
    int const size = ut_format(unit, definition.data(), definition.size(), UT_ASCII | UT_DEFINITION);
    return size > 0 && std::string_view(definition.data()).find("rad") != std::string_view::npos;
}

/// The number with which a text begins, and what follows it.
struct NumberAndRest {
    double number;
    std::string_view rest;
};

/// What is said of "9,7 mm". Three digits behind the comma, as in "1,000 mm", may be thousands as well.
QuantityError comma_error(std::string const& text, std::smatch const& parts) {
    std::string const point =
        fmt::format("write {}.{}{} with a point", parts[1].str(), parts[2].str(), parts[3].str());
    if (parts[2].length() != 3) return QuantityError(fmt::format("'{}' has a decimal comma", text), point);
    return QuantityError(fmt::format("'{}' has a comma", text),
                         fmt::format("{}, or {}{}{} if thousands are meant", point, parts[1].str(),
                                     parts[2].str(), parts[3].str()));
}

/// @param problem  what is wrong with a text that does not begin with a number
NumberAndRest split_number(std::string_view whole, char const* problem) {
    static std::regex const decimal_comma(R"(([+-]?\d+),(\d+)([^\d,.].*)?)");
    std::string_view digits = whole;
    if (digits.starts_with('+')) digits.remove_prefix(1);
    double number = 0;
    auto const [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (failure != std::errc() || !std::isfinite(number))
        throw QuantityError(fmt::format("'{}' {}", whole, problem));
    std::string const owned(whole.substr(0, 100));
    std::smatch parts;
    if (std::regex_match(owned, parts, decimal_comma)) throw comma_error(owned, parts);
    return {number, trimmed(digits.substr(static_cast<std::size_t>(end - digits.data())))};
}

}  // namespace

double parse_number(std::string_view text) {
    constexpr char const* problem = "is not a finite number";
    std::string_view const whole = trimmed(text);
    auto const [number, rest] = split_number(whole, problem);
    if (rest == "%") return number / 100;
    if (!rest.empty()) throw QuantityError(fmt::format("'{}' {}", whole, problem));
    return number + 0.0;  // "-0" is 0
}

std::string unit_of(std::string_view text) {
    return std::string(split_number(trimmed(text), "does not begin with a finite number").rest);
}

double parse_quantity(std::string_view text, std::string const& unit) {
    std::string_view const whole = trimmed(text);
    auto const [number, rest] = split_number(whole, "does not begin with a finite number");
    if (rest.empty()) throw QuantityError(fmt::format("'{}' has no unit", whole));
    check_unit_text(rest);
    check_ton(rest);
    check_prefix_of_tonne(rest);
    std::string written = (rest.front() == '/' ? "1" : "") + std::string(rest);  // "340 / minute"
    if (unit == "Hz") written = turns_as_cycles(written);
    static std::mutex one_caller;  // the scanner of udunits2 is not for several threads
    std::lock_guard const lock(one_caller);
    Unit const from = parse_unit(written);
    if (!from) throw QuantityError(fmt::format("'{}' is not a known unit (of udunits2)", rest));
    Unit const to = parse_unit(unit);
    if (!to || ut_are_convertible(from.get(), to.get()) == 0) {
        throw QuantityError(fmt::format("'{}' cannot be converted to {}", rest, unit));
    }
    std::unique_ptr<cv_converter, FreeConverter> const converter(ut_get_converter(from.get(), to.get()));
    double const result = cv_convert_double(converter.get(), number) + 0.0;  // "-0 deg" is 0
    // In udunits2 a radian is the number 1. Without this check "rad/s" would become a frequency that is wrong
    // by 2 pi, and "5 %" would become an angle.
    if (is_angular(from.get()) != is_angular(to.get())) {
        if (is_angular(to.get())) throw QuantityError(fmt::format("'{}' is not a unit of angle", rest));
        throw QuantityError(
            fmt::format("'{}' contains an angle, {} does not", rest, unit),
            unit == "Hz" ? fmt::format("write {:.5g} rpm", 60 * result / (2 * std::numbers::pi)) : "");
    }
    if (!std::isfinite(result)) throw QuantityError(fmt::format("'{}' is too large", whole));
    return result;
}

}  // namespace vibrotrough::core
