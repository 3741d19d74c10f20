#include "app/compared_cases.hpp"

namespace vibrotrough::app {

ComparedCases compared_cases(campaign::Plan const& plan) {
    ComparedCases found{.cases = campaign::look_at(plan), .rows = {}};
    for (campaign::CaseOverview const& one : found.cases) {
        found.rows.push_back(
            compare::compare(one.planned->id, one.planned->scenario, one.record, one.outcome));
    }
    return found;
}

}  // namespace vibrotrough::app
