#include "campaign/friction_test.hpp"

#include "campaign/layer.hpp"
#include "campaign/state/case_state.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "measure/shake_test.hpp"
#include "scenario/reader/shake_test.hpp"
#include "theory/friction_test.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::campaign {
namespace {

using Json = nlohmann::ordered_json;

/// A layer that gets away by more than this part of its displacement per cycle creeps.
constexpr double tolerated_creep = 0.05;

/// A layer that slides less than this, in amplitudes, goes with the trough: its contacts' springs give way by
/// as much.
constexpr double least_slide = 0.05;

/// The lines that a packing's pen drew, in amplitudes, in the cycles that its mean is from.
struct Pen {
    std::vector<double> lines;
    double creep;
};

Pen read_pen(PlannedCase const& planned, store::PackingRecord const& packing, int number) {
    auto const series = packing_phases(planned.scenario, deck::make_deck(planned.scenario, number),
                                       core::read_text_file(planned.packing_folder(number) / "phases.csv"));
    int const first = std::max(packing.estimate.discarded, 1);
    int const last = packing.estimate.discarded + packing.estimate.measured;
    double const r = planned.scenario.trough.amplitude;
    Pen pen{measure::relative_displacement_ranges(series, first, last),
            measure::creep_per_cycle(series, first, last) / r};
    for (double& line : pen.lines) line /= r;
    return pen;
}

/// Displacement, interval and creep of a finished test.
void add_displacement(LayerFriction& test, PlannedCase const& planned, store::CaseRecord const& record) {
    scenario::MeasurementPlan const& wanted = planned.scenario.measure;
    std::vector<measure::PackingEstimate> estimates;
    for (int number = 1; number <= wanted.packings; ++number) {
        Pen const pen = read_pen(planned, record.packings[static_cast<std::size_t>(number - 1)], number);
        estimates.push_back(measure::estimate_packing(pen.lines, {wanted.confidence, wanted.half_width}));
        test.creep += pen.creep / wanted.packings;
    }
    bool const unsteady = std::ranges::any_of(
        estimates, [](auto const& one) { return one.verdict == measure::Verdict::not_steady; });
    if (unsteady) {
        test.message = "the displacement never became steady; allow more cycles (measure.max_cycles)";
        return;
    }
    measure::CaseEstimate const mean = measure::combine(estimates, wanted.confidence);
    test.displacement = mean.mean;
    if (std::isfinite(mean.half_width)) test.half_width = mean.half_width;
}

void add_friction(LayerFriction& test) {
    if (!test.displacement) return;
    if (*test.displacement < least_slide) {
        test.message = fmt::format(
            "the layer goes with the trough; its friction is about K = {:.3g} or more; choose a larger K",
            test.machine_number);
        return;
    }
    if (std::abs(test.creep) > tolerated_creep * *test.displacement) {
        test.message = fmt::format(
            "the layer creeps by {:.3f} amplitudes per cycle on a level trough, so that its lines are no "
            "slides",
            test.creep);
        return;
    }
    if (!test.half_width) {
        test.message = "the displacement has no interval; ask for more cycles or packings";
        return;
    }
    try {
        auto const found =
            theory::friction_from_shake({test.machine_number}, *test.displacement, *test.half_width);
        test.friction = found.friction;
        test.low = found.low;
        test.high = found.high;
        test.mode = found.mode;
        if (found.mode != "PN")
            test.message = "the layer rests between its slides: static friction matters; choose a larger K";
    } catch (std::invalid_argument const& error) {
        test.message = fmt::format("{}; choose another K", error.what());
    }
}

LayerFriction measure_one(PlannedCase const& planned) {
    LayerFriction test{};
    test.layer = layer_key(planned.scenario);
    test.case_id = planned.id;
    test.grain_friction = planned.scenario.trough.friction;
    test.machine_number = machine_number(planned.scenario.trough);
    auto const record = read_whole_result(planned);
    if (!record) {
        auto const failure = read_failure(planned);
        test.message = failure ? fmt::format("{}: {}", failure->outcome, failure->message) : "not finished";
    } else if (record->outcome == "not-steady") {
        test.message = "the layer never became steady; allow more cycles (measure.max_cycles)";
    } else {
        add_displacement(test, planned, *record);
        add_friction(test);
    }
    return test;
}

Json number(std::optional<double> const& value) {
    return value ? Json(*value) : Json(nullptr);
}

std::optional<double> number(Json const& value) {
    if (value.is_null()) return {};
    return value.get<double>();
}

}  // namespace

double default_machine_number(scenario::Campaign const& campaign) {
    double friction = 0;
    for (scenario::Scenario const& one : campaign.cases) friction = std::max(friction, one.trough.friction);
    return std::max(0.67, 1.2 * friction * std::hypot(1, std::numbers::pi / 2));
}

std::vector<LayerFriction> measure_friction(Plan const& plan) {
    std::vector<LayerFriction> tests;
    for (PlannedCase const& planned : plan.cases) tests.push_back(measure_one(planned));
    return tests;
}

std::filesystem::path friction_file(std::filesystem::path const& campaign_folder) {
    return campaign_folder / "friction.json";
}

void write_friction(std::filesystem::path const& campaign_folder, std::vector<LayerFriction> const& tests) {
    Json list = Json::array();
    for (LayerFriction const& test : tests) {
        list.push_back({{"layer", test.layer},
                        {"case", test.case_id},
                        {"grain_friction", test.grain_friction},
                        {"machine_number", test.machine_number},
                        {"max_relative_displacement", number(test.displacement)},
                        {"max_relative_displacement_half_width", number(test.half_width)},
                        {"creep_per_cycle", test.creep},
                        {"friction", number(test.friction)},
                        {"friction_low", number(test.low)},
                        {"friction_high", number(test.high)},
                        {"mode", test.mode},
                        {"message", test.message}});
    }
    core::write_file_atomically(friction_file(campaign_folder), list.dump(2) + "\n");
}

std::map<std::string, LayerFriction> read_friction(std::filesystem::path const& campaign_folder) {
    auto const path = friction_file(campaign_folder);
    std::map<std::string, LayerFriction> tests;
    if (!std::filesystem::is_regular_file(path)) return tests;
    try {
        for (Json const& one : Json::parse(core::read_file(path))) {
            LayerFriction test{one.at("layer"),
                               one.at("case"),
                               one.at("grain_friction"),
                               one.at("machine_number"),
                               number(one.at("max_relative_displacement")),
                               number(one.at("max_relative_displacement_half_width")),
                               one.at("creep_per_cycle"),
                               number(one.at("friction")),
                               number(one.at("friction_low")),
                               number(one.at("friction_high")),
                               one.at("mode"),
                               one.at("message")};
            if (test.friction && test.low && test.high) tests[test.layer] = test;
        }
    } catch (Json::exception const&) {
        throw core::InputError(
            fmt::format("{} is damaged; run 'vibrotrough friction-test' again or delete it", path.string()));
    }
    return tests;
}

}  // namespace vibrotrough::campaign
