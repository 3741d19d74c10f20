#include "scenario/reader/case_values.hpp"

#include "core/error.hpp"
#include "scenario/reader/given_values.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace vibrotrough::scenario {
namespace {

void complete_packings(MeasurementPlan& plan, GivenKeys const& given) {
    if (plan.max_packings < plan.packings && given.has("measure.max_packings")) {
        given.fail(
            "measure.max_packings",
            fmt::format("{} is less than measure.packings, which is {}", plan.max_packings, plan.packings),
            "write a number that is not smaller, or fewer packings");
    }
    if (plan.min_cycles && *plan.min_cycles > plan.max_cycles) {
        given.fail(
            "measure.min_cycles",
            fmt::format("{} is more than measure.max_cycles, which is {}", *plan.min_cycles, plan.max_cycles),
            "write a smaller number, or raise measure.max_cycles");
    }
    plan.max_packings = std::max(plan.max_packings, plan.packings);
}

/// A block represents the point mass of the theory. It has one size and no shape, and because nothing about
/// it is random, one packing is enough.
void complete_block(Scenario& scenario, GivenKeys const& given) {
    if (scenario.layer.block == Block::plate) {
        double const needed = 8 * scenario.grains.diameter;
        constexpr char const* what = "8 diameters, which a plate needs";
        given.require("layer.length", scenario.layer.length, needed, what);
        given.require("layer.width", scenario.layer.width, needed, what);
    }
    scenario.grains.rotation = scenario.layer.block == Block::point ? Rotation::blocked : Rotation::free;
    scenario.grains.rolling_friction = 0;
    scenario.measure.packings = scenario.measure.max_packings = 1;
}

void check_frames(Scenario const& scenario, GivenKeys const& given) {
    std::vector<int> const& packings = scenario.output.frame_packings;
    int const most = scenario.measure.max_packings;
    if (given.has("output.frame_packings") && !packings.empty() && packings.back() > most)
        given.fail("output.frame_packings",
                   fmt::format("there is no packing {}, because there are at most {}", packings.back(), most),
                   "name fewer, or raise measure.max_packings");
}

/// A case with the given values and the defaults of the other keys.
Scenario with_values(CaseValues const& values, std::string const& file, FileSource const& source) {
    Scenario scenario{};
    for (Key const& key : all_keys()) {
        if (auto const given = values.find(key.path); given != values.end()) {
            key.set(scenario, {key, given->second.content, {file, given->second.where}, source});
        } else if (auto const* number = std::get_if<double>(&key.if_missing)) {
            key.set(scenario, {key, Content(*number), {file, {}}, source});
        }
    }
    return scenario;
}

}  // namespace

void throw_at(FilePosition position, std::string_view key, std::string_view wrong, std::string_view instead) {
    std::string const place = position.file.empty() ? ""
                                                    : fmt::format("{}:{}:{}: ", position.file,
                                                                  position.where.line, position.where.column);
    throw core::InputError(fmt::format("{}{}: {}; {}", place, key, wrong, instead));
}

Scenario make_scenario(CaseValues const& values, std::string const& file, FileSource const& source) {
    GivenKeys const given(values, file);
    Scenario scenario = with_values(values, file, source);
    check_pairs(scenario, given);
    complete_trough(scenario, given);
    complete_grains(scenario, given);
    complete_packings(scenario.measure, given);
    complete_materials(scenario, given);
    complete_stages(scenario, given);
    complete_screen(scenario, given);
    complete_layer(scenario, given);
    if (scenario.layer.block != Block::none) complete_block(scenario, given);
    check_frames(scenario, given);
    check_cohesion(scenario, given);
    return scenario;
}

}  // namespace vibrotrough::scenario
