#include "app/learning.hpp"

#include "app/commands/option_table.hpp"
#include "app/standard_streams.hpp"
#include "campaign/schedule/until_precise.hpp"
#include "campaign/state/added_cases.hpp"
#include "campaign/state/overview.hpp"
#include "core/error.hpp"

#include <algorithm>
#include <filesystem>

namespace vibrotrough::app {

double read_core_time(std::string const& text) {
    std::string plain = text;
    if (auto const at = plain.find("core-"); at != std::string::npos) plain.erase(at, 5);
    return read_positive_quantity("--budget", plain, "s", "4 core-hours");
}

std::map<std::string, scenario::Content> read_place(std::vector<std::string> const& settings,
                                                    scenario::CaseMaker const& maker) {
    std::map<std::string, scenario::Content> values;
    for (std::string const& setting : settings) {
        auto const equal = setting.find('=');
        if (equal == std::string::npos || equal == 0)
            throw core::InputError(
                fmt::format("--at {}: is not KEY=VALUE; write for example --at {}=...", setting,
                            maker.varied_keys().empty() ? "throw_number" : maker.varied_keys().front()));
        try {
            std::string const key = maker.full_key(setting.substr(0, equal));
            if (!values.emplace(key, maker.read_value(key, setting.substr(equal + 1))).second)
                throw core::InputError(fmt::format("{} is given twice; keep one", key));
        } catch (core::InputError const& error) {
            throw core::InputError(fmt::format("--at {}: {}", setting, error.what()));
        }
    }
    return values;
}

int usual_batch(int jobs, campaign::Plan const& plan) {
    int const packings = plan.cases.empty() ? 1 : plan.cases.front().scenario().measure.packings;
    return std::max(1, jobs / std::max(1, packings));
}

bool simulate(RunOptions const& options, ReadyCampaign& ready, std::map<std::string, double>& wanted) {
    for (campaign::PlannedCase const& planned : ready.plan.cases)
        wanted.emplace(planned.id, planned.scenario().measure.half_width);
    learn::write_wanted_half_widths(ready.plan.folder, wanted);
    ready.inputs.is_learning = true;
    campaign::Summary const summary =
        drive_campaign(options, ready, *campaign::make_policy(wanted), campaign::Until::done, *ready.kind);
    if (summary.interrupted) tell("interrupted; the same command continues it\n");
    return !summary.interrupted;
}

void tell_of_other_layers(int count) {
    if (count == 0) return;
    tell("left out, as the campaign file describes another layer now: {} added case{}\n", count,
         count == 1 ? "" : "s");
}

void keep_known_cases(campaign::Plan& plan, scenario::CaseMaker const& maker,
                      std::map<std::string, double> const& wanted) {
    tell_of_other_layers(learn::leave_out_other_layers(plan, maker));
    for (auto const& [id, half_width] : wanted) {
        auto const file = plan.folder / "cases" / id / "scenario.toml";
        std::error_code missing;
        if (!std::filesystem::is_regular_file(file, missing)) continue;
        try {
            auto const known = scenario::read_campaign(file).cases;
            if (known.size() != 1) continue;
            if (auto const now = learn::same_layer(known.front(), id, plan, maker))
                campaign::add_case(plan, *now);
        } catch (core::Error const&) {  // damaged
        }
    }
}

bool take_steps(std::vector<learn::LearnStep> const& steps, campaign::Plan& plan,
                std::map<std::string, double>& wanted) {
    bool is_new = false;
    for (learn::LearnStep const& step : steps) {
        if (!step.added) {
            is_new = is_new || step.half_width < wanted[step.case_id];
            wanted[step.case_id] = step.half_width;
        } else if (campaign::PlannedCase const* const added = campaign::add_case(plan, *step.added)) {
            wanted[added->id] = step.half_width;
            is_new = true;
        }
    }
    learn::write_wanted_half_widths(plan.folder, wanted);
    return is_new;
}

}  // namespace vibrotrough::app
