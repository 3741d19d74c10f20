#include "campaign/state/numerics_results.hpp"

#include "campaign/state/case_state.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "scenario/reader/campaign_file.hpp"
#include "scenario/reader/written_campaign.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::campaign {
namespace {

namespace fs = std::filesystem;
using core::note::Json;

evaluate::StudyResult result_of(Plan const& plan, scenario::Scenario const& scenario) {
    std::string const id = case_id(prepare::prepare_case(scenario), plan.engine_version);
    auto const planned = std::ranges::find(plan.cases, id, &PlannedCase::id);
    if (planned == plan.cases.end()) return {id, {}, {}, "not part of the study"};
    if (auto const record = read_whole_result(*planned)) {
        if (record->outcome == core::Outcome::not_steady)
            return {id, {}, {}, "not-steady: allow more cycles (measure.max_cycles)"};
        return {id, record->estimate.mean, record->estimate.half_width, ""};
    }
    auto const failure = read_failure(*planned);
    return {id,
            {},
            {},
            failure ? fmt::format("{}: {}", name_of(failure->outcome), failure->message) : "not finished"};
}

Json describe(evaluate::StudyResult const& result) {
    return {{"case", result.case_id},
            {"efficiency", core::note::known_or_null(result.mean)},
            {"efficiency_half_width_statistics", core::note::known_or_null(result.half_width)},
            {"message", result.message}};
}

Json describe(evaluate::SettingError const& setting) {
    Json variations = Json::array();
    for (evaluate::MeasuredVariation const& one : setting.variations) {
        Json variation{{"value", one.value}, {"coarseness", one.coarseness}};
        variation.update(describe(one.result));
        variation["error"] = core::note::known_or_null(one.error);
        variation["error_half_width"] = core::note::known_or_null(one.half_width);
        variations.push_back(std::move(variation));
    }
    std::string_view const verdict = setting.is_left_out() ? "left-out"
                                     : setting.error       ? evaluate::name_of(setting.error->verdict)
                                                           : "unknown";
    Json json{{"setting", name_of(setting.setting)},
              {"title", title_of(setting.setting)},
              {"key", key_of(setting.setting)},
              {"unit", unit_of(setting.setting)},
              {"default", setting.value},
              {"order", core::note::known_or_null(setting.order)},
              {"verdict", verdict},
              {"measured_error", nullptr},
              {"measured_half_width", nullptr},
              {"error", nullptr},
              {"error_half_width", nullptr},
              {"bound", setting.is_left_out() ? Json(0.0) : Json(nullptr)},
              {"message", setting.message},
              {"variations", std::move(variations)}};
    json["expected_half_width"] = std::isinf(setting.expected) ? Json(nullptr) : Json(setting.expected);
    if (auto const known = setting.known_error()) {
        json["measured_error"] = setting.error->error;
        json["measured_half_width"] = setting.error->half_width;
        json["error"] = known->error;
        json["error_half_width"] = known->half_width;
        json["bound"] = known->bound();
    }
    return json;
}

Json describe(evaluate::NumericsBudget const& budget) {
    Json settings = Json::array();
    for (evaluate::SettingError const& one : budget.settings) settings.push_back(describe(one));
    return {{"case", budget.case_id},
            {"confidence", budget.confidence},
            {"default", describe(budget.standard)},
            {"numerical_error", core::note::known_or_null(budget.numerical_error())},
            {"settings", std::move(settings)}};
}

/// The list of budgets in the file; empty when there is no file. @throws core::InputError when it is damaged
Json read_list(fs::path const& campaign_folder) {
    fs::path const path = numerics_file(campaign_folder);
    if (!fs::is_regular_file(path)) return Json::array();
    try {
        return parse_numerics(core::read_file(path, core::largest_note));
    } catch (core::note::Fault const& fault) {
        throw core::InputError(
            fmt::format("{} is damaged; delete it and run 'vibrotrough convergence' again, which "
                        "simulates nothing a second time ({})",
                        path.string(), fault.what()));
    }
}

/// The scenario as it comes back from the study's campaign file, where the number of grains may be rounded.
scenario::Scenario as_read_back(scenario::Scenario const& scenario) {
    return scenario::parse_campaign(to_toml(scenario), "study", {{}, named_files(scenario)}).cases.front();
}

}  // namespace

