#include "evaluate/friction_test.hpp"

#include "core/atomic_file.hpp"
#include "core/outcome.hpp"
#include "evaluate/case.hpp"
#include "evaluate/layer.hpp"
#include "measure/shake_test.hpp"
#include "scenario/reader/shake_test.hpp"
#include "theory/friction_test.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>

namespace vibrotrough::evaluate {
namespace {

/// A layer whose mean displacement per cycle exceeds this part of its sliding distance creeps.
constexpr double tolerated_creep = 0.05;

/// A layer that slides by less than this, in amplitudes, moves with the trough: its contacts' springs yield
/// by as much.
constexpr double least_slide = 0.05;

/// How far a packing slid in each of the cycles that its mean is taken from, in amplitudes.
struct Slides {
    std::vector<double> ranges;
    double creep;
};

Slides read_slides(prepare::PreparedCase const& prepared, store::PackingRecord const& packing,
                   std::filesystem::path const& packing_folder) {
    auto const series = packing_phases(prepared, core::read_text_file(packing_folder / "phases.csv"));
    int const first = std::max(packing.estimate.discarded, 1);
    int const last = packing.estimate.discarded + packing.estimate.measured;
    double const r = prepared.scenario.trough.amplitude;
    Slides slides{measure::relative_displacement_ranges(series, first, last),
                  measure::creep_per_cycle(series, first, last) / r};
    for (double& range : slides.ranges) range /= r;
    return slides;
}

/// Displacement, interval and creep of a finished test.
void add_displacement(LayerFriction& test, prepare::PreparedCase const& prepared,
                      store::CaseRecord const& record, std::filesystem::path const& case_folder) {
    scenario::MeasurementPlan const& wanted = prepared.scenario.measure;
    std::vector<std::vector<double>> ranges;
    std::vector<measure::PackingValues> values;
    auto const count = static_cast<double>(record.packings.size());
    for (std::size_t i = 0; i < record.packings.size(); ++i) {
        Slides slides =
            read_slides(prepared, record.packings[i], case_folder / fmt::format("packing-{}", i + 1));
        test.creep += slides.creep / count;
        ranges.push_back(std::move(slides.ranges));
    }
    for (std::size_t i = 0; i < ranges.size(); ++i)
        values.push_back({ranges[i], start_of(static_cast<int>(i) + 1)});
    measure::CaseEstimate const mean = measure::estimate_case(values, {wanted.confidence, wanted.half_width});
    if (mean.steadiness != measure::Steadiness::steady) {
        test.message = "the displacement never became steady; allow more cycles (measure.max_cycles)";
        return;
    }
    test.displacement = mean.mean;
    test.half_width = mean.half_width;
}

void add_friction(LayerFriction& test) {
    if (!test.displacement) return;
    if (*test.displacement < least_slide) {
        test.message = fmt::format(
            "the layer moves with the trough; its friction is about K = {:.3g} or more; choose a larger K",
            test.machine_number);
        return;
    }
    if (std::abs(test.creep) > tolerated_creep * *test.displacement) {
        test.message = fmt::format(
            "the layer creeps by {:.3f} amplitudes per cycle on a level trough, so that its displacement "
            "does "
            "not measure sliding",
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

}  // namespace

LayerFriction failed_friction_test(prepare::PreparedCase const& prepared, std::string const& case_id,
                                   std::string const& why) {
    LayerFriction test{};
    test.layer = layer_key(prepared.scenario);
    test.case_id = case_id;
    test.grain_friction = prepared.scenario.trough.friction;
    test.machine_number = prepared.machine_number;
    test.message = why;
    return test;
}

LayerFriction evaluate_friction_test(prepare::PreparedCase const& prepared, std::string const& case_id,
                                     store::CaseRecord const& record,
                                     std::filesystem::path const& case_folder) {
    if (!has_mean(record.outcome)) {
        return failed_friction_test(prepared, case_id,
                                    "the layer never became steady; allow more cycles (measure.max_cycles)");
    }
    LayerFriction test = failed_friction_test(prepared, case_id, "");
    add_displacement(test, prepared, record, case_folder);
    add_friction(test);
    return test;
}

double default_machine_number(double largest_friction) {
    return std::max(0.67, 1.2 * largest_friction * std::hypot(1, std::numbers::pi / 2));
}

}  // namespace vibrotrough::evaluate
