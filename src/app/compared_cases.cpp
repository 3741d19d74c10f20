#include "app/compared_cases.hpp"

#include "campaign/friction_test.hpp"
#include "scenario/reader/shake_test.hpp"

#include <optional>

namespace vibrotrough::app {

ComparedCases compared_cases(campaign::Plan const& plan) {
    auto const tests = campaign::read_friction(plan.folder);
    ComparedCases found{.cases = campaign::look_at(plan), .rows = {}};
    for (campaign::CaseOverview const& one : found.cases) {
        std::optional<compare::MeasuredFriction> friction;
        if (auto const test = tests.find(layer_key(one.planned->scenario)); test != tests.end())
            friction = {*test->second.friction, *test->second.low, *test->second.high};
        found.rows.push_back(
            compare::compare(one.planned->id, one.planned->scenario, one.record, one.outcome, friction));
    }
    return found;
}

}  // namespace vibrotrough::app
