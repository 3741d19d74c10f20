// The atlas for columns of numbers, without words of its own: vibrotrough/theory.py is what people import.

#include "atlas_module.hpp"

#include "atlas/tables.hpp"
#include "atlas/value.hpp"
#include "theory/errors.hpp"
#include "theory/inputs.hpp"
#include "theory/point_mass.hpp"

#include <cmath>
#include <ctime>
#include <limits>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/stl.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace py = pybind11;

namespace vibrotrough::atlas {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

/// The columns of a layer beside those of its motion.
constexpr std::array<char const*, 5> layer_names{"grain_diameter", "depth", "grain_friction",
                                                 "rolling_friction", "restitution"};

/// The inputs of the theory that the atlas has, too.
constexpr std::array motion_inputs{theory::Input::throw_number,
                                   theory::Input::machine_number,
                                   theory::Input::vibration_angle_deg,
                                   theory::Input::tan_vibration_angle,
                                   theory::Input::inclination_deg,
                                   theory::Input::tan_inclination,
                                   theory::Input::friction,
                                   theory::Input::frequency_hz,
                                   theory::Input::amplitude_m,
                                   theory::Input::stroke_mm};

/// One layer of the columns.
struct Layer {
    theory::Inputs motion;
    std::array<double, layer_names.size()> numbers;  ///< in the order of layer_names; NaN: not known
};

void require(bool good, std::string const& words) {
    if (!good) throw std::invalid_argument(words);
}

/// @throws std::invalid_argument when a number is missing or impossible
KnownNumbers numbers_of(Layer const& layer) {
    theory::PointMass const point = layer.motion.point();
    auto const amplitude = layer.motion.amplitude();
    double const diameter = layer.numbers[0];
    require(amplitude.has_value(), "an amplitude or a stroke is missing");
    require(diameter > 0, "the diameter of the grains is missing or not above 0");
    KnownNumbers known{point.throw_number, point.tan_vibration_angle, point.tan_inclination, point.friction,
                       *amplitude / diameter};
    for (std::size_t i = 1; i < layer_names.size(); ++i) {
        double const value = layer.numbers[i];
        require(!(value < 0), std::string(layer_names[i]) + " is below 0");
        known.push_back(std::isnan(value) ? std::nullopt : std::optional(value));
    }
    return known;
}

/// What is said of one layer.
struct Row {
    double efficiency = missing, half_width = missing, velocity_scale = missing;
    std::uint32_t outside = 0;  ///< a bit for each of inputs(), and one for a motion without a mean speed
};

Row row_of(Layer const& layer) {
    KnownNumbers const numbers = numbers_of(layer);
    Place const place = place_of(numbers);
    Row row;
    row.velocity_scale = layer.motion.velocity_scale().value();
    for (Outside const& one : outside_ranges(place)) {
        for (std::size_t input = 0; input < inputs().size(); ++input)
            if (inputs()[input].key == one.name) row.outside |= 1U << input;
    }
    std::optional<SurfaceValue> value;
    bool const far = is_far_outside(place);
    try {
        // Far away the theory alone says whether the numbers are possible.
        if (far)
            static_cast<void>(theory::solve(layer.motion.point()));
        else
            value = value_of(numbers);
    } catch (theory::PhaseError const&) {
        // The layer has no mean speed.
    }
    if (value) {
        row.efficiency = value->efficiency;
        row.half_width = value->half_width;
    } else if (!far) {
        row.outside |= 1U << inputs().size();
    }
    return row;
}

/// Layers of all columns; the first of them that is wrong decides what is said.
class Rows {
  public:
    /// @throws std::invalid_argument "point N: why" of the first layer that is wrong
    Rows(std::vector<Layer> const& layers, int jobs) : rows(layers.size()) {
        tbb::task_arena arena(jobs > 0 ? jobs : tbb::task_arena::automatic);
        arena.execute([&] {
            tbb::parallel_for(tbb::blocked_range<std::size_t>(0, layers.size(), 16), [&](auto const& range) {
                for (std::size_t i = range.begin(); i < range.end(); ++i) {
                    try {
                        rows[i] = row_of(layers[i]);
                    } catch (std::invalid_argument const& error) {
                        std::lock_guard const lock(mutex_);
                        errors_[i] = at_point(i, error);
                    }
                }
            });
        });
        if (!errors_.empty()) throw std::invalid_argument(errors_.begin()->second);
    }

    std::vector<Row> rows;

  private:
    static std::string at_point(std::size_t index, std::invalid_argument const& error) {
        return "point " + std::to_string(index + 1) + ": " + error.what();
    }

    std::mutex mutex_;
    std::map<std::size_t, std::string> errors_;
};

/// @param motion, layer  columns of the same length by name; NaN where a layer does not have that input
py::dict predict_columns(std::map<std::string, Column> const& motion,
                         std::map<std::string, Column> const& layer, std::size_t count, int jobs) {
    std::vector<Layer> layers(count);
    for (auto const& [name, column] : motion) {
        theory::Input const input = theory::input_named(name).value();
        for (std::size_t i = 0; i < count; ++i)
            if (!std::isnan(column.data()[i])) layers[i].motion.set(input, column.data()[i]);
    }
    for (std::size_t k = 0; k < layer_names.size(); ++k) {
        auto const column = layer.find(layer_names[k]);
        for (std::size_t i = 0; i < count; ++i)
            layers[i].numbers[k] = column == layer.end() ? missing : column->second.data()[i];
    }
    std::vector<Row> rows;
    std::clock_t const start = std::clock();
    {
        py::gil_scoped_release const others_may_run;
        rows = Rows(layers, jobs).rows;
    }
    double const seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    auto const column_of = [&]<class Value>(Value Row::*part) {
        py::array_t<Value> column(rows.size());
        for (std::size_t i = 0; i < rows.size(); ++i) column.mutable_data()[i] = rows[i].*part;
        return column;
    };
    py::dict answer;
    answer["velocity_efficiency"] = column_of(&Row::efficiency);
    answer["half_width"] = column_of(&Row::half_width);
    answer["velocity_scale"] = column_of(&Row::velocity_scale);
    answer["outside"] = column_of(&Row::outside);
    answer["cpu_seconds"] = seconds;
    return answer;
}

/// Name and ends of the range of each input, in the order of the bits of `outside`.
std::vector<std::tuple<std::string, double, double>> ranges() {
    std::vector<std::tuple<std::string, double, double>> all;
    for (SurfaceInput const& input : inputs()) all.emplace_back(input.key, input.low, input.high);
    return all;
}

std::vector<std::string> motion_names() {
    std::vector<std::string> names;
    for (theory::Input const input : motion_inputs) names.emplace_back(theory::name_of(input));
    return names;
}

}  // namespace

void add_to(py::module_& module) {
    module.def("atlas", &predict_columns);
    module.def("atlas_ranges", &ranges);
    module.def("atlas_motion_inputs", &motion_names);
}

}  // namespace vibrotrough::atlas
