// Writes result.h5 and campaign.h5 of the sample into a folder, for check_written.py.

#include "sample_record.hpp"
#include "scenario/reader/written_campaign.hpp"
#include "store/material_quantities.hpp"
#include "store/result_file.hpp"
#include "store/stage_quantities.hpp"

#include <cstdio>
#include <exception>
#include <limits>

namespace {

/// As if the trough were open, with the same mass on it.
void open(vibrotrough::store::CaseRecord& record) {
    using namespace vibrotrough::scenario;
    double const depth =
        mass_per_area(record.scenario) / (settled_solid_fraction * mean_density(record.scenario));
    record.scenario.feed.mass_flow = 0.05;
    for (vibrotrough::store::PackingRecord& packing : record.packings) {
        auto& series = packing.series.open;
        for (auto* const values : {&series.fed, &series.fed_mass, &series.left, &series.left_mass,
                                   &series.held, &series.held_mass, &series.window_mass})
            values->assign(packing.series.x.size(), 7);
        packing.open.inflow = packing.open.outflow = 0.05;
        packing.open.window_depth = depth;
        packing.open.hold_up = packing.mass;
        packing.open.along = {{0.01, 0.02, 0.03, 0.04},
                              {0.012, 0.012, 0.011, 0.01},
                              {0.3, 0.3, 0.31, 0.32},
                              {0.017, 0.017, 0.014, 0.01}};
        packing.open.residence.assign(101, 1.5);
        packing.open.materials = {
            {0.3, 0.3, 0.3, 0.4}, {0.1, 0, 0, -0.1}, {0.02, 0.01, 0.01, 0.01}, {1, 1, 1, 2}};
        for (int i = 0; i < 16; ++i) {
            packing.open.materials_along.x.push_back(0.01 * (i % 4 + 1));
            packing.open.materials_along.share.push_back(0.1 * (i / 4 + 1));
            packing.open.materials_along.speed.push_back(0.3);
            packing.open.materials_along.segregation.push_back(0.01 * i);
        }
    }
    // The second packing has another depth and speed, no grains in the last bin, and longer stays.
    auto& second = record.packings.at(1).open;
    second.along.depth.front() = 0.016;
    second.along.speed.front() = 0.4;
    second.along.speed.back() = std::numeric_limits<double>::quiet_NaN();
    second.residence.back() = 2.5;
    second.materials.outflow.back() = 0.02;
    second.materials_along.share.back() = 0.6;
    second.materials_along.speed.back() = std::numeric_limits<double>::quiet_NaN();
}

/// A floor that falls towards its edge, in mm.
std::shared_ptr<vibrotrough::scenario::TroughMesh const> slope() {
    using vibrotrough::scenario::Point;
    Point const a{0, 0, 5}, b{40, 0, 0}, c{40, 18, 0}, d{0, 18, 5};
    return vibrotrough::scenario::read_trough_mesh(
        {{"slope.stl", vibrotrough::scenario::stl_text("slope", {{a, b, c}, {a, c, d}})}});
}

/// As if the trough were a screen with openings of 3 mm, on which three of five small grains passed.
void put_on_screen(vibrotrough::store::CaseRecord& record) {
    record.scenario.screen = {0.003, 0.001, 0.1};
    for (vibrotrough::store::PackingRecord& packing : record.packings) {
        packing.screening = {.diameter = {0.002, 0.004},
                             .number = {5, 2},
                             .mass = {1e-5, 8e-5},
                             .passed = {3, 0},
                             .passed_cycle = {1, 1, 1},
                             .passed_diameter = {0.002, 0.002, 0.002},
                             .efficiency = 0.6};
        packing.series.open.passed = packing.series.open.passed_mass = packing.series.open.left;
        std::vector<double> const rows(2 * packing.series.x.size(), 7);
        packing.screening.by_size = {rows, rows, rows, rows, rows, rows};
    }
}

/// The sample with four materials and a stage in an open trough with holes, so that it has every table but
/// those of a layer that keeps its grains; or with four materials that it keeps.
vibrotrough::store::CaseRecord sample_mixture(bool is_open) {
    using namespace vibrotrough::store;
    CaseRecord record = sample_record();
    for (char const* const name : {"a", "b", "c"})
        record.scenario.materials.push_back({.name = name, .number_fraction = 0.1});
    if (is_open) {
        open(record);
        put_on_screen(record);
    }
    record.scenario.stages = {{.cycles = 1}};  // as many cycles as the shorter packing has
    record.scenario_toml = to_toml(record.scenario);
    for (PackingRecord& packing : record.packings) {
        double place = 0.018;
        for (auto& material : packing.series.materials) {
            material.x.assign(packing.series.x.size(), place += 0.001);
            material.z.assign(packing.series.x.size(), place / 2);
        }
    }
    add_materials(record);
    add_stages(record);
    record.scenario.trough.mesh = slope();
    return record;
}

/// A number and a curve of the first case; the second case has neither.
std::vector<vibrotrough::store::Observable> sample_observables(vibrotrough::store::CaseRecord const& record) {
    using namespace vibrotrough::store;
    ObservedCase const one{record.id, mark_of(record), {1, 2}, 1, 2, {}, {{0.25, 0.125, "drifting"}}};
    Observable number{"temperature", "m2/s2", "Granular temperature", "", "", "mine.py", "text",
                      "5e1f",        {one}};
    Observable curve = number;
    curve.name = "profile";
    curve.over = "height";
    curve.over_unit = "m";
    curve.cases[0].at = {0.001, 0.002, 0.003};
    curve.cases[0].values = {{1.0, 0.5, "steady"}, {2.0, {}, "drifting"}, {{}, {}, "steady"}};
    return {number, curve};
}

}  // namespace

int main(int argc, char** argv) {
    using namespace vibrotrough::store;
    if (argc != 2) {
        std::fprintf(stderr, "usage: write_sample FOLDER\n");
        return 2;
    }
    try {
        std::filesystem::path const folder = argv[1];
        std::filesystem::create_directories(folder);
        write_result(folder / "result.h5", sample_mixture(true));
        write_result(folder / "kept.h5", sample_mixture(false));
        CaseRecord studied = sample_record();
        studied.studied_error = 0.034;
        std::vector const cases{studied, sample_record("fedcba9876543210", 27.0)};
        auto const observables = sample_observables(studied);
        write_campaign(folder / "campaign.h5", {.campaign = "sample",
                                                .cases = cases,
                                                .swept = {vibrotrough::scenario::find_key("trough.frequency"),
                                                          vibrotrough::scenario::find_key("grains.rotation")},
                                                .observables = observables,
                                                .made_of = "the sample"});
        return 0;
    } catch (std::exception const& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
