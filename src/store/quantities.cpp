#include "prepare/numerical_errors.hpp"
#include "store/layer_quantities.hpp"
#include "store/material_quantities.hpp"
#include "store/open_quantities.hpp"
#include "store/quantity.hpp"
#include "store/screen_quantities.hpp"
#include "store/stage_quantities.hpp"

#include <limits>

namespace vibrotrough::store {
namespace {

using Case = CaseRecord const&;
using Real = Quantity::Real;
using Integer = Quantity::Integer;
using Text = Quantity::Text;
using enum OverPackings;

template <typename Value>
auto estimate(Value measure::PackingEstimate::*member) {
    return field(&PackingRecord::estimate, member);
}

/// An unbounded interval has the half-width infinity in the files; without a mean there is none.
std::optional<double> half_width(Case record) {
    measure::CaseEstimate const& estimate = record.estimate;
    if (estimate.mean && !estimate.half_width) return std::numeric_limits<double>::infinity();
    return estimate.half_width;
}

/// The same for statistics and numerics together.
std::optional<double> whole_half_width(Case record) {
    if (record.estimate.mean && !record.estimate.half_width) return std::numeric_limits<double>::infinity();
    return record.whole_half_width();
}

/// Velocity efficiency times the velocity scale.
std::optional<double> speed(Case record, std::optional<double> const& efficiency) {
    if (!efficiency) return {};
    return *efficiency * velocity_scale(record.scenario.trough);
}

/// Of a metre of width, from the velocity efficiency.
std::optional<double> mass_flow(Case record, std::optional<double> const& efficiency) {
    auto const known = speed(record, efficiency);
    if (!known) return {};
    auto const mass = measured_mass_per_area(record);
    if (!mass) return {};
    return *known * *mass;
}

std::optional<double> mass_flow_half_width(Case record) {
    if (is_open(record.scenario)) return open_flow_half_width(record);
    return mass_flow(record, whole_half_width(record));
}

/// On the whole width of the trough, where it is known.
std::optional<double> whole_flow(Case record, std::optional<double> const& flow) {
    auto const width = trough_width(record.scenario);
    if (!flow || !width) return {};
    return *flow * *width;
}

/// A quantity that `compare` shows also of a case that has no mean.
Quantity also_without_mean(Quantity row) {
    row.known_without_mean = true;
    return row;
}

std::vector<Quantity> drive_quantities() {
    return {
        {"throw_number", "1", "Throw number Gamma = omega^2 r sin(beta) / (g cos(alpha))",
         Real([](Case c) { return throw_number(c.scenario.trough); })},
        {"machine_number", "1", "Machine number K = omega^2 r / g",
         Real([](Case c) { return machine_number(c.scenario.trough); })},
        {"vibration_angle", "rad", "Vibration angle beta, between the direction of vibration and the trough",
         Real([](Case c) { return c.scenario.trough.vibration_angle; })},
        {"inclination", "rad", "Inclination alpha of the trough, uphill positive in the conveying direction",
         Real([](Case c) { return c.scenario.trough.inclination; })},
        {"amplitude", "m", "Amplitude r in the direction of vibration, half the stroke",
         Real([](Case c) { return c.scenario.trough.amplitude; })},
        {"frequency", "Hz", "Frequency of the vibration, 1/T",
         Real([](Case c) { return c.scenario.trough.frequency; })},
        {"friction", "1", "Friction coefficient mu, grain on trough",
         Real([](Case c) { return c.scenario.trough.friction; })},
        {"restitution", "1", "Restitution coefficient e, grain on trough",
         Real([](Case c) { return c.scenario.trough.restitution; })},
        {"velocity_scale", "m/s", "omega r cos(beta), the speed at velocity efficiency 1",
         Real([](Case c) { return velocity_scale(c.scenario.trough); })},
    };
}

std::vector<Quantity> efficiency_quantities() {
    return {
        {"efficiency",
         "1",
         "Velocity efficiency eta, mean over the packings; NaN unless outcome is finished or not-precise",
         Real([](Case c) { return c.estimate.mean; }),
         nothing,
         {{.format = "{:.3f}",
           .terminal = TerminalView{.heading = "eta DEM", .priority = always_shown},
           .report = ReportView{"\u03b7, DEM"}}}},
        {"efficiency_half_width",
         "1",
         "Half-width of efficiency for statistics and numerics together: the root of the sum of the squares "
         "of efficiency_half_width_statistics and efficiency_numerics",
         Real(whole_half_width),
         nothing,
         {{.format = "{:.3f}", .report = ReportView{"\u00b1 together"}}}},
        {"efficiency_half_width_statistics",
         "1",
         "Half-width of the confidence interval of efficiency, which allows for the fluctuations within runs "
         "and between packings; NaN unless outcome is finished or not-precise",
         Real(half_width),
         nothing,
         {{.format = "{:.3f}", .report = ReportView{"\u00b1 statistical"}}}},
        {"efficiency_numerics",
         "1",
         "Numerical error of efficiency, by softness of the grains, box and time step: as 'vibrotrough "
         "convergence' measured it, else as layers showed it that were simulated in pairs "
         "(validation/numerics), of layers above 8 diameters its bound at 95 % (validation/whole_interval)",
         Real([](Case c) { return c.numerical_error(); }),
         nothing,
         {{.format = "{:.3f}", .report = ReportView{"\u00b1 numerical"}}}},
        {"numerics_source",
         "1",
         "Where efficiency_numerics is from: convergence, when that command studied the case, or expected, "
         "by what other layers showed; empty without it",
         Text([](Case c) -> std::string {
             if (!c.numerical_error()) return "";
             return c.studied_error ? "convergence" : "expected";
         }),
         nothing,
         {{.report = ReportView{"numerical error by"}}}},
        {"efficiency_by_normal_force",
         "1",
         "Velocity efficiency of a point mass with Coulomb friction under the layer's own normal force; NaN "
         "with side walls",
         field(&PackingRecord::motion, &measure::LayerMotion::efficiency_by_normal_force),
         mean,
         {{.format = "{:.3f}",
           .terminal = TerminalView{.heading = "eta point",
                                    .subheading = "its force",
                                    .priority = 3,
                                    .only_when_known = true}}}},
    };
}

std::vector<Quantity> numerics_quantities() {
    return {
        {"softness_error", "1", "Bound of the error of efficiency by soft grains",
         Real([](Case c) { return prepare::numerical_errors(c.scenario).softness; })},
        {"box_error", "1", "Bound of the error of efficiency by the size of the periodic box",
         Real([](Case c) { return prepare::numerical_errors(c.scenario).box; })},
        {"time_step_error", "1", "Bound of the error of efficiency by the time step",
         Real([](Case c) { return prepare::numerical_errors(c.scenario).time_step; })},
        {"soft", "1",
         "1 when the grains are too soft for the depth and the drive of the layer, so that efficiency is "
         "probably wrong by more than half of half_width_wanted; else 0",
         Integer([](Case c) { return prepare::is_soft(c.scenario) ? 1 : 0; })},
        {"confidence", "1", "Confidence of every interval in this file",
         Real([](Case c) { return c.scenario.measure.confidence; })},
    };
}

std::vector<Quantity> speed_quantities() {
    return {
        {"conveying_speed",
         "m/s",
         "Conveying speed along the trough: efficiency times velocity_scale",
         Real([](Case c) { return speed(c, c.estimate.mean); }),
         nothing,
         {{.format = "{:.3f}",
           .terminal = TerminalView{.heading = "speed", .subheading = "m/s", .priority = 8},
           .report = ReportView{"speed"}}}},
        {"conveying_speed_half_width",
         "m/s",
         "Half-width of conveying_speed, for statistics and numerics together",
         Real([](Case c) { return speed(c, whole_half_width(c)); }),
         nothing,
         {{.format = "{:.3f}"}}},
        {"mass_per_area", "kg/m2",
         "Mass of the layer per area of trough; of an open trough that in the window",
         Real([](Case c) { return measured_mass_per_area(c); })},
        {"trough_width", "m",
         "Width of the real trough, as given or between the side walls; NaN when it is not known",
         Real([](Case c) { return trough_width(c.scenario); })},
    };
}

std::vector<Quantity> flow_quantities() {
    return {
        {"mass_flow",
         "kg/s",
         "Mass flow on the whole width of the trough, trough_width; NaN when that is not known",
         Real([](Case c) { return whole_flow(c, mass_flow(c, c.estimate.mean)); }),
         nothing,
         {{.unit = "t/h",
           .factor = tonnes_per_hour,
           .format = "{:.3g}",
           .terminal =
               TerminalView{
                   .heading = "mass flow", .subheading = "t/h", .priority = 8, .only_when_known = true},
           .report = ReportView{"mass flow"}},
          {}}},
        {"mass_flow_half_width",
         "kg/s",
         "Half-width of mass_flow, for statistics and numerics together: that of mass_flow_per_width times "
         "trough_width",
         Real([](Case c) { return whole_flow(c, mass_flow_half_width(c)); }),
         nothing,
         {{.unit = "t/h",
           .factor = tonnes_per_hour,
           .format = "{:.2g}",
           .report = ReportView{"\u00b1 mass flow"}},
          {}}},
        {"mass_flow_per_width",
         "kg s-1 m-1",
         "Mass flow per width of trough: conveying_speed times mass_per_area",
         Real([](Case c) { return mass_flow(c, c.estimate.mean); }),
         nothing,
         {{.unit = "t/h/m",
           .factor = tonnes_per_hour,
           .format = "{:.3g}",
           .terminal =
               TerminalView{
                   .heading = "mass flow", .subheading = "t/h per m", .priority = 5, .only_when_known = true},
           .report = ReportView{"mass flow per width"}}}},
        {"mass_flow_per_width_half_width",
         "kg s-1 m-1",
         "Half-width of mass_flow_per_width, for statistics and numerics together: that of conveying_speed "
         "times mass_per_area; in an open trough Student's t over the packings' products of speed and depth, "
         "with efficiency_drift and efficiency_numerics as the root of the sum of squares",
         Real(mass_flow_half_width),
         nothing,
         {{.unit = "t/h/m", .factor = tonnes_per_hour}}},
        also_without_mean({"packings",
                           "1",
                           "Number of independent packings in the mean",
                           Integer([](Case c) { return c.estimate.packings; }),
                           nothing,
                           {{}}}),
    };
}

std::optional<double> mean_of(std::optional<measure::Branch> const& branch) {
    return branch ? std::optional(branch->mean) : std::nullopt;
}

std::optional<double> half_width_of(std::optional<measure::Branch> const& branch) {
    return branch ? branch->half_width : std::nullopt;
}

std::vector<Quantity> start_and_scatter_quantities() {
    return {
        {"efficiency_below", "1", "Mean efficiency of the packings that started below the expected speed",
         Real([](Case c) { return mean_of(c.estimate.below); })},
        {"efficiency_below_half_width_statistics", "1",
         "Half-width of the confidence interval of efficiency_below",
         Real([](Case c) { return half_width_of(c.estimate.below); })},
        {"efficiency_above", "1", "Mean efficiency of the packings that started above the expected speed",
         Real([](Case c) { return mean_of(c.estimate.above); })},
        {"efficiency_above_half_width_statistics", "1",
         "Half-width of the confidence interval of efficiency_above",
         Real([](Case c) { return half_width_of(c.estimate.above); })},
        {"efficiency_drift", "1",
         "The part of efficiency_half_width_statistics for what is probably left of a start-up that all "
         "packings share, which adds to that of their scatter as the root of the sum of squares",
         Real([](Case c) { return c.estimate.drift; })},
        {"packing_deviation", "1", "Standard deviation of the mean efficiency of one packing",
         Real([](Case c) { return c.estimate.deviation; })},
        {"packing_deviation_within", "1",
         "The part of packing_deviation that the fluctuations within a run explain",
         Real([](Case c) { return c.estimate.deviation_within; })},
        {"correlation_time", "1",
         "Statistical inefficiency g, pooled over the packings: so many cycles are worth one independent "
         "one",
         Real([](Case c) { return c.estimate.correlation_time; })},
        {"half_width_wanted", "1", "Half-width of the interval that the campaign file asks for",
         Real([](Case c) { return c.scenario.measure.half_width; })},
    };
}

std::vector<Quantity> grain_and_layer_quantities() {
    return {
        {"grain_diameter", "m", "Diameter of the grains: mean, or median of the log-normal law",
         Real([](Case c) { return c.scenario.grains.diameter; })},
        {"grain_diameter_spread", "1", "Spread s of the size law",
         Real([](Case c) { return c.scenario.grains.diameter_spread; })},
        {"grain_density", "kg/m3", "Density of the grains' material",
         Real([](Case c) { return c.scenario.grains.density; })},
        {"grain_youngs_modulus", "Pa", "Young's modulus of grains and trough",
         Real([](Case c) { return c.scenario.grains.youngs_modulus; })},
        {"grain_poisson_ratio", "1", "Poisson ratio of grains and trough",
         Real([](Case c) { return c.scenario.grains.poisson_ratio; })},
        {"grain_friction", "1", "Friction coefficient, grain on grain",
         Real([](Case c) { return c.scenario.grains.friction; })},
        {"grain_restitution", "1", "Restitution coefficient, grain on grain",
         Real([](Case c) { return c.scenario.grains.restitution; })},
        {"grain_rolling_friction", "1", "Rolling friction coefficient, 0 when the model is off",
         Real([](Case c) { return c.scenario.grains.rolling_friction; })},
        {"grain_rotation", "1", "free, rolling or blocked",
         Text([](Case c) { return std::string(name_of(c.scenario.grains.rotation)); })},
        {"grain_shape", "1", "sphere, cube, rod, or the name of the file with the spheres of a clump",
         Text([](Case c) { return c.scenario.grains.shape; })},
        {"grain_size_law", "1", "three-classes, uniform, lognormal or listed",
         Text([](Case c) { return std::string(name_of(c.scenario.grains.size_law)); })},
        {"block", "1", "none, or the rigid block in place of the layer: point or plate",
         Text([](Case c) { return std::string(name_of(c.scenario.layer.block)); })},
        {"side_wall_friction", "1", "Friction coefficient, grain on side walls; NaN without side walls",
         Real([](Case c) { return c.scenario.trough.side_wall_friction; })},
        {"rayleigh_fraction", "1", "Largest time step in Rayleigh times of the smallest grain",
         Real([](Case c) { return c.scenario.solver.rayleigh_fraction; })},
        {"contact_model", "1", "Normal force of the contacts, a word of engine.contact",
         Text([](Case c) { return std::string(name_of(c.scenario.engine.contact)); })},
        {"cohesion", "J/m3", "Energy density of the cohesion model sjkr, 0 when the model is off",
         Real([](Case c) { return c.scenario.engine.cohesion; })},
        {"not_covered", "1",
         "What the case asks for under [engine] and the engine's certificate does not cover; empty: "
         "nothing",
         Text([](Case c) { return not_covered(c.scenario.engine); })},
        {"layer_length", "m", "Length of the periodic piece of layer along the trough",
         Real([](Case c) { return c.scenario.layer.length; })},
        {"layer_width", "m", "Width of the periodic piece of layer across the trough",
         Real([](Case c) { return c.scenario.layer.width; })},
        {"layer_height", "m",
         "Height of the layer at rest as asked for; NaN when the number of grains was given",
         Real([](Case c) { return c.scenario.layer.height; })},
        {"layer_grains", "1", "Number of grains", Integer([](Case c) { return c.scenario.layer.grains; })},
    };
}

std::vector<Quantity> run_quantities() {
    return {
        {"seed", "1", "Seed of the packing's random positions", field(&PackingRecord::seed)},
        {"steps_per_cycle", "1", "Time steps of the engine per cycle",
         field(&PackingRecord::steps_per_cycle)},
        {"time_step", "s", "Time step of the engine", field(&PackingRecord::time_step)},
        {"mass", "kg", "Mass of all grains", field(&PackingRecord::mass)},
        also_without_mean({"wall_time",
                           "s",
                           "Wall time of the engine",
                           field(&PackingRecord::wall_time),
                           sum,
                           {{.format = "{:.0f}", .report = ReportView{"wall time"}}}}),
        {"efficiency", "1", "Velocity efficiency eta, mean over the cycles kept",
         estimate(&measure::PackingEstimate::mean)},
        {"efficiency_half_width_statistics", "1",
         "Half-width of the confidence interval of efficiency, corrected for correlation between cycles",
         estimate(&measure::PackingEstimate::half_width)},
        {"core_time", "s", "Processor time of the engine on all ranks", field(&PackingRecord::core_time),
         sum},
        {"start_efficiency", "1", "Velocity efficiency with which all grains started; NaN: at rest",
         field(&PackingRecord::start_efficiency)},
        also_without_mean({"cycles_discarded",
                           "1",
                           "Cycles cut as start-up, the same for all packings (pooled MSER); the motion "
                           "within the cycle and the profiles leave out the packing's own start-up (MSER)",
                           estimate(&measure::PackingEstimate::discarded),
                           sum,
                           {{.report = ReportView{"discarded"}}}}),
        also_without_mean(
            {"cycles_measured",
             "1",
             "Cycles kept for the mean",
             estimate(&measure::PackingEstimate::measured),
             sum,
             {{.terminal = TerminalView{.heading = "cycles", .subheading = "cut+kept", .priority = 2},
               .report = ReportView{"cycles kept"}}}}),
        {"correlation_time", "1",
         "Statistical inefficiency g: that many cycles are worth one independent cycle",
         estimate(&measure::PackingEstimate::correlation_time)},
        {"verdict", "1", "How well the mean is known: precise, not-precise or not-steady",
         estimate(&measure::PackingEstimate::verdict)},
        {"deck", "1", "The LIGGGHTS deck, in.liggghts", field(&PackingRecord::deck)},
    };
}

}  // namespace

std::vector<Quantity> const& quantities() {
    static std::vector<Quantity> const all = [] {
        std::vector<Quantity> rows;
        for (auto const& part :
             {drive_quantities(), efficiency_quantities(), numerics_quantities(), speed_quantities(),
              flow_quantities(), run_quantities(), start_and_scatter_quantities(),
              grain_and_layer_quantities(), layer_quantities(), material_quantities(), open_quantities(),
              screen_quantities(), stage_quantities()})
            rows.insert(rows.end(), part.begin(), part.end());
        return rows;
    }();
    return all;
}

}  // namespace vibrotrough::store
