#include "store/schema.hpp"

namespace vibrotrough::store {
std::vector<CaseFact> const& case_facts() {
    static std::vector<CaseFact> const facts{
        {{"case", "1", "Case id: hash of the scenario, the deck and the engine's version"},
         case_field([](auto& r) -> auto& { return r.id; })},
        {{"outcome", "1", "How the case ended: finished, not-precise, not-steady or bistable-or-slow"},
         case_field([](auto& r) -> auto& { return r.outcome; })},
        {{"program_version", "1", "Version of Vibrotrough that ran the case"},
         case_field([](auto& r) -> auto& { return r.provenance.program_version; })},
        {{"git_commit", "1", "Commit that this Vibrotrough was built from"},
         case_field([](auto& r) -> auto& { return r.provenance.git_commit; })},
        {{"engine_version", "1", "Version of LIGGGHTS"},
         case_field([](auto& r) -> auto& { return r.provenance.engine_version; })},
        {{"host", "1", "Machine that the case ran on"},
         case_field([](auto& r) -> auto& { return r.provenance.host; })},
        {{"started", "1", "When the first packing started, ISO 8601, UTC"},
         case_field([](auto& r) -> auto& { return r.provenance.started; })},
        {{"finished", "1", "When the case was finished, ISO 8601, UTC"},
         case_field([](auto& r) -> auto& { return r.provenance.finished; })},
        {{"layer_mode", "1",
          "The bulk's mode in the theory's letters, of most packings; empty when too few cycles were kept"},
         case_field([](auto& r) -> auto& { return r.layer_mode; })},
    };
    return facts;
}

std::vector<PackingSeries> const& packing_series() {
    static std::vector<PackingSeries> const series{
        {{"centre_of_mass_x", "m", "Centre of mass along the trough at the end of cycle 0 ... n, unwrapped"},
         SeriesLength::cycle_ends,
         packing_field([](auto& p) -> auto& { return p.series.x; })},
        {{"centre_of_mass_z", "m", "Centre of mass above the resting trough at the end of cycle 0 ... n"},
         SeriesLength::cycle_ends,
         packing_field([](auto& p) -> auto& { return p.series.z; })},
        {{"centre_of_mass_velocity_z", "m/s",
          "Velocity of the centre of mass normal to the trough at the end of cycle 0 ... n"},
         SeriesLength::cycle_ends,
         packing_field([](auto& p) -> auto& { return p.series.vz; })},
        {{"normal_force", "N",
          "Force of the layer on the trough, normal, cycle mean, positive when pressing"},
         SeriesLength::cycles,
         packing_field([](auto& p) -> auto& { return p.series.normal_force; })},
        {{"tangential_force", "N", "Force of the layer on the trough along x, cycle mean"},
         SeriesLength::cycles,
         packing_field([](auto& p) -> auto& { return p.series.tangential_force; })},
        {{"flight_fraction", "1", "Fraction of the cycle without contact between layer and trough"},
         SeriesLength::cycles,
         packing_field([](auto& p) -> auto& { return p.series.flight_fraction; })},
        {{"mean_velocity", "m/s", "Velocity of the centre of mass along the trough, cycle mean"},
         SeriesLength::cycles,
         packing_field([](auto& p) -> auto& { return p.series.mean_velocity; })},
        {
            {"efficiency", "1", "Velocity efficiency eta of each cycle"},
            SeriesLength::cycles,
            packing_field([](auto& p) -> auto& { return p.efficiency; }),
        },
    };
    return series;
}

std::vector<MassFlowColumn> const& mass_flow_columns() {
    static std::vector<MassFlowColumn> const columns{
        {{"height", "m", "Middle of the slab above the surface of the trough"}, &measure::MassFlow::height},
        {{"flow", "kg/(m2 s)",
          "Mass flow along the trough per area of a section that moves with it: mean over the cycle of "
          "density "
          "times solid fraction times velocity relative to the trough; mean over the packings"},
         &measure::MassFlow::flow},
        {{"half_width", "kg/(m2 s)",
          "Half-width of its interval at measure.confidence, Student's t over the packings; NaN with one "
          "packing"},
         &measure::MassFlow::half_width},
    };
    return columns;
}

measure::MassFlow mass_flow_of(CaseRecord const& record) {
    std::vector<measure::Profiles const*> profiles;
    for (PackingRecord const& packing : record.packings) profiles.push_back(&packing.profiles);
    return measure::mass_flow(profiles, mean_density(record.scenario), record.scenario.measure.confidence);
}

Entry scenario_entry() {
    return {"scenario", "1", "The scenario as a campaign file of one case (TOML, SI units)"};
}

Entry swept_entry(scenario::Key const& key) {
    std::string_view const unit = key.unit.empty() ? "1" : key.unit == "radian" ? "rad" : key.unit;
    return {key.path, unit, key.meaning};
}

Entry certificate_entry() {
    return {"engine_certificate", "1",
            "Certificate of the engine binary (JSON): what its probes showed; empty when it was not probed"};
}

Entry scenario_files_entry() {
    return {"scenario_files", "1", "The files that the scenario names: a JSON object of names and contents"};
}

}  // namespace vibrotrough::store
