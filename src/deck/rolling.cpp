#include "deck/rolling.hpp"

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace vibrotrough::deck {
namespace {

/// A contact slides if its friction is mu times its normal force. The engine sets it to that; the force of
/// the floor is the difference of the forces on the grain before and after, in which ten digits remain.
constexpr double of_the_limit = 1 - 1e-6;

/// The columns of rolling.csv after the step, in the order of the sums in the template.
constexpr std::array<std::string_view, 16> of_grains{
    "loaded",       "sliding",       "friction",   "torque", "contacts",  "all_contacts",
    "first",        "first_vx",      "first_spin", "second", "second_vx", "second_spin",
    "first_volume", "second_volume", "floor_x",    "floor_z"};

}  // namespace

void describe_rolling(core::TemplateData& data, prepare::PreparedCase const& prepared) {
    scenario::Scenario const& s = prepared.scenario;
    data.set("rolling", s.measure.rolling);
    if (!s.measure.rolling) return;
    int const steps = rolling_stride * (prepared.time.steps_per_cycle / prepare::phases_per_cycle);
    double const limit = of_the_limit * s.trough.friction;
    data.set("rolling_steps", std::to_string(steps));
    data.set("sliding_limit", fmt::format("{}", limit * limit));
    data.set("first_top", fmt::format("{}", mean_diameter(s)));
    data.set("second_top", fmt::format("{}", 2 * mean_diameter(s)));
    std::vector<core::TemplateData> columns;
    std::string header = "step", values = "${now}";
    auto const add = [&](std::string_view name, std::string const& value) {
        core::TemplateData column;
        column.set("name", fmt::format("rolling_{}", name));
        column.set("value", value);
        columns.push_back(std::move(column));
        header += fmt::format(",{}", name);
        values += fmt::format(",${{rolling_{}}}", name);
    };
    int place = 0;
    for (std::string_view const name : of_grains) add(name, fmt::format("c_grains[{}]", ++place));
    add("floor_torque", "c_floor_torque");
    data.set("rolling_columns", std::move(columns));
    data.set("rolling_header", header);
    data.set("rolling_values", values);
}

}  // namespace vibrotrough::deck
