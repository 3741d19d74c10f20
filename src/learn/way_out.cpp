#include "learn/way_out.hpp"

#include "core/text.hpp"
#include "learn/layer_search.hpp"
#include "learn/machine_keys.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::learn {
namespace {

constexpr double given_up = 1e4;  // a largest value that no longer limits

using DriveFunction = std::function<double(theory::Drive const&)>;

/// A limit of a task.
struct Limit {
    std::string_view name, unit;
    double in_unit;         ///< what one in SI is in the unit
    theory::Range allowed;  ///< of a quantity above zero
    DriveFunction value;
    std::function<void(DesignTask&)> give_up;
};

/// The hardest landing of the point mass at the least, the middle and the largest friction.
double hardest_landing(KnownFriction const& friction, theory::Drive const& drive) {
    return std::max({landing_speed(drive, friction.low), landing_speed(drive, friction.median),
                     landing_speed(drive, friction.high)});
}

/// What all models of a task leave of its limits; the depths may be empty.
AllowedLayers allowed_drives(DesignTask const& task) {
    AllowedLayers allowed{task.space, task.depth};
    allowed.drives.inclination = theory::with_friction_margin(task.space.inclination, task.friction.low);
    for (DesignModel const& model : task.models) model.speeds->narrow(allowed.drives, allowed.depth);
    return allowed;
}

std::vector<std::string> known_ranges(DesignTask const& task) {
    std::vector<std::string> known;
    for (DesignModel const& model : task.models)
        if (!model.known_range.empty())
            known.push_back(fmt::format("{} knows {}", model.name, model.known_range));
    return known;
}

/// The drive that is best in something among those that keep all limits of a task, whatever it carries.
std::optional<theory::Drive> best_within(DesignTask const& task, DriveFunction const& merit) {
    LayerGoal goal;
    goal.merit = [&](DesignLayer const& layer) { return merit(layer.drive); };
    for (DesignModel const& model : task.models)
        if (!model.is_point_mass)
            goal.excesses.emplace_back([&](DesignLayer const& layer) { return model.excess(layer.drive); });
    if (task.landing_speed)
        goal.excesses.emplace_back([&](DesignLayer const& layer) {
            return hardest_landing(task.friction, layer.drive) / *task.landing_speed - 1;
        });
    try {
        auto const found =
            best_layers(LayerSpace(allowed_drives(task).drives, {task.depth.low, task.depth.low}), goal);
        return found.empty() ? std::nullopt : std::optional(found.front().layer.drive);
    } catch (std::invalid_argument const&) {
        return {};
    }
}

/// A value to three digits, beyond the one that is needed.
std::string next_value(double needed, bool above) {
    double const unit = std::pow(10, std::floor(std::log10(needed)) - 2);
    return core::plain_number((above ? std::ceil(needed / unit) : std::floor(needed / unit)) * unit, 4);
}

/// The limits that may be given up one at a time. All angles and slopes of a trough that conveys are allowed
/// then, any stroke up to 200 mm and any speed up to 12,000 1/min.
std::vector<Limit> limits_of(DesignTask const& task) {
    using theory::Drive;
    theory::DriveSpace const& space = task.space;
    double const g = space.gravity;
    auto const machine = [=](Drive const& d) { return d.machine_number(g); };
    auto const thrown = [=](Drive const& d) { return d.throw_number(g); };
    auto const number = [](double Drive::*which) { return [=](Drive const& d) { return d.*which; }; };
    auto const widen = [](theory::Range theory::DriveSpace::*range, theory::Range const& all) {
        return [=](DesignTask& t) { t.space.*range = all; };
    };
    auto const lift = [](double theory::DriveSpace::*most) {
        return [=](DesignTask& t) { t.space.*most = given_up; };
    };
    char const* const stroke = task.tells_amplitude ? "amplitude" : "stroke";
    char const* const speed = task.tells_frequency ? "frequency" : "speed of the drive";
    double const in_mm = task.tells_amplitude ? 1000 : 2000, in_turns = task.tells_frequency ? 1 : 60;
    char const* const turns = task.tells_frequency ? " Hz" : " 1/min";
    using Space = theory::DriveSpace;
    std::vector<Limit> limits{
        {"machine number", "", 1, {0, space.max_machine_number}, machine, lift(&Space::max_machine_number)},
        {"throw number", "", 1, {0, space.max_throw_number}, thrown, lift(&Space::max_throw_number)},
        {stroke, " mm", in_mm, space.amplitude, number(&Drive::amplitude),
         widen(&Space::amplitude, {1e-6, 0.1})},
        {speed, turns, in_turns, space.frequency, number(&Drive::frequency),
         widen(&Space::frequency, {0.5, 200})},
        {"vibration angle", " degrees", 1 / degree, space.vibration_angle, number(&Drive::vibration_angle),
         widen(&Space::vibration_angle, {degree, 89 * degree})}};
    if (task.landing_speed) {
        auto const hardest = [&task](Drive const& d) { return hardest_landing(task.friction, d); };
        limits.push_back({"landing speed", " m/s", 1, {0, *task.landing_speed}, hardest, [](DesignTask& t) {
                              t.landing_speed.reset();
                          }});
    }
    return limits;
}

/// The value of a limit that lets a machine through when all others stay; nothing when there is none.
std::optional<std::string> way_past(Limit const& limit, DesignTask task) {
    limit.give_up(task);
    auto const beyond_range = [&](theory::Drive const& d) {
        return std::max(limit.value(d) / limit.allowed.high, limit.allowed.low / limit.value(d));
    };
    auto const drive = best_within(task, [&](theory::Drive const& d) { return -std::log(beyond_range(d)); });
    if (!drive || beyond_range(*drive) <= 1) return {};
    double const value = limit.value(*drive);
    bool const above = value > limit.allowed.high;
    return fmt::format("{} {} of {}{} or {}", limit.name.starts_with('a') ? "an" : "a", limit.name,
                       next_value(limit.in_unit * value, above), limit.unit, above ? "more" : "less");
}

}  // namespace

AllowedLayers allowed_layers(DesignTask const& task) {
    AllowedLayers allowed = allowed_drives(task);
    auto& [low, high] = allowed.depth;
    // Ends that are the same but for rounding.
    if (low > high && low < high * (1 + 1e-9)) low = high;
    if (low <= high) return allowed;
    throw std::invalid_argument(fmt::format("a layer {:.3g} to {:.3g} mm deep has not been simulated; {}",
                                            1e3 * task.depth.low, 1e3 * task.depth.high,
                                            fmt::join(known_ranges(task), ", ")));
}

std::string why_no_machine(DesignTask const& task) {
    std::vector<std::string> ways;
    for (Limit const& limit : limits_of(task))
        if (auto const way = way_past(limit, task)) ways.push_back(*way);
    std::string text = "the limits exclude every machine, whatever it carries";
    if (auto const known = known_ranges(task); !known.empty())
        text += fmt::format("; {}", fmt::join(known, ", "));
    if (ways.empty()) return text + "; no limit alone is the reason";
    return text + fmt::format("; {} would let one through", fmt::join(ways, ", or "));
}

}  // namespace vibrotrough::learn
