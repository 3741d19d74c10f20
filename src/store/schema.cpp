#include "store/schema.hpp"

#include "store/hdf5_image.hpp"
#include "store/layer_schema.hpp"

#include <limits>
#include <numeric>

namespace vibrotrough::store {
namespace {

using Case = CaseRecord const&;

int sum_over_packings(Case record, int measure::PackingEstimate::*field) {
    return std::accumulate(
        record.packings.begin(), record.packings.end(), 0,
        [field](int sum, PackingRecord const& packing) { return sum + packing.estimate.*field; });
}

double wall_time(Case record) {
    return std::accumulate(record.packings.begin(), record.packings.end(), 0.0,
                           [](double sum, PackingRecord const& packing) { return sum + packing.wall_time; });
}

}  // namespace

std::vector<CaseFact> const& case_facts() {
    using Record = CaseRecord&;
    static std::vector<CaseFact> const facts{
        {{"case", "1", "Case id: hash of the scenario, the deck and the engine's version"},
         [](Record r) -> std::string& { return r.id; }},
        {{"outcome", "1", "How the case ended: finished, not-steady or not-precise"},
         [](Record r) -> std::string& { return r.outcome; }},
        {{"program_version", "1", "Version of Vibrotrough that ran the case"},
         [](Record r) -> std::string& { return r.provenance.program_version; }},
        {{"git_commit", "1", "Commit that this Vibrotrough was built from"},
         [](Record r) -> std::string& { return r.provenance.git_commit; }},
        {{"engine_version", "1", "Version of LIGGGHTS"},
         [](Record r) -> std::string& { return r.provenance.engine_version; }},
        {{"host", "1", "Machine that the case ran on"},
         [](Record r) -> std::string& { return r.provenance.host; }},
        {{"started", "1", "When the first packing started, ISO 8601, UTC"},
         [](Record r) -> std::string& { return r.provenance.started; }},
        {{"finished", "1", "When the case was finished, ISO 8601, UTC"},
         [](Record r) -> std::string& { return r.provenance.finished; }},
        {{"layer_mode", "1",
          "The bulk's mode in the theory's letters, of most packings; empty when too few cycles were kept"},
         [](Record r) -> std::string& { return r.layer_mode; }},
    };
    return facts;
}

namespace {

using Real = double (*)(Case);
using Integer = int (*)(Case);
using Text = std::string (*)(Case);

std::vector<CaseValue> drive_and_result_values() {
    return {
        {{"throw_number", "1", "Throw number Gamma = omega^2 r sin(beta) / (g cos(alpha))"},
         Real([](Case c) { return throw_number(c.scenario.trough); })},
        {{"machine_number", "1", "Machine number K = omega^2 r / g"},
         Real([](Case c) { return machine_number(c.scenario.trough); })},
        {{"vibration_angle", "rad",
          "Vibration angle beta, between the direction of vibration and the trough"},
         Real([](Case c) { return c.scenario.trough.vibration_angle; })},
        {{"inclination", "rad",
          "Inclination alpha of the trough, uphill positive in the conveying direction"},
         Real([](Case c) { return c.scenario.trough.inclination; })},
        {{"amplitude", "m", "Amplitude r in the direction of vibration, half the stroke"},
         Real([](Case c) { return c.scenario.trough.amplitude; })},
        {{"frequency", "Hz", "Frequency of the vibration, 1/T"},
         Real([](Case c) { return c.scenario.trough.frequency; })},
        {{"friction", "1", "Friction coefficient mu, grain on trough"},
         Real([](Case c) { return c.scenario.trough.friction; })},
        {{"restitution", "1",
          "Restitution coefficient e, grain on trough, nominal value of the contact model"},
         Real([](Case c) { return c.scenario.trough.restitution; })},
        {{"velocity_scale", "m/s", "omega r cos(beta), the speed at velocity efficiency 1"},
         Real([](Case c) { return velocity_scale(c.scenario.trough); })},
        {{"efficiency", "1",
          "Velocity efficiency eta, mean over the packings; NaN when outcome is not-steady"},
         Real([](Case c) { return c.estimate.mean; })},
        {{"efficiency_half_width", "1",
          "Half-width of the confidence interval of efficiency over the packings; NaN when outcome is "
          "not-steady"},
         Real([](Case c) { return c.estimate.half_width; })},
        {{"confidence", "1", "Confidence of every interval in this file"},
         Real([](Case c) { return c.scenario.measure.confidence; })},
        {{"speed", "m/s", "Conveying speed along the trough: efficiency times velocity_scale"},
         Real([](Case c) { return c.estimate.mean * velocity_scale(c.scenario.trough); })},
        {{"speed_half_width", "m/s", "Half-width of the confidence interval of speed"},
         Real([](Case c) { return c.estimate.half_width * velocity_scale(c.scenario.trough); })},
        {{"packings", "1", "Number of independent packings in the mean"},
         Integer([](Case c) { return c.estimate.packings; })},
        {{"cycles_measured", "1", "Cycles kept for the means, sum over the packings"},
         Integer([](Case c) { return sum_over_packings(c, &measure::PackingEstimate::measured); })},
        {{"cycles_discarded", "1", "Cycles cut as start-up, sum over the packings"},
         Integer([](Case c) { return sum_over_packings(c, &measure::PackingEstimate::discarded); })},
        {{"wall_time", "s", "Wall time of the engine, sum over the packings"}, Real(wall_time)},
    };
}

std::vector<CaseValue> grain_and_layer_values() {
    return {
        {{"grain_diameter", "m", "Diameter of the grains: mean, or median of the log-normal law"},
         Real([](Case c) { return c.scenario.grains.diameter; })},
        {{"grain_diameter_spread", "1", "Spread s of the size law"},
         Real([](Case c) { return c.scenario.grains.diameter_spread; })},
        {{"grain_density", "kg/m3", "Density of the grains' material"},
         Real([](Case c) { return c.scenario.grains.density; })},
        {{"grain_youngs_modulus", "Pa", "Young's modulus of grains and trough"},
         Real([](Case c) { return c.scenario.grains.youngs_modulus; })},
        {{"grain_poisson_ratio", "1", "Poisson ratio of grains and trough"},
         Real([](Case c) { return c.scenario.grains.poisson_ratio; })},
        {{"grain_friction", "1", "Friction coefficient, grain on grain"},
         Real([](Case c) { return c.scenario.grains.friction; })},
        {{"grain_restitution", "1", "Restitution coefficient, grain on grain, nominal"},
         Real([](Case c) { return c.scenario.grains.restitution; })},
        {{"grain_rolling_friction", "1", "Rolling friction coefficient, 0 when the model is off"},
         Real([](Case c) { return c.scenario.grains.rolling_friction; })},
        {{"grain_rotation", "1", "free, rolling or blocked"},
         Text([](Case c) { return std::string(name_of(c.scenario.grains.rotation)); })},
        {{"grain_shape", "1", "sphere, cube, rod, or the name of the file with the spheres of a clump"},
         Text([](Case c) { return c.scenario.grains.shape; })},
        {{"grain_size_law", "1", "three-classes, uniform, lognormal or listed"},
         Text([](Case c) { return std::string(name_of(c.scenario.grains.size_law)); })},
        {{"block", "1", "none, or the rigid block in place of the layer: point or plate"},
         Text([](Case c) { return std::string(name_of(c.scenario.layer.block)); })},
        {{"side_wall_friction", "1", "Friction coefficient, grain on side walls; NaN without side walls"},
         Real([](Case c) {
             return c.scenario.trough.side_wall_friction.value_or(std::numeric_limits<double>::quiet_NaN());
         })},
        {{"rayleigh_fraction", "1", "Largest time step in Rayleigh times of the smallest grain"},
         Real([](Case c) { return c.scenario.solver.rayleigh_fraction; })},
        {{"layer_length", "m", "Length of the periodic piece of layer along the trough"},
         Real([](Case c) { return c.scenario.layer.length; })},
        {{"layer_width", "m", "Width of the periodic piece of layer across the trough"},
         Real([](Case c) { return c.scenario.layer.width; })},
        {{"layer_height", "m",
          "Height of the layer at rest as asked for; NaN when the number of grains was given"},
         Real([](Case c) {
             return c.scenario.layer.height.value_or(std::numeric_limits<double>::quiet_NaN());
         })},
        {{"layer_grains", "1", "Number of grains"}, Integer([](Case c) { return c.scenario.layer.grains; })},
    };
}

}  // namespace

std::vector<CaseValue> const& case_values() {
    static std::vector<CaseValue> const values = [] {
        std::vector<CaseValue> all = drive_and_result_values();
        for (CaseValue const& value : grain_and_layer_values()) all.push_back(value);
        for (CaseValue const& value : layer_case_values()) all.push_back(value);
        return all;
    }();
    return values;
}

namespace {

std::vector<PackingValue> run_packing_values() {
    using Field = std::variant<int*, double*, std::string*, measure::Verdict*>;
    using Packing = PackingRecord&;
    return {
        {{"seed", "1", "Seed of the packing's random positions"}, [](Packing p) -> Field { return &p.seed; }},
        {{"steps_per_cycle", "1", "Time steps of the engine per cycle"},
         [](Packing p) -> Field { return &p.steps_per_cycle; }},
        {{"time_step", "s", "Time step of the engine"}, [](Packing p) -> Field { return &p.time_step; }},
        {{"mass", "kg", "Mass of all grains"}, [](Packing p) -> Field { return &p.mass; }},
        {{"wall_time", "s", "Wall time of the engine"}, [](Packing p) -> Field { return &p.wall_time; }},
        {{"efficiency", "1", "Velocity efficiency eta, mean over the cycles kept"},
         [](Packing p) -> Field { return &p.estimate.mean; }},
        {{"efficiency_half_width", "1",
          "Half-width of the confidence interval of efficiency, corrected for correlation between cycles"},
         [](Packing p) -> Field { return &p.estimate.half_width; }},
        {{"cycles_discarded", "1", "Cycles cut as start-up (MSER)"},
         [](Packing p) -> Field { return &p.estimate.discarded; }},
        {{"cycles_measured", "1", "Cycles kept for the mean"},
         [](Packing p) -> Field { return &p.estimate.measured; }},
        {{"correlation_time", "1",
          "Statistical inefficiency g: that many cycles are worth one independent cycle"},
         [](Packing p) -> Field { return &p.estimate.correlation_time; }},
        {{"verdict", "1", "How well the mean is known: precise, not-precise or not-steady"},
         [](Packing p) -> Field { return &p.estimate.verdict; }},
        {{"deck", "1", "The LIGGGHTS deck, in.liggghts"}, [](Packing p) -> Field { return &p.deck; }},
    };
}

}  // namespace

std::vector<PackingValue> const& packing_values() {
    static std::vector<PackingValue> const values = [] {
        std::vector<PackingValue> all = run_packing_values();
        for (PackingValue const& value : layer_packing_values()) all.push_back(value);
        return all;
    }();
    return values;
}

std::vector<PackingSeries> const& packing_series() {
    using Packing = PackingRecord&;
    using Series = std::vector<double>&;
    static std::vector<PackingSeries> const series{
        {{"centre_of_mass_x", "m", "Centre of mass along the trough at the end of cycle 0 ... n, unwrapped"},
         SeriesLength::cycle_ends,
         [](Packing p) -> Series { return p.series.x; }},
        {{"centre_of_mass_z", "m", "Centre of mass above the resting trough at the end of cycle 0 ... n"},
         SeriesLength::cycle_ends,
         [](Packing p) -> Series { return p.series.z; }},
        {{"centre_of_mass_velocity_z", "m/s",
          "Velocity of the centre of mass normal to the trough at the end of cycle 0 ... n"},
         SeriesLength::cycle_ends,
         [](Packing p) -> Series { return p.series.vz; }},
        {{"normal_force", "N",
          "Force of the layer on the trough, normal, cycle mean, positive when pressing"},
         SeriesLength::cycles,
         [](Packing p) -> Series { return p.series.normal_force; }},
        {{"tangential_force", "N", "Force of the layer on the trough along x, cycle mean"},
         SeriesLength::cycles,
         [](Packing p) -> Series { return p.series.tangential_force; }},
        {{"flight_fraction", "1", "Fraction of the cycle without contact between layer and trough"},
         SeriesLength::cycles,
         [](Packing p) -> Series { return p.series.flight_fraction; }},
        {{"mean_velocity", "m/s", "Velocity of the centre of mass along the trough, cycle mean"},
         SeriesLength::cycles,
         [](Packing p) -> Series { return p.series.mean_velocity; }},
        {{"efficiency", "1", "Velocity efficiency eta of each cycle"},
         SeriesLength::cycles,
         [](Packing p) -> Series { return p.efficiency; }},
    };
    return series;
}

Entry scenario_entry() {
    return {"scenario", "1", "The scenario as a campaign file of one case (TOML, SI units)"};
}

Entry certificate_entry() {
    return {"engine_certificate", "1",
            "Certificate of the engine binary (JSON): what its probes showed; empty when it was not probed"};
}

Entry scenario_files_entry() {
    return {"scenario_files", "1", "The files that the scenario names: a JSON object of names and contents"};
}

std::string verdict_name(measure::Verdict verdict) {
    switch (verdict) {
        case measure::Verdict::precise:
            return "precise";
        case measure::Verdict::not_precise:
            return "not-precise";
        case measure::Verdict::not_steady:
            return "not-steady";
    }
    throw Hdf5Error("cannot name a verdict of unknown kind");
}

measure::Verdict verdict_of(std::string const& name) {
    for (auto const verdict :
         {measure::Verdict::precise, measure::Verdict::not_precise, measure::Verdict::not_steady}) {
        if (verdict_name(verdict) == name) return verdict;
    }
    throw Hdf5Error("use the verdict '" + name + "', it is unknown");
}

}  // namespace vibrotrough::store
