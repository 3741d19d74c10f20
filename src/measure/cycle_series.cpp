#include "measure/cycle_series.hpp"

#include "core/error.hpp"
#include "measure/table_file.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace vibrotrough::measure {
namespace {

constexpr std::string_view header =
    "step,grains,x_com,z_com,vz_com,mean_vx,mean_force_x,mean_force_z,flight_fraction";

/// The columns of an open trough behind these.
constexpr std::string_view open_header = ",fed,fed_mass,left,left_mass,held_mass,window_mass";

/// The header of a layer of so many materials.
std::string header_of(int materials) {
    std::string text(header);
    for (int i = 0; materials > 1 && i < materials; ++i) text += fmt::format(",x_{0},z_{0}", i);
    return text;
}

void append(CycleSeries& series, std::span<double const> row) {
    for (std::size_t column = 9, i = 0; column + 1 < row.size(); column += 2, ++i) {
        series.materials.at(i).x.push_back(row[column]);
        series.materials.at(i).z.push_back(row[column + 1]);
    }
    series.x.push_back(row[2]);
    series.z.push_back(row[3]);
    series.vz.push_back(row[4]);
    if (series.x.size() == 1) return;  // the first line is the start; it does not follow a cycle
    series.mean_velocity.push_back(row[5]);
    series.tangential_force.push_back(row[6]);
    series.normal_force.push_back(-row[7]);  // in the file the force on the trough is positive upwards
    series.flight_fraction.push_back(row[8]);
}

}  // namespace

core::TextFile cycles_text(std::filesystem::path const& path) {
    return {path, core::read_file(path, std::size_t{256} << 20)};
}

CycleSeries read_cycles(std::filesystem::path const& path, int steps_per_cycle, int grains, int materials) {
    return parse_cycles(cycles_text(path), steps_per_cycle, grains, materials);
}

CycleSeries parse_cycles(core::TextFile const& file, int steps_per_cycle, int grains, int materials) {
    CycleSeries series;
    std::string const columns = header_of(materials);
    TableFormat const format{"cycles", columns, 0, steps_per_cycle};
    parse_table(file, format, [&](int line_number, std::span<double const> row) {
        if (row[1] != grains) {
            throw core::InputError(fmt::format("{}:{}: {} grains instead of {}", file.path.string(),
                                               line_number, row[1], grains));
        }
        append(series, row);
    });
    return series;
}

std::vector<std::vector<double>*> OpenSeries::lists() {
    std::vector<std::vector<double>*> all{&fed,       &fed_mass,    &left,   &left_mass,  &held,
                                          &held_mass, &window_mass, &passed, &passed_mass};
    for (std::vector<double>& one : of_size) all.push_back(&one);
    return all;
}

CycleSeries parse_open_cycles(core::TextFile const& file, int steps_per_cycle, int sizes) {
    CycleSeries series;
    std::string columns = std::string(header).append(open_header);
    if (sizes > 0) columns += ",passed,passed_mass";
    for (int size = 1; size <= sizes; ++size) columns += fmt::format(",size_{}", size);
    series.open.of_size.resize(static_cast<std::size_t>(sizes));
    parse_table(file, {"cycles of an open trough", columns, 0, steps_per_cycle},
                [&](int, std::span<double const> row) {
                    append(series, row.first(9));
                    OpenSeries& open = series.open;
                    open.held.push_back(row[1]);
                    open.fed.push_back(row[9]);
                    open.fed_mass.push_back(row[10]);
                    open.left.push_back(row[11]);
                    open.left_mass.push_back(row[12]);
                    open.held_mass.push_back(row[13]);
                    open.window_mass.push_back(row[14]);
                    if (sizes == 0) return;
                    open.passed.push_back(row[15]);
                    open.passed_mass.push_back(row[16]);
                    for (std::size_t i = 0; i < open.of_size.size(); ++i)
                        open.of_size[i].push_back(row[17 + i]);
                });
    return series;
}

CycleSeries first_cycles(CycleSeries const& series, int cycles) {
    auto const cut = [](std::vector<double>& values, int count) {
        values.resize(static_cast<std::size_t>(count));
    };
    CycleSeries result = series;
    for (auto* const at_ends : {&result.x, &result.z, &result.vz}) cut(*at_ends, cycles + 1);
    for (MaterialSeries& one : result.materials) {
        if (one.x.empty()) continue;
        cut(one.x, cycles + 1);
        cut(one.z, cycles + 1);
    }
    for (auto* const at_ends : result.open.lists())
        if (!at_ends->empty()) cut(*at_ends, cycles + 1);
    for (auto* const over_cycles :
         {&result.normal_force, &result.tangential_force, &result.flight_fraction, &result.mean_velocity}) {
        cut(*over_cycles, cycles);
    }
    return result;
}

bool is_finite(CycleSeries const& series) {
    std::vector<std::vector<double> const*> all{&series.x,
                                                &series.z,
                                                &series.vz,
                                                &series.mean_velocity,
                                                &series.normal_force,
                                                &series.tangential_force,
                                                &series.flight_fraction};
    for (MaterialSeries const& one : series.materials) all.insert(all.end(), {&one.x, &one.z});
    OpenSeries open = series.open;
    for (auto* const list : open.lists()) all.push_back(list);
    return std::ranges::all_of(all, [](auto const* values) {
        return std::ranges::all_of(*values, [](double value) { return std::isfinite(value); });
    });
}

double difference_of_speeds(CycleSeries const& series, std::span<double const> durations) {
    double largest = 0;
    for (std::size_t i = 0; i < series.mean_velocity.size() && i < durations.size(); ++i) {
        double const displaced = (series.x[i + 1] - series.x[i]) / durations[i];
        largest = std::max(largest, std::abs(displaced - series.mean_velocity[i]));
    }
    return largest;
}

CycleSeries without_jumps(CycleSeries series, double box_length, std::span<double const> durations,
                          double tolerance) {
    if (series.x.empty()) return series;
    double moved = 0, jumped = 0, before = series.x.front();
    for (std::size_t i = 0; i < series.mean_velocity.size() && i < durations.size(); ++i) {
        double const expected = series.mean_velocity[i] * durations[i];
        double const displaced = series.x[i + 1] - before;
        moved += expected;
        if (std::abs(moved) > surely_counted * box_length &&
            std::abs(displaced - expected) > tolerance * durations[i])
            jumped += displaced - expected;
        before = series.x[i + 1];
        series.x[i + 1] -= jumped;
    }
    return series;
}

double weight_by_momentum(CycleSeries const& series, double mass, double period) {
    double const cycles = series.cycles();
    double const force =
        std::accumulate(series.normal_force.begin(), series.normal_force.end(), 0.0) / cycles;
    return force - mass * (series.vz.back() - series.vz.front()) / (cycles * period);
}

double weight_by_momentum(CycleSeries const& series, double mass, std::span<double const> durations) {
    auto const cycles = series.normal_force.size();
    double const time = std::accumulate(durations.begin(), durations.begin() + series.cycles(), 0.0);
    double impulse = 0;
    for (std::size_t i = 0; i < cycles; ++i) impulse += series.normal_force[i] * durations[i];
    return (impulse - mass * (series.vz.back() - series.vz.front())) / time;
}

}  // namespace vibrotrough::measure
