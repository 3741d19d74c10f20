// The theory, and the atlas of atlas_module.cpp, as a module for Python, without words of its own:
// vibrotrough/theory.py is what people import.

#include "atlas_module.hpp"
#include "theory/batch.hpp"
#include "theory/map.hpp"
#include "theory/quantities.hpp"
#include "theory/tested_range.hpp"
#include "theory/unusual.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

namespace py = pybind11;

namespace vibrotrough::theory {
namespace {

using Column = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Constants = std::map<std::string, double>;

/// The inputs of a million points would fill 300 MB: so many are solved at once.
constexpr std::size_t points_at_once = 65536;

Input input_of(std::string const& name) {
    if (auto const input = input_named(name)) return *input;
    throw std::invalid_argument(name + " is not an input of the theory");
}

std::optional<RollingLaw> law_of(std::optional<Constants> const& constants) {
    if (!constants) return {};
    RollingLaw law;
    for (auto const& [name, value] : *constants) {
        if (!set_constant(law, name, value))
            throw std::invalid_argument(name + " is not a constant of the rolling-layer law");
    }
    return law;
}

/// One motion, from one value for each input.
Inputs one_motion(Constants const& values) {
    Inputs inputs;
    for (auto const& [name, value] : values) inputs.set(input_of(name), value);
    return inputs;
}

/// Efficiency, half-width, mode, period and fraction of the starts of each motion of each point.
py::list motion_tuples(std::vector<std::vector<CoexistingMotion>> const& motions) {
    py::list answer;
    for (auto const& of_one : motions) {
        py::list list;
        for (auto const& [motion, share] : of_one)
            list.append(py::make_tuple(motion.velocity_efficiency, motion.half_width, to_string(motion.mode),
                                       motion.period_cycles, share));
        answer.append(list);
    }
    return answer;
}

/// @param columns  of the same length; NaN where a motion does not have that input
py::dict solve_columns(std::map<std::string, Column> const& columns, std::size_t count, int jobs,
                       std::optional<Constants> const& rolling, bool accept_untested, int starts) {
    std::vector<std::pair<Input, double const*>> given;
    for (auto const& [name, column] : columns) given.emplace_back(input_of(name), column.data());
    auto const law = law_of(rolling);
    py::array_t<double> efficiency(count), half_width(count), scale(count);
    py::array_t<ModeCode> mode(count);
    py::array_t<int> period(count);
    py::array_t<bool> converged(count);
    double *const eta = efficiency.mutable_data(), *const width = half_width.mutable_data(),
                  *const speed = scale.mutable_data();
    ModeCode* const modes = mode.mutable_data();
    int* const periods = period.mutable_data();
    bool* const settled = converged.mutable_data();
    double seconds = 0;
    std::vector<std::vector<CoexistingMotion>> motions;
    {
        py::gil_scoped_release const others_may_run;
        for (std::size_t begin = 0; begin < count; begin += points_at_once) {
            std::vector<Inputs> inputs(std::min(points_at_once, count - begin));
            for (auto const& [input, values] : given) {
                for (std::size_t i = 0; i < inputs.size(); ++i)
                    if (!std::isnan(values[begin + i])) inputs[i].set(input, values[begin + i]);
            }
            BatchResult answer = solve_batch(inputs, jobs, law, begin + 1, starts);
            if (law && !accept_untested) withhold_untested(inputs, answer.points);
            seconds += answer.cpu_seconds_per_solution * static_cast<double>(inputs.size());
            for (auto& of_one : answer.motions) motions.push_back(std::move(of_one));
            for (std::size_t i = 0; i < inputs.size(); ++i) {
                Efficiency const& point = answer.points[i];
                eta[begin + i] = point.velocity_efficiency;
                width[begin + i] = point.half_width;
                speed[begin + i] =
                    inputs[i].velocity_scale().value_or(std::numeric_limits<double>::quiet_NaN());
                modes[begin + i] = point.mode;
                periods[begin + i] = point.period_cycles;
                settled[begin + i] = point.outcome == Outcome::periodic;
            }
        }
    }
    py::dict answer;
    answer["velocity_efficiency"] = efficiency;
    answer["half_width"] = half_width;
    answer["velocity_scale"] = scale;
    answer["mode"] = mode;
    answer["period_cycles"] = period;
    answer["converged"] = converged;
    answer["cpu_seconds"] = seconds;
    answer["motions"] = motion_tuples(motions);
    return answer;
}

ConveyorMotion solve_one(Inputs const& inputs) {
    ConveyorMotion motion = solve(inputs.conveyor());
    if (motion.pieces.empty())
        throw std::invalid_argument("the motion has no period: " +
                                    std::string(to_string(motion.motion.outcome)));
    return motion;
}

py::dict trace_columns_of(Constants const& values, int samples) {
    Inputs const inputs = one_motion(values);
    auto rows = trace(solve_one(inputs), samples);
    auto const amplitude = inputs.amplitude();
    if (amplitude) rows = in_si_units(std::move(rows), inputs.point(), {.amplitude = *amplitude});
    py::dict answer;
    for (TraceColumn const& column : trace_columns()) {
        py::array_t<double> numbers(rows.size());
        for (std::size_t i = 0; i < rows.size(); ++i) numbers.mutable_data()[i] = rows[i].*column.value;
        answer[amplitude ? column.si_name : column.name] = numbers;
    }
    py::list phases;
    for (TraceSample const& row : rows) phases.append(std::string(to_string(row.kind)));
    answer["phase"] = phases;
    return answer;
}

/// Name, value and unit of each quantity.
py::list quantities_of(Constants const& values, double bulk_density, double height, double width) {
    Inputs const inputs = one_motion(values);
    if (!inputs.amplitude()) throw std::invalid_argument("an amplitude or a stroke is missing");
    Machine machine{.amplitude = *inputs.amplitude()};
    machine.bulk_density = bulk_density;
    machine.layer_height = height;
    machine.layer_width = width;
    py::list answer;
    for (NamedQuantity const& one : listed(engineer_quantities(solve_one(inputs), machine)))
        answer.append(py::make_tuple(one.name, one.value, one.unit));
    return answer;
}

/// The input that each name stands for, and what its numbers are multiplied with.
std::map<std::string, std::pair<std::string, double>> columns() {
    std::map<std::string, std::pair<std::string, double>> all;
    for (std::string const& name : input_column_names()) {
        InputColumn const column = input_column_named(name).value();
        all[name] = {std::string(name_of(column.input)), column.factor};
    }
    return all;
}

/// The sentences about numbers that hardly any machine has; NaN where a number is not known.
std::vector<std::string> unusual_of(double frequency, double amplitude, double machine_number,
                                    double friction, double vibration_angle, bool is_stroke, bool is_turns) {
    auto const known = [](double value) { return std::isnan(value) ? std::nullopt : std::optional(value); };
    MachineNumbers numbers{known(frequency), known(amplitude), known(machine_number), known(friction),
                           known(vibration_angle)};
    numbers.is_stroke = is_stroke;
    numbers.is_turns = is_turns;
    return unusual_numbers(numbers);
}

/// @param axis  name of an input, first and last value, and their number
MapAxis axis_of(std::tuple<std::string, double, double, int> const& axis) {
    auto const& [name, from, to, count] = axis;
    return {input_of(name), from, to, count};
}

using BoundaryRow = std::tuple<double, double, double, double, std::string, std::string>;

/// The arrays of points have the shape (y, x).
py::dict solve_map_of(Constants const& fixed, std::tuple<std::string, double, double, int> const& x,
                      std::tuple<std::string, double, double, int> const& y, int jobs, int starts,
                      bool boundaries, std::optional<Constants> const& rolling, bool accept_untested) {
    MapOptions options{.jobs = jobs, .starts = starts, .boundaries = boundaries, .rolling = law_of(rolling)};
    Inputs const others = one_motion(fixed);
    std::optional<Map> solved;
    {
        py::gil_scoped_release const others_may_run;
        solved = solve_map(others, axis_of(x), axis_of(y), options);
        if (options.rolling && !accept_untested) withhold_untested(others, *solved);
    }
    std::size_t const count = solved->points.size();
    py::array_t<double> efficiency(count), half_width(count);
    py::array_t<ModeCode> mode(count);
    py::array_t<int> period(count);
    py::array_t<bool> converged(count);
    for (std::size_t i = 0; i < count; ++i) {
        Efficiency const& point = solved->points[i];
        efficiency.mutable_data()[i] = point.velocity_efficiency;
        half_width.mutable_data()[i] = point.half_width;
        mode.mutable_data()[i] = point.mode;
        period.mutable_data()[i] = point.period_cycles;
        converged.mutable_data()[i] = point.outcome == Outcome::periodic;
    }
    std::vector<BoundaryRow> rows;
    for (BoundaryPiece const& one : solved->boundaries)
        rows.emplace_back(one.x0, one.y0, one.x1, one.y1, to_string(one.mode_a), to_string(one.mode_b));
    py::dict answer;
    answer["velocity_efficiency"] = efficiency;
    answer["half_width"] = half_width;
    answer["mode"] = mode;
    answer["period_cycles"] = period;
    answer["converged"] = converged;
    answer["motions"] = motion_tuples(solved->motions);
    answer["boundaries"] = rows;
    answer["cpu_seconds"] = solved->cpu_seconds_per_solution * static_cast<double>(count);
    return answer;
}

PYBIND11_MODULE(_theory, module) {
    module.def("columns", &columns);
    module.def("solve", &solve_columns);
    module.def("mode", py::overload_cast<ModeCode>(&to_string));
    module.def("unusual", &unusual_of);
    module.def("map", &solve_map_of);
    module.def("trace", &trace_columns_of);
    module.def("quantities", &quantities_of);
    atlas::add_to(module);
}

}  // namespace
}  // namespace vibrotrough::theory