std::vector<scenario::Scenario> NumericsStudy::scenarios() const {
    std::vector<scenario::Scenario> all;
    if (!known) all.push_back(standard.scenario);
    for (prepare::VariedSetting const& setting : settings) {
        for (prepare::NumericalVariation const& one : setting.variations) all.push_back(one.scenario);
    }
    return all;
}

NumericsStudy plan_study(PlannedCase const& planned, std::optional<double> half_width) {
    scenario::Scenario scenario = planned.scenario();
    require_steady_drive(scenario, "convergence");
    scenario.output.frames_per_cycle = 0;
    if (half_width) scenario.measure.half_width = *half_width;
    NumericsStudy study{planned.id, prepare::prepare_case(as_read_back(scenario)), {}, {}};
    auto const record = read_whole_result(planned);
    if (record && record->estimate.mean && record->outcome != core::Outcome::not_steady) {
        auto const& estimate = record->estimate;
        if (estimate.half_width && *estimate.half_width <= scenario.measure.half_width)
            study.known = evaluate::StudyResult{planned.id, estimate.mean, estimate.half_width, ""};
    }
    study.settings = vary_numerics(study.standard);
    for (prepare::VariedSetting& setting : study.settings) {
        for (prepare::NumericalVariation& one : setting.variations) one.scenario = as_read_back(one.scenario);
    }
    return study;
}

std::vector<std::size_t> representative_cases(std::size_t count) {
    std::vector<std::size_t> chosen;
    if (count == 0) return chosen;
    for (std::size_t const number : {std::size_t{0}, (count - 1) / 2, count - 1}) {
        if (chosen.empty() || number != chosen.back()) chosen.push_back(number);
    }
    return chosen;
}

std::vector<evaluate::NumericsBudget> measure_numerics(Plan const& plan,
                                                       std::vector<NumericsStudy> const& studies) {
    std::vector<evaluate::NumericsBudget> budgets;
    for (NumericsStudy const& study : studies) {
        std::vector<evaluate::StudyResult> results;
        for (scenario::Scenario const& one : study.scenarios()) results.push_back(result_of(plan, one));
        if (study.known) results.insert(results.begin(), *study.known);
        budgets.push_back(evaluate::make_budget(study.case_id, study.standard.scenario.measure.confidence,
                                                results.front(), study.settings,
                                                {results.begin() + 1, results.end()}));
    }
    return budgets;
}

fs::path numerics_file(fs::path const& campaign_folder) {
    return campaign_folder / "numerics.json";
}

void write_numerics(fs::path const& campaign_folder, std::vector<evaluate::NumericsBudget> const& budgets) {
    Json list = Json::array();
    for (Json const& kept : read_list(campaign_folder)) {
        bool const is_new = std::ranges::any_of(
            budgets, [&](auto const& one) { return kept.value("case", "") == one.case_id; });
        if (!is_new) list.push_back(kept);
    }
    for (evaluate::NumericsBudget const& one : budgets) list.push_back(describe(one));
    Json const json{
        {"format", numerics_format}, {"schema_version", numerics_schema}, {"cases", std::move(list)}};
    core::write_file_atomically(numerics_file(campaign_folder), core::note::sealed(json));
}

std::map<std::string, double> read_case_numerics(fs::path const& campaign_folder) {
    std::map<std::string, double> studied;
    for (Json const& one : read_list(campaign_folder)) {
        if (Json const& error = one.at("numerical_error"); !error.is_null())
            studied[one.at("case")] = error.get<double>();
    }
    return studied;
}

}  // namespace vibrotrough::campaign
