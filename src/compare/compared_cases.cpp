#include "compare/compared_cases.hpp"

#include "campaign/state/friction_results.hpp"
#include "campaign/state/numerics_results.hpp"
#include "campaign/state/observables.hpp"
#include "compare/exports.hpp"
#include "scenario/reader/shake_test.hpp"

#include <algorithm>
#include <atomic>
#include <optional>

#include <nlohmann/json.hpp>

namespace vibrotrough::compare {

namespace {

/// Whether an observable was measured in an earlier result of the case.
bool is_outdated(std::span<store::Observable const> observables, store::CaseRecord const& record) {
    return std::ranges::any_of(observables, [&](store::Observable const& one) {
        auto const is_measured =
            std::ranges::find(one.cases, record.id, &store::ObservedCase::id) != one.cases.end();
        return is_measured && one.of(record) == nullptr;
    });
}

/// The values of the columns of add_observed().
std::vector<std::optional<Value>> observed_values(std::span<store::Observable const> observables,
                                                  store::CaseRecord const& record) {
    std::vector<std::optional<Value>> values;
    for (store::Observable const& one : observables) {
        store::ObservedCase const* const found = one.is_number() ? one.of(record) : nullptr;
        values.push_back(value_of(found == nullptr ? std::nullopt : found->values.front().mean));
        values.push_back(value_of(found == nullptr ? std::nullopt : found->values.front().half_width));
    }
    return values;
}

}  // namespace

std::vector<Column> columns_of(campaign::Plan const& plan) {
    std::vector<Column> columns = columns_with_swept(plan.swept);
    add_observed(columns, campaign::read_observables(plan.folder));
    return columns;
}

ComparedCases compared_cases(campaign::Plan const& plan, campaign::Activity const& activity,
                             campaign::OverviewSink const& sink) {
    auto const tests = campaign::read_friction(plan.folder);
    auto const numerics = campaign::read_case_numerics(plan.folder);
    auto const observables = campaign::read_observables(plan.folder);
    ComparedCases found{.cases = {}, .rows = {}, .columns = columns_of(plan)};
    found.rows.resize(plan.cases.size());
    found.estimates.resize(plan.cases.size());
    std::atomic<int> outdated = 0;  // cases are surveyed by several threads
    auto const add_row = [&](std::size_t i, campaign::CaseOverview const& one,
                             store::CaseRecord const* record) {
        campaign::PlannedCase const& planned = *one.planned;
        std::optional<MeasuredFriction> friction;
        if (auto const test = tests.find(layer_key(planned.scenario())); test != tests.end())
            friction = {*test->second.friction, *test->second.low, *test->second.high};
        std::optional<store::CaseRecord> measured;
        if (record != nullptr) measured = *record;
        if (record != nullptr) found.estimates[i] = record->estimate;
        if (auto const known = numerics.find(planned.id); measured && known != numerics.end())
            measured->studied_error = known->second;
        Row row = compare(planned.id, *planned.prepared, measured, std::string(one.label()), friction);
        for (scenario::Key const* const key : plan.swept)
            row.swept.push_back(swept_value(planned.scenario(), *key));
        if (record != nullptr) row.observed = observed_values(observables, *record);
        if (record != nullptr && is_outdated(observables, *record)) ++outdated;
        found.rows[i] = std::move(row);
        if (sink) sink(i, one, record);
    };
    found.cases = campaign::survey(plan, activity, add_row);
    found.outdated = outdated;
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
