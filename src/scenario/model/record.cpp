#include "scenario/model/record.hpp"

#include "core/csv.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace vibrotrough::scenario {
namespace {

constexpr double standard_gravity = 9.80665;  ///< m/s2 in a g of an accelerometer

/// A column that a record may have.
struct Column {
    std::string_view name;
    char axis;      ///< 't' for the time
    double factor;  ///< to SI units
    bool is_acceleration = false;
};

constexpr std::array record_columns{Column{"time_s", 't', 1},
                                    Column{"time_ms", 't', 1e-3},
                                    Column{"x_m", 'x', 1},
                                    Column{"y_m", 'y', 1},
                                    Column{"z_m", 'z', 1},
                                    Column{"x_mm", 'x', 1e-3},
                                    Column{"y_mm", 'y', 1e-3},
                                    Column{"z_mm", 'z', 1e-3},
                                    Column{"ax_m_per_s2", 'x', 1, true},
                                    Column{"ay_m_per_s2", 'y', 1, true},
                                    Column{"az_m_per_s2", 'z', 1, true},
                                    Column{"ax_g", 'x', standard_gravity, true},
                                    Column{"ay_g", 'y', standard_gravity, true},
                                    Column{"az_g", 'z', standard_gravity, true}};

[[noreturn]] void refuse_header(int line, std::string const& name) {
    throw std::invalid_argument(
        fmt::format("line {}: {}; a record has the columns time_s (or time_ms) and x_m, z_m (or x_mm, z_mm), "
                    "or ax_m_per_s2, az_m_per_s2 (or ax_g, az_g), and may have those of y",
                    line, name));
}

/// What each column of the file is; those of time, x and z are there.
std::vector<Column> known_columns(core::CsvReader const& table) {
    std::vector<Column> found;
    for (std::string const& name : table.columns()) {
        auto const column = std::ranges::find(record_columns, name, &Column::name);
        if (column == record_columns.end())
            refuse_header(table.header_line(), fmt::format("'{}' is not a known column", name.substr(0, 40)));
        found.push_back(*column);
    }
    for (char const axis : {'t', 'x', 'z'})
        if (std::ranges::count(found, axis, &Column::axis) != 1)
            refuse_header(table.header_line(), "time, x and z are not given once each");
    bool const is_acceleration = std::ranges::find(found, 'x', &Column::axis)->is_acceleration;
    for (Column const& column : found)
        if (column.axis != 't' && column.is_acceleration != is_acceleration)
            refuse_header(table.header_line(), "displacements and accelerations are mixed");
    return found;
}

/// @throws std::invalid_argument when a sample is not where even spacing has it
void set_spacing(Record& record, std::vector<double> const& times) {
    record.start = times.front();
    record.spacing = (times.back() - times.front()) / static_cast<double>(times.size() - 1);
    if (!(record.spacing > 0)) throw std::invalid_argument("its times do not increase");
    for (std::size_t i = 0; i < times.size(); ++i) {
        double const expected = times.front() + record.spacing * static_cast<double>(i);
        if (std::abs(times[i] - expected) <= 0.1 * record.spacing) continue;
        throw std::invalid_argument(fmt::format(
            "sample {} is at {:.6g} s instead of {:.6g} s; the samples must be evenly spaced in time", i + 1,
            times[i], expected));
    }
}

}  // namespace

Record read_record(std::string_view text) {
    Record record;
    std::vector<double> times, x, y, z;
    try {
        core::CsvReader table(text, "", {.comments = true, .blanks = true});
        std::vector<Column> const found = known_columns(table);
        record.is_acceleration = std::ranges::find(found, 'x', &Column::axis)->is_acceleration;
        for (std::vector<double> row(found.size()); table.next(row);) {
            for (std::size_t k = 0; k < found.size(); ++k) {
                auto& axis = found[k].axis == 't'   ? times
                             : found[k].axis == 'x' ? x
                             : found[k].axis == 'y' ? y
                                                    : z;
                axis.push_back(row[k] * found[k].factor);
            }
        }
    } catch (core::CsvError const& error) {
        throw std::invalid_argument(fmt::format("line {}: {}", error.line(), error.problem()));
    }
    auto const count = static_cast<Eigen::Index>(times.size());
    if (count < fewest_samples)
        throw std::invalid_argument(
            fmt::format("there are {} samples, but at least {} are needed", count, fewest_samples));
    set_spacing(record, times);
    record.samples.resize(count, 2);
    record.samples << Eigen::Map<Eigen::VectorXd>(x.data(), count),
        Eigen::Map<Eigen::VectorXd>(z.data(), count);
    if (!y.empty()) record.across = (std::ranges::max(y) - std::ranges::min(y)) / 2;
    return record;
}

}  // namespace vibrotrough::scenario
