#include "view/trough_motion.hpp"

#include "core/atomic_file.hpp"
#include "core/csv.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>

namespace vibrotrough::view {

double FrameSource::time_of(long step) const {
    if (!parts.empty()) return time_of_step(parts, steps_per_cycle, step);
    return static_cast<double>(step) * time_step;
}

namespace {

constexpr std::array<std::string_view, 3> columns{"step", "trough_x", "trough_z"};
constexpr double largest_step = 9e15;  // whole numbers up to here are exact

}  // namespace

TroughState trough_state(FrameSource const& source, double time) {
    if (!source.parts.empty()) return trough_at(source.parts, time);
    double const angle = source.angular_frequency * time;
    TroughState state{};
    auto const add = [&](std::vector<scenario::DriveTerm> const& terms, double& place, double& speed) {
        for (scenario::DriveTerm const& term : terms) {
            place += term.amplitude * (std::sin(term.order * angle + term.phase) - std::sin(term.phase));
            speed += term.amplitude * term.order * source.angular_frequency *
                     std::cos(term.order * angle + term.phase);
        }
    };
    add(source.drive.along, state.x, state.vx);
    add(source.drive.normal, state.z, state.vz);
    return state;
}

std::vector<TroughPosition> read_trough_motion(std::filesystem::path const& path) {
    std::string const text = core::read_file(path);
    constexpr std::string_view cure = "the file is damaged, run its case again";
    core::CsvReader table(text, path.string(), {.comments = true, .growing = true, .cure = cure});
    std::vector<TroughPosition> positions;
    if (table.columns().empty()) return positions;
    if (!table.has_columns(columns)) {
        throw core::CsvError(path.string(), table.header_line(), "the columns are not step,trough_x,trough_z",
                             cure);
    }
    std::array<double, columns.size()> row{};
    while (table.next(row)) {
        if (row[0] != std::floor(row[0]) || std::abs(row[0]) > largest_step)
            table.fail("the step is not a whole number", cure);
        TroughPosition const position{static_cast<long>(row[0]), row[1], row[2]};
        if (!positions.empty() && position.step <= positions.back().step)
            table.fail(fmt::format("step {} is not after the one before", position.step), cure);
        positions.push_back(position);
    }
    return positions;
}

}  // namespace vibrotrough::view
