#include "learn/speeds.hpp"

#include "core/csv.hpp"
#include "core/nearest.hpp"
#include "core/typed_unit.hpp"
#include "learn/machine_keys.hpp"
#include "theory/drive.hpp"
#include "theory/quantities.hpp"
#include "theory/unusual.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::learn {
namespace {

constexpr std::string_view header_example =
    "begin the file with a line such as stroke_mm,rpm,vibration_angle_deg,speed_m_per_s,uncertainty_m_per_s";

/// A column that the table may have.
struct Column {
    std::string_view name;
    double low, high;            ///< bounds of its numbers; both excluded
    std::string_view unit = {};  ///< of the numbers, where it is an SI unit that is often mixed up
};

constexpr std::array<Column, 10> known_columns{{
    {"stroke_mm", 0, 1e4},
    {"amplitude_mm", 0, 1e4},
    {"rpm", 0, 1e6},
    {"frequency_hz", 0, 1e5, "Hz"},
    {"vibration_angle_deg", 0, 90},
    {"inclination_deg", -90, 90},
    {"speed_m_per_s", -1e3, 1e3, "m/s"},
    {"speed_m_per_min", -6e4, 6e4},
    {"uncertainty_m_per_s", 0, 1e3},
    {"uncertainty_m_per_min", 0, 6e4},
}};

/// The column that is meant by another name; else all.
std::string name_instead(std::string const& given) {
    std::vector<std::string_view> names;
    for (Column const& column : known_columns) names.push_back(column.name);
    auto const nearest = core::nearest_word(given, names);
    return nearest.empty() ? fmt::format("the names are {}", fmt::join(names, ", "))
                           : fmt::format("did you mean {}?", nearest);
}

class Table {
  public:
    Table(std::string_view text, std::string const& path)
        : reader_(text, path, {.comments = true, .blanks = true, .most_columns = 100}) {
        for (std::string const& name : reader_.columns()) {
            if (std::ranges::none_of(known_columns, [&](Column const& c) { return c.name == name; }))
                reader_.fail(fmt::format("'{}' is not a column that is known here", name),
                             name_instead(name));
        }
        exactly_one("stroke_mm", "amplitude_mm");
        exactly_one("rpm", "frequency_hz");
        exactly_one("speed_m_per_s", "speed_m_per_min");
        at_most_one("uncertainty_m_per_s", "uncertainty_m_per_min");
    }

    bool next() { return reader_.next(); }
    int line() const { return reader_.line(); }
    bool has(std::string_view name) const {
        return std::ranges::find(reader_.columns(), name) != reader_.columns().end();
    }

    /// The number in a column of the row; nothing when there is no such column or the cell is empty.
    std::optional<double> number(std::string_view name) const {
        auto const& names = reader_.columns();
        auto const at = std::ranges::find(names, name);
        if (at == names.end()) return {};
        auto const value = reader_.number_if_given(static_cast<std::size_t>(at - names.begin()));
        Column const& column = *std::ranges::find(known_columns, name, &Column::name);
        if (value && !(*value > column.low && *value < column.high)) {
            std::string const slip =
                column.unit.empty() ? ""
                                    : core::slip_of_unit(fmt::format("{} {}", *value, column.unit),
                                                         column.low, column.high, std::string(column.unit));
            reader_.fail(fmt::format("column {}: {:g} is out of range{}", name, *value, slip),
                         fmt::format("write a number above {:g} and below {:g}", column.low, column.high));
        }
        return value;
    }

    double required(std::string_view name) const {
        if (auto const value = number(name)) return *value;
        reader_.fail(fmt::format("column {} is empty", name), "write the number, or remove the line");
    }

    [[noreturn]] void fail(std::string const& problem, std::string_view cure) const {
        reader_.fail(problem, cure);
    }

  private:
    void at_most_one(std::string_view one, std::string_view other) const {
        if (has(one) && has(other))
            reader_.fail(fmt::format("{} and {} are given both", one, other), "keep one of the two columns");
    }

