#include "compare/compared_cases.hpp"

#include "campaign/state/friction_results.hpp"
#include "campaign/state/numerics_results.hpp"
#include "compare/exports.hpp"
#include "scenario/reader/shake_test.hpp"

#include <optional>

#include <nlohmann/json.hpp>

namespace vibrotrough::compare {

ComparedCases compared_cases(campaign::Plan const& plan, campaign::Activity const& activity,
                             campaign::OverviewSink const& sink) {
    auto const tests = campaign::read_friction(plan.folder);
    auto const numerics = campaign::read_case_numerics(plan);
    ComparedCases found{.cases = {}, .rows = {}, .columns = columns_with_swept(plan.swept)};
    found.rows.resize(plan.cases.size());
    auto const add_row = [&](std::size_t i, campaign::CaseOverview const& one,
                             store::CaseRecord const* record) {
        campaign::PlannedCase const& planned = *one.planned;
        std::optional<MeasuredFriction> friction;
        if (auto const test = tests.find(layer_key(planned.scenario())); test != tests.end())
            friction = {*test->second.friction, *test->second.low, *test->second.high};
        std::optional<store::CaseRecord> measured;
        if (record != nullptr) measured = *record;
        if (auto const known = numerics.find(planned.id); measured && known != numerics.end())
            measured->studied = known->second;
        Row row = compare(planned.id, *planned.prepared, measured, std::string(one.label()), friction);
        for (scenario::Key const* const key : plan.swept)
            row.swept.push_back(swept_value(planned.scenario(), *key));
        found.rows[i] = std::move(row);
        if (sink) sink(i, one, record);
    };
    found.cases = campaign::survey(plan, activity, add_row);
    return found;
}

Row planned_row(campaign::Plan const& plan, campaign::CaseOverview const& one) {
    Row row = drive_row(one.planned->id, *one.planned->prepared);
    for (scenario::Key const* const key : plan.swept)
        row.swept.push_back(swept_value(one.planned->scenario(), *key));
    return row;
}

nlohmann::ordered_json case_list(ComparedCases const& compared) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < compared.rows.size(); ++i) {
        nlohmann::ordered_json object = to_object(compared.rows[i], compared.columns);
        object["label"] = compared.cases[i].planned->label;
        object["message"] = compared.cases[i].message;
        object["packings_done"] = compared.cases[i].packings_done;
        object["packings_wanted"] = compared.cases[i].planned->scenario().measure.packings;
        list.push_back(std::move(object));
    }
    return list;
}

}  // namespace vibrotrough::compare
