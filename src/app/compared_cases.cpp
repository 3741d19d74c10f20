#include "app/compared_cases.hpp"

#include "campaign/execute/executors.hpp"
#include "campaign/state/friction_results.hpp"
#include "scenario/reader/shake_test.hpp"

#include <optional>

namespace vibrotrough::app {

ComparedCases compared_cases(campaign::Plan const& plan) {
    auto const tests = campaign::read_friction(plan.folder);
    ComparedCases found{.cases = campaign::survey(plan, campaign::activity_in(plan.folder)), .rows = {}};
    for (campaign::CaseOverview const& one : found.cases) {
        std::optional<compare::MeasuredFriction> friction;
        if (auto const test = tests.find(layer_key(one.planned->scenario())); test != tests.end())
            friction = {*test->second.friction, *test->second.low, *test->second.high};
        found.rows.push_back(compare::compare(one.planned->id, *one.planned->prepared, one.record,
                                              std::string(one.label()), friction));
    }
    return found;
}

}  // namespace vibrotrough::app
