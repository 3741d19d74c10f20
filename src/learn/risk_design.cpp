#include "learn/risk_design.hpp"

#include "atlas/value.hpp"
#include "core/error.hpp"
#include "learn/design_description.hpp"
#include "learn/machine_keys.hpp"
#include "learn/risk_search.hpp"
#include "learn/way_out.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::learn {
namespace {

constexpr double largest_loss = 0.005;     // of the merit, by rounding the drive
constexpr double least_draws_in_tail = 5;  // of a posterior, beyond the confidence

void check(DesignTask const& t) {
    theory::check(t.space);
    bool const material = t.friction.low > 0 && t.bulk_density > 0;
    bool const trough = t.width > 0 && t.length >= 0 && t.mass_flow > 0 && t.depth.low > 0 &&
                        t.depth.low <= t.depth.high && (!t.landing_speed || *t.landing_speed > 0);
    bool const models = !t.models.empty() && std::ranges::all_of(t.models, [](DesignModel const& m) {
        return !m.discrepancy || *m.discrepancy >= 0;
    });
    if (!material || !trough || !models || !(t.confidence >= 0.5 && t.confidence <= 0.999))
        throw std::invalid_argument("a number of the design is out of range");
    auto const draws = static_cast<double>(t.friction.draws.size());
    if (draws > 0 && (1 - t.confidence) * draws < least_draws_in_tail - 1e-9) {
        throw core::InputError(fmt::format(
            "a confidence of {:g} cannot be resolved: of the {:g} draws of the posterior fewer than {:g} lie "
            "beyond it; ask for at most {:.4g}",
            t.confidence, draws, least_draws_in_tail,
            std::floor(1e4 * (1 - least_draws_in_tail / draws)) / 1e4));
    }
}

/// A value on a grid of a step, below or above, within its range. A value that is fixed stays.
double on_grid(double value, theory::Range const& r, double step, bool above) {
    if (r.low == r.high) return value;
    double const count = above ? std::ceil(value / step - 1e-9) : std::floor(value / step + 1e-9);
    double rounded = count * step;
    if (std::abs(rounded - r.high) < 1e-9 * step) rounded = r.high;
    if (std::abs(rounded - r.low) < 1e-9 * step) rounded = r.low;
    return rounded >= r.low && rounded <= r.high ? rounded : std::clamp(value, r.low, r.high);
}

/// How finely a drive is rounded, in steps of 1/min, 0.1 mm of stroke and half a degree.
struct Steps {
    double of_motion, of_angles;
};
/// The coarsest first: angles are the hardest to set.
constexpr Steps steps_to_try[] = {{1, 1},      {0.1, 1},     {0.1, 0.1},    {0.01, 1},
                                  {0.01, 0.1}, {0.01, 0.01}, {0.001, 0.001}};

theory::Drive rounded(theory::Drive const& d, theory::DriveSpace const& s, Steps const& steps,
                      unsigned corner) {
    auto const above = [&](unsigned bit) { return (corner >> bit & 1U) != 0; };
    return {on_grid(d.frequency, s.frequency, steps.of_motion / 60, above(0)),
            on_grid(d.amplitude, s.amplitude, steps.of_motion * 5e-5, above(1)),
            on_grid(d.vibration_angle, s.vibration_angle, steps.of_angles * degree / 2, above(2)),
            on_grid(d.inclination, s.inclination, steps.of_angles * degree / 2, above(3))};
}

/// A layer whose drive is on the coarsest grid that costs little and keeps every limit; as it is when there
/// is none. @param must_carry  whether it must carry the mass flow, by a layer of any depth
DesignLayer rounded(RiskSearch const& search, DesignLayer const& layer, bool must_carry) {
    auto const merit_of = [&](DesignLayer const& one) {
        return must_carry ? search.merit(one) : search.sure_speed(one);
    };
    double const merit = merit_of(layer);
    for (Steps const& steps : steps_to_try) {
        std::vector<std::pair<double, DesignLayer>> candidates;
        for (unsigned corner = 0; corner < 16; ++corner) {
            DesignLayer const one{rounded(layer.drive, search.allowed().drives, steps, corner), layer.depth};
            double const value = merit_of(one);
            if (value >= merit - largest_loss * std::abs(merit)) candidates.emplace_back(value, one);
        }
        std::ranges::stable_sort(candidates, std::greater(), &std::pair<double, DesignLayer>::first);
        for (auto const& [value, one] : candidates) {
            if (!search.keeps_limits(one.drive)) continue;
            if (!must_carry) return one;
            if (auto const depth = search.carrying_depth(one.drive, one.depth)) return {one.drive, *depth};
        }
    }
    if (!must_carry) return layer;
    return {layer.drive, search.carrying_depth(layer.drive, layer.depth).value_or(layer.depth)};
}

/// Where no machine conveys anything at the confidence: the one that carries most at an even chance.
RiskDesign most_likely(RiskSearch const& search, RiskSearch::Layers layers, DesignLayer const& otherwise) {
    DesignTask even = search.task();
    even.confidence = 0.5;
    RiskSearch likely(even, layers);
    auto const found = likely.strongest();
    return described(search, found ? rounded(likely, found->layer, false) : otherwise);
}

/// The best machine among some layers; nothing when there is none among them.
std::optional<RiskDesign> best_among(DesignTask const& task, RiskSearch::Layers layers) {
    RiskSearch search(task, layers);
    theory::DriveSpace const& space = search.allowed().drives;
    theory::Drive const weakest{space.frequency.low, space.amplitude.low, space.vibration_angle.low,
                                (space.inclination.low + space.inclination.high) / 2};
    if (theory::excess(space, weakest) > 0) throw std::invalid_argument(why_no_machine(task));
    auto const strongest = search.strongest();
    if (!strongest) return {};
    DesignLayer const& most = strongest->layer;
    double const flow = search.sure_flow(most);
    if (flow <= 0) return most_likely(search, layers, most);
    if (flow < task.mass_flow) return described(search, rounded(search, most, false));
    auto const better = search.best_that_carries(*strongest);
    return described(search, rounded(search, better ? better->layer : most, true));
}

/// Why the models of a task know no layer within its limits, where another model has found a machine.
std::string why_not_known(DesignTask const& task, DesignLayer const& layer) {
    if (task.unknown_material) return *task.unknown_material;
    if (auto const why = untested(task, layer)) return *why;
    return task.models.front().name + " knows no layer within the limits";
}

/// A machine by the model that stands in where those of the task know no layer within the limits.
RiskDesign by_stand_in(DesignTask const& task) {
    DesignTask other = task;
    other.models = {*task.stand_in};
    std::erase_if(other.beside, [&](DesignModel const& m) { return m.name == task.stand_in->name; });
    auto design = best_among(other, RiskSearch::Layers::all);
    if (!design) throw std::invalid_argument(why_no_machine(other));
    design->untested = why_not_known(task, {design->drive, design->depth});
    design->feasible = false;
    design->width_needed.reset();
    return *design;
}

/// The same; by the point mass where the model that stands in knows no layer within the limits either.
RiskDesign by_any_stand_in(DesignTask const& task) {
    try {
        return by_stand_in(task);
    } catch (std::invalid_argument const&) {
        if (task.stand_in->is_point_mass) throw;
    }
    DesignTask other = task;
    other.stand_in = point_mass_design_model();
    return by_stand_in(other);
}

/// The best machine whose speed of the drive may be anything within its range.
RiskDesign design_at_any_speed(DesignTask const& task) {
    if (!task.unknown_material) {
        try {
            if (auto found = best_among(task, RiskSearch::Layers::tested)) return *found;
        } catch (std::invalid_argument const&) {
            if (!task.stand_in) throw;
        }
    }
    if (task.stand_in) return by_any_stand_in(task);
    if (auto found = best_among(task, RiskSearch::Layers::all)) return *found;
    throw std::invalid_argument(why_no_machine(task));
}

/// How good a machine is, to be compared with one for another speed of the drive: first whether it reaches
/// the mass flow, then the objective; without the mass flow, whether its speed is known, and what it carries.
std::pair<int, double> worth(DesignTask const& task, RiskDesign const& d) {
    if (!d.feasible) return {d.untested ? 0 : 1, d.sure_flow};
    switch (task.objective) {
        case Objective::fastest:
            break;
        case Objective::gentlest_landing:
            return {2, -d.landing_speed};
        case Objective::least_machine_number:
            return {2, -d.machine_number};
        case Objective::least_power:
            return {2, -d.power_per_mass / d.sure_speed};
    }
    return {2, d.sure_speed};
}

/// The task for each speed and stroke that can be had.
std::vector<DesignTask> choices_of(DesignTask const& task) {
    std::vector<DesignTask> all{task};
    all.front().frequencies.clear();
    all.front().amplitudes.clear();
    auto const choose = [&](std::vector<double> const& values, theory::Range theory::DriveSpace::*range) {
        if (values.empty()) return;
        std::vector<DesignTask> chosen;
        for (DesignTask const& one : all) {
            for (double const value : values) {
                chosen.push_back(one);
                chosen.back().space.*range = {value, value};
            }
        }
        all = chosen;
    };
    choose(task.frequencies, &theory::DriveSpace::frequency);
    choose(task.amplitudes, &theory::DriveSpace::amplitude);
    return all;
}

/// Why there is no machine for any of them, without a full stop.
std::string why_no_choice(DesignTask const& task, std::vector<Choice> const& choices) {
    std::string text;
    for (Choice const& one : choices) {
        text += text.empty() ? "" : "; ";
        if (!task.frequencies.empty()) text += fmt::format("at {:.4g} 1/min ", 60 * one.frequency);
        if (!task.amplitudes.empty()) text += fmt::format("with a stroke of {:.4g} mm ", 2e3 * one.amplitude);
        text += one.why_none;
    }
    return text;
}

RiskDesign best_of_choices(DesignTask const& task) {
    std::vector<Choice> choices;
    for (DesignTask const& one : choices_of(task)) {
        try {
            auto const design = std::make_shared<RiskDesign const>(design_at_any_speed(one));
            choices.push_back({design->drive.frequency, design->drive.amplitude, design});
        } catch (std::invalid_argument const& error) {
            auto const given = [](theory::Range const& r) { return r.low == r.high ? r.low : 0; };
            choices.push_back({given(one.space.frequency), given(one.space.amplitude), {}, error.what()});
        }
    }
    std::vector<Choice*> found;
    for (Choice& one : choices)
        if (one.design) found.push_back(&one);
    if (found.empty()) throw std::invalid_argument(why_no_choice(task, choices));
    // Of equals, the first that was asked for is the better one.
    std::ranges::stable_sort(found, std::greater(), [&](Choice const* c) { return worth(task, *c->design); });
    for (std::size_t i = 0; i < found.size(); ++i) found[i]->rank = static_cast<int>(i) + 1;
    RiskDesign best = *found.front()->design;
    best.choices = choices;
    return best;
}

}  // namespace

