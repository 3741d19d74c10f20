#include "store/schema.hpp"

#include "measure/mass_flow.hpp"
#include "store/layer_tables.hpp"
#include "store/material_quantities.hpp"
#include "store/open_quantities.hpp"
#include "store/screen_quantities.hpp"
#include "store/stage_quantities.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

namespace vibrotrough::store {
namespace {

constexpr auto interval_over_packings =
    "Half-width of its interval at measure.confidence, Student's t over the packings; NaN with one packing";

/// From the profiles of the packings, over depth.
std::vector<CaseValues> mass_flow_values(CaseRecord const& record) {
    std::vector<measure::Profiles const*> profiles;
    for (PackingRecord const& packing : record.packings) profiles.push_back(&packing.profiles);
    auto const flow =
        measure::mass_flow(profiles, mean_density(record.scenario), record.scenario.measure.confidence);
    return {flow.height, flow.flow, flow.half_width};
}

CaseTable mass_flow_table() {
    return {"mass_flow",
            "slabs",
            {{"height", "m", "Middle of the slab above the surface of the trough"},
             {"flow", "kg/(m2 s)",
              "Mass flow along the trough per area of a section that moves with it: mean over the cycle of "
              "density times solid fraction times velocity relative to the trough; mean over the packings"},
             {"half_width", "kg/(m2 s)", interval_over_packings}},
            mass_flow_values};
}

template <typename Row>
std::vector<Row> joined(std::initializer_list<std::vector<Row>> parts) {
    std::vector<Row> all;
    for (std::vector<Row> const& part : parts) std::ranges::copy(part, std::back_inserter(all));
    return all;
}

}  // namespace

std::vector<CaseFact> const& case_facts() {
    using Made = Provenance;
    auto const made = [](auto member) { return field(&CaseRecord::provenance, member); };
    static std::vector<CaseFact> const facts{
        {{"case", "1", "Case id: hash of the scenario, the deck and the engine's version"},
         field(&CaseRecord::id)},
        {{"outcome", "1", "How the case ended: finished, not-precise, not-steady or bistable-or-slow"},
         field(&CaseRecord::outcome)},
        {{"program_version", "1", "Version of Vibrotrough that ran the case"}, made(&Made::program_version)},
        {{"git_commit", "1", "Commit that this Vibrotrough was built from"}, made(&Made::git_commit)},
        {{"engine_version", "1", "Version of LIGGGHTS"}, made(&Made::engine_version)},
        {{"host", "1", "Machine that the case ran on"}, made(&Made::host)},
        {{"started", "1", "When the first packing started, ISO 8601, UTC"}, made(&Made::started)},
        {{"finished", "1", "When the case was finished, ISO 8601, UTC"}, made(&Made::finished)},
        {{"layer_mode", "1",
          "The bulk's mode in the theory's letters, of most packings; empty when too few cycles were kept"},
         field(&CaseRecord::layer_mode)},
    };
    return facts;
}

std::vector<CaseTheoryColumn> const& case_theory_columns() {
    using Theory = prepare::PointMassTheory;
    auto const said = [](auto member) { return field(&CaseRecord::theory, member); };
    static std::vector<CaseTheoryColumn> const columns{
        {{"efficiency_theory", "1",
          "Velocity efficiency of the plastic point mass of the paper, at the friction of a grain on the "
          "trough; NaN without a mean speed"},
         said(&Theory::efficiency)},
        {{"mode_theory", "1", "Mode of the plastic point mass; empty when its motion has none"},
         said(&Theory::mode)},
        {{"efficiency_theory_restitution", "1",
          "Velocity efficiency of the same point mass with the restitution of a grain on the trough; NaN "
          "without a mean speed and for a restitution above 0.95"},
         said(&Theory::efficiency_restitution)},
        {{"efficiency_theory_restitution_half_width", "1",
          "Half-width of its 95 % interval where the motion has no period; NaN where it is exact"},
         said(&Theory::half_width_restitution)},
        {{"mode_theory_restitution", "1",
          "Mode of the point mass with restitution; empty when its motion has none"},
         said(&Theory::mode_restitution)},
    };
    return columns;
}

std::vector<PackingTable> const& packing_tables() {
    static auto const all = joined({layer_tables(), material_tables(), open_tables(), screen_tables()});
    return all;
}

std::vector<CaseTable> const& case_tables() {
    static auto const all = joined({{mass_flow_table()},
                                    materials_case_tables(),
                                    stages_case_tables(),
                                    screen_case_tables(),
                                    open_case_tables()});
    return all;
}

CaseTable const& case_table(std::string_view name) {
    auto const found = std::ranges::find(case_tables(), name, &CaseTable::name);
    if (found == case_tables().end()) throw std::out_of_range("no table " + std::string(name));
    return *found;
}

void add_measured(std::vector<Entry>& entries, Entry const& entry) {
    entries.push_back(entry);
    entries.push_back({entry.name + "_half_width", entry.units, interval_over_packings});
}

MeasuredColumn over_packings(CaseRecord const& record,
                             Field<PackingRecord, std::vector<double>> const& column, std::size_t rows) {
    MeasuredColumn measured(record.scenario.measure.confidence);
    for (std::size_t row = 0; row < rows; ++row) {
        measure::EnsembleNumber number;
        for (PackingRecord const& packing : record.packings) {
            std::vector<double> const& values = column(packing);
            if (row < values.size() && !std::isnan(values[row])) number.values.push_back(values[row]);
        }
        measured.add(number);
    }
    return measured;
}

Entry swept_entry(scenario::Key const& key) {
    std::string_view const unit = key.unit.empty() ? "1" : key.unit == "radian" ? "rad" : key.unit;
    return {std::string(key.path), std::string(unit), std::string(key.meaning)};
}

}  // namespace vibrotrough::store