    void exactly_one(std::string_view one, std::string_view other) const {
        at_most_one(one, other);
        if (!has(one) && !has(other))
            reader_.fail(fmt::format("there is neither a column {} nor {}", one, other), header_example);
    }

    core::CsvReader reader_;
};

double uncertainty_of(Table const& table, double speed, std::optional<double> relative) {
    if (auto const given = table.number("uncertainty_m_per_s")) return *given;
    if (auto const given = table.number("uncertainty_m_per_min")) return *given / 60;
    if (relative && speed != 0) return *relative * std::abs(speed);
    table.fail("the speed has no uncertainty",
               "write its standard uncertainty into the column uncertainty_m_per_s, or give one for all, for "
               "example "
               "--uncertainty 0.03 for 3 % of each speed");
}

}  // namespace

std::vector<MeasuredSpeed> read_speeds(std::string_view text, std::string const& path,
                                       std::optional<double> relative_uncertainty) {
    Table table(text, path);
    bool const has_stroke = table.has("stroke_mm"), has_rpm = table.has("rpm"),
               has_seconds = table.has("speed_m_per_s");
    std::vector<MeasuredSpeed> speeds;
    while (table.next()) {
        MeasuredSpeed one{};
        one.line = table.line();
        one.is_stroke = has_stroke;
        one.is_turns = has_rpm;
        one.amplitude =
            has_stroke ? table.required("stroke_mm") / 2000 : table.required("amplitude_mm") / 1000;
        one.frequency = has_rpm ? table.required("rpm") / 60 : table.required("frequency_hz");
        if (auto const angle = table.number("vibration_angle_deg")) one.vibration_angle = *angle * degree;
        if (auto const angle = table.number("inclination_deg")) one.inclination = *angle * degree;
        one.speed = has_seconds ? table.required("speed_m_per_s") : table.required("speed_m_per_min") / 60;
        one.uncertainty = uncertainty_of(table, one.speed, relative_uncertainty);
        speeds.push_back(one);
    }
    if (speeds.empty()) table.fail("the table has no measurement", "write one measurement per line");
    return speeds;
}

namespace {

/// The slip of a unit that would explain a speed above the trough's own; nothing where none does.
std::string slip_of_speed(MeasuredSpeed const& one, double fastest) {
    constexpr double smallest_usual = 1e-4;  // m, of an amplitude
    if (one.amplitude < smallest_usual) return "; were stroke and amplitude written in m, not mm?";
    if (std::abs(one.speed) / 60 <= fastest) return "; were m/min meant (speed_m_per_min)?";
    return std::abs(one.speed) / 1000 <= fastest ? "; were mm/s meant?" : "";
}

}  // namespace

std::vector<std::string> unusual_speeds(std::vector<MeasuredSpeed> const& speeds) {
    std::vector<std::string> sentences;
    auto const tell_first = [&](auto const& what_is_unusual) {
        for (MeasuredSpeed const& one : speeds) {
            std::string const told = what_is_unusual(one);
            if (told.empty()) continue;
            sentences.push_back(fmt::format("line {}: {}", one.line, told));
            return;
        }
    };
    tell_first([](MeasuredSpeed const& s) {
        theory::Drive const drive{s.frequency, s.amplitude, 1, 0};
        theory::MachineNumbers numbers{
            s.frequency, s.amplitude, drive.machine_number(theory::Machine{}.gravity), {}, s.vibration_angle};
        numbers.is_stroke = s.is_stroke;
        numbers.is_turns = s.is_turns;
        auto const unusual = theory::unusual_numbers(numbers);
        return unusual.empty() ? "" : unusual.front();
    });
    // A mass that does not rebound is never faster than the trough.
    tell_first([](MeasuredSpeed const& s) -> std::string {
        double const fastest = 2 * std::numbers::pi * s.frequency * s.amplitude;
        if (std::abs(s.speed) <= fastest) return "";
        return fmt::format(
            "a speed of {:.3g} m/s is more than the trough's own largest speed of {:.3g} m/s{}", s.speed,
            fastest, slip_of_speed(s, fastest));
    });
    return sentences;
}

}  // namespace vibrotrough::learn
