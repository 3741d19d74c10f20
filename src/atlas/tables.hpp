#pragma once

#include "atlas/surface.hpp"
#include "inference/gaussian_process.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vibrotrough::atlas {

extern std::string_view const layers_table;     ///< validation/atlas/layers.csv when the program was built
extern std::string_view const draws_table;      ///< validation/atlas/draws.csv, likewise
extern std::string_view const law_draws_table;  ///< validation/atlas/draws_law.csv, likewise
extern std::string_view const added_mass_draws_table;  ///< validation/atlas/draws_added_mass.csv, likewise
extern std::string_view const damping_draws_table;     ///< validation/atlas/draws_damping.csv, likewise

/// The inputs of the atlas in their order. The first four are those of the point mass.
enum Input : std::size_t {
    throw_number_input,
    tan_vibration_input,
    tan_inclination_input,
    friction_input,
    amplitude_input,  ///< over the diameter
    depth_input,      ///< over the diameter
    grain_friction_input,
    rolling_friction_input,
    restitution_input,
};

/// The inputs of the atlas, without a dimension, with the range of each. Their keys are the columns of the
/// table of layers.
std::vector<SurfaceInput> const& inputs();

/// inputs() and the trend of the layer (trend_of), of all of which the efficiency is a surface: the law tells
/// places where layers change quickly.
std::vector<SurfaceInput> const& surface_inputs();

/// What is taken of the atlas' surfaces: layers hardly depend on some of the inputs, so that lengths may be
/// long.
SurfacePrior prior_of_atlas(std::vector<SurfaceInput> const& of);

/// A place as surface_inputs() have it.
Place with_trend(Place place, double trend);
std::vector<SurfacePoint> with_trends(std::vector<SurfacePoint> points);

/// The middle of an input's range (of its logarithm where it is scaled so), which stands for an input that is
/// not known.
double middle_of(Input input);

/// The numbers of a layer in the order of inputs(), as far as they are known.
using KnownNumbers = std::vector<std::optional<double>>;

/// The place of a layer, with what is not known in the middle of its range.
Place place_of(KnownNumbers const& numbers);

/// The trend of the atlas: the velocity efficiency of the rolling-layer law with its published constants, to
/// whose dry torque rolling friction adds; but no more than 1 or that of the point mass, because downhill the
/// law says up to 1.4 of layers that have 1.0 to 1.15.
double trend_of(double rolling_layer, double theory);

/// The model whose velocity efficiency is taken for the trend of a layer.
enum class LayerModel {
    atlas,          ///< trend_of()
    rolling_layer,  ///< the law alone
    point_mass,
};

/// Depth in diameters up to which numerical errors are estimated (validation/numerics); for deeper layers
/// there are only bounds of them.
inline constexpr double deepest_estimated = 8;

/// Reads a table of layers: CSV with the columns `case`, those of inputs(), theory, rolling_layer,
/// efficiency, half_width, numerical_error, and others that are not read. Lines that begin with # are
/// comments. The half-width of a point is that of statistics and numerical errors together.
/// @throws core::CsvError that names line and column
std::vector<SurfacePoint> read_layers(std::string_view text, std::string const& file,
                                      LayerModel model = LayerModel::atlas);

/// Reads another number of such a table, such as added_mass with added_mass_half_width, as points of a
/// surface without a trend. Layers that have none are left out.
/// @throws core::CsvError that names line and column
std::vector<SurfacePoint> read_column(std::string_view text, std::string const& file,
                                      std::string_view column);

/// How a simulated layer moved.
struct LayerMotion {
    Place place;                ///< of the layer
    std::string mode;           ///< its phases in the order of a cycle, such as FP'NP
    std::optional<int> period;  ///< cycles after which it repeats; nothing: not measured
};

/// Reads the motions of a table of layers (columns layer_mode, period). Layers without a mode are left out.
/// @throws core::CsvError that names line and column
std::vector<LayerMotion> read_motions(std::string_view text, std::string const& file);

/// What numerical errors (soft grains, a small box, the time step) all layers up to deepest_estimated may
/// have in common, in velocity efficiency, 95 %: of validation/numerics/model.csv Student's quantile times
/// the root of m^2 and the squared standard error of m, at throw numbers 1.75 to 2.65, where it is largest.
/// More layers do not make it smaller. The rest differs from layer to layer, and is part of their noise.
inline constexpr double common_numerical_error = 0.016;

/// The mean of the bounds of the numerical errors of deeper layers, in velocity efficiency.
/// @throws core::CsvError that names line and column
double read_numerical_bound(std::string_view text, std::string const& file);

/// Reads draws of the hyperparameters of a surface: CSV with the columns deviation, extra_noise, and the
/// length of each input. @throws core::CsvError that names line and column
std::vector<inference::Hyperparameters> read_draws(std::string_view text, std::string const& file,
                                                   std::vector<SurfaceInput> const& of = inputs());

/// The draws as read_draws() reads them, with all digits.
std::string draws_csv(std::vector<inference::Hyperparameters> const& draws,
                      std::vector<SurfaceInput> const& of = inputs());

}  // namespace vibrotrough::atlas
