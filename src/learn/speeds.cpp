#include "learn/speeds.hpp"

#include "core/csv.hpp"
#include "learn/machine_keys.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace vibrotrough::learn {
namespace {

constexpr std::string_view header_example =
    "begin the file with a line such as stroke_mm,rpm,vibration_angle_deg,speed_m_per_s,uncertainty_m_per_s";

/// A column that the table may have.
struct Column {
    std::string_view name;
    double low, high;  ///< bounds of its numbers; both excluded
};

constexpr std::array<Column, 10> known_columns{{
    {"stroke_mm", 0, 1e4},
    {"amplitude_mm", 0, 1e4},
    {"rpm", 0, 1e6},
    {"frequency_hz", 0, 1e5},
    {"vibration_angle_deg", 0, 90},
    {"inclination_deg", -90, 90},
    {"speed_m_per_s", -1e3, 1e3},
    {"speed_m_per_min", -6e4, 6e4},
    {"uncertainty_m_per_s", 0, 1e3},
    {"uncertainty_m_per_min", 0, 6e4},
}};

class Table {
  public:
    Table(std::string_view text, std::string const& path)
        : reader_(text, path, {.comments = true, .blanks = true, .most_columns = 100}) {
        for (std::string const& name : reader_.columns()) {
            if (std::ranges::none_of(known_columns, [&](Column const& c) { return c.name == name; }))
                reader_.fail(fmt::format("'{}' is not a column that is known here", name), all_names());
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
            reader_.fail(fmt::format("column {}: {:g} is out of range", name, *value),
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
    static std::string all_names() {
        std::string names = "the names are";
        for (Column const& column : known_columns)
            names += fmt::format("{} {}", &column == known_columns.data() ? "" : ",", column.name);
        return names;
    }

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

}  // namespace vibrotrough::learn
