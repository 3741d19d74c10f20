#include "measure/cycle_series.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"

#include <array>
#include <charconv>
#include <numeric>
#include <string_view>

#include <fmt/format.h>

namespace vibrotrough::measure {
namespace {

constexpr std::string_view header =
    "step,grains,x_com,z_com,vz_com,mean_vx,mean_force_x,mean_force_z,flight_fraction";
using Row = std::array<double, 9>;

bool parse_row(std::string_view line, Row& row) {
    char const* at = line.data();
    char const* const end = line.data() + line.size();
    for (std::size_t column = 0; column < row.size(); ++column) {
        auto const [next, failure] = std::from_chars(at, end, row[column]);
        if (failure != std::errc()) return false;
        bool const last = column + 1 == row.size();
        if (last ? next != end : (next == end || *next != ',')) return false;
        at = next + 1;
    }
    return true;
}

void append(CycleSeries& series, Row const& row) {
    series.x.push_back(row[2]);
    series.z.push_back(row[3]);
    series.vz.push_back(row[4]);
    if (series.x.size() == 1) return;  // the line of the start has no cycle before it
    series.mean_velocity.push_back(row[5]);
    series.tangential_force.push_back(row[6]);
    series.normal_force.push_back(-row[7]);  // the engine counts the force on the trough upwards
    series.flight_fraction.push_back(row[8]);
}

}  // namespace

CycleSeries read_cycles(std::filesystem::path const& path, int steps_per_cycle, int grains) {
    std::string const content = read_file(path);
    CycleSeries series;
    bool seen_header = false;
    int line_number = 0;
    for (std::size_t start = 0; start < content.size();) {
        std::size_t const end = content.find('\n', start);
        if (end == std::string::npos) break;  // the engine is still writing this line
        std::string_view const line(content.data() + start, end - start);
        start = end + 1;
        ++line_number;
        if (line.empty() || line.front() == '#') continue;
        if (!seen_header) {
            if (line != header)
                throw InputError(fmt::format("{}:{}: is no table of cycles", path.string(), line_number));
            seen_header = true;
            continue;
        }
        Row row{};
        double const expected_step = static_cast<double>(series.x.size()) * steps_per_cycle;
        if (!parse_row(line, row) || row[0] != expected_step) {
            throw InputError(fmt::format("{}:{}: the line is damaged; expected 9 numbers for step {:.0f}",
                                         path.string(), line_number, expected_step));
        }
        if (row[1] != grains) {
            throw InputError(
                fmt::format("{}:{}: {} grains instead of {}", path.string(), line_number, row[1], grains));
        }
        append(series, row);
    }
    return series;
}

CycleSeries first_cycles(CycleSeries const& series, int cycles) {
    auto const cut = [](std::vector<double>& values, int count) {
        values.resize(static_cast<std::size_t>(count));
    };
    CycleSeries result = series;
    for (auto* const at_ends : {&result.x, &result.z, &result.vz}) cut(*at_ends, cycles + 1);
    for (auto* const over_cycles :
         {&result.normal_force, &result.tangential_force, &result.flight_fraction, &result.mean_velocity}) {
        cut(*over_cycles, cycles);
    }
    return result;
}

double weight_by_momentum(CycleSeries const& series, double mass, double period) {
    double const cycles = series.cycles();
    double const force =
        std::accumulate(series.normal_force.begin(), series.normal_force.end(), 0.0) / cycles;
    return force - mass * (series.vz.back() - series.vz.front()) / (cycles * period);
}

}  // namespace vibrotrough::measure