RiskDesign design_with_risk(DesignTask const& task) {
    check(task);
    bool const is_free = task.frequencies.empty() && task.amplitudes.empty();
    return is_free ? design_at_any_speed(task) : best_of_choices(task);
}

RiskDesign judge_machine(DesignTask const& task, theory::Drive const& drive, double depth) {
    check(task);
    DesignTask one = task;
    if (!one.frequencies.empty()) one.space.frequency = {drive.frequency, drive.frequency};
    if (!one.amplitudes.empty()) one.space.amplitude = {drive.amplitude, drive.amplitude};
    RiskSearch const search(one, RiskSearch::Layers::all);
    return described(search, {drive, depth});
}

std::optional<std::string> untested(DesignTask const& task, DesignLayer const& layer) {
    constexpr double share = 0.95;
    if (auto const narrow =
            task.grain_diameter ? atlas::why_too_narrow(task.width / *task.grain_diameter) : std::nullopt)
        return "no layer was simulated between " + *narrow;
    auto const [low, high] = task.friction.central(share);
    auto const depth = task.in_grains(layer.depth);
    for (DesignModel const& model : task.models) {
        if (auto const why = model.untested(layer.drive, task.friction.median, depth)) return why;
        for (double const mu : {low, high})
            if (auto const why = model.untested(layer.drive, mu, depth))
                return fmt::format("{}, which the friction may be ({:.3g} to {:.3g} with 95 %)", *why, low,
                                   high);
    }
    return {};
}

}  // namespace vibrotrough::learn
