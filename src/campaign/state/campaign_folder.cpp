#include "campaign/state/campaign_folder.hpp"

#include "campaign/state/older_cases.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::campaign {
namespace {

namespace fs = std::filesystem;

/// An edited campaign may continue in its folder; a different one would hide the cases of the first.
void refuse_other_campaign(Plan const& plan) {
    fs::path const frozen = plan.folder / "campaign.toml";
    std::string name;
    try {
        if (fs::is_regular_file(frozen)) name = scenario::read_campaign(frozen).name;
    } catch (core::InputError const&) {
        return;  // damaged, or of an older program: it is frozen again
    }
    if (name.empty() || name == plan.name) return;
    throw core::InputError(
        fmt::format("{} holds the campaign '{}', not '{}'; choose another folder with --output",
                    plan.folder.string(), name, plan.name));
}

}  // namespace

void write_named_files(scenario::Scenario const& scenario, fs::path const& folder) {
    for (scenario::NamedFile const& file : named_files(scenario)) {
        std::error_code missing;
        if (!fs::exists(folder / file.name, missing) || core::read_file(folder / file.name) != file.content)
            core::write_file_atomically(folder / file.name, file.content);
    }
}

void write_scenario(scenario::Scenario const& scenario, fs::path const& folder) {
    core::make_folder(folder);
    write_named_files(scenario, folder);
    core::replace_file(folder / "scenario.toml", to_toml(scenario));
}

void write_case_files(PlannedCase const& planned) {
    // First: when the deck and the scenario are written again, they no longer prove the old id.
    if (planned.id != planned.current_id) write_current_id(planned.folder, planned.current_id);
    write_scenario(planned.scenario(), planned.folder);
}

void freeze(Plan const& plan, fs::path const& campaign_file, engine::Engine const& engine) {
    core::make_folder(plan.folder / "cases");
    refuse_other_campaign(plan);
    nlohmann::ordered_json const json{{"program", engine.program.string()}, {"version", engine.version}};
    core::write_file_atomically(plan.folder / "engine.json", json.dump(2) + "\n");
    for (fs::path const& file : plan.files)
        core::write_file_atomically(plan.folder / file.filename(), core::read_file(file));
    fs::path const certificate = plan.folder / "certificate.json";
    if (engine.certificate.empty()) {
        fs::remove(certificate);  // it belongs to another engine
    } else {
        core::write_file_atomically(certificate, engine.certificate);
    }
    for (PlannedCase const& planned : plan.cases) write_named_files(planned.scenario(), plan.folder);
    core::write_file_atomically(plan.folder / "campaign.toml", core::read_file(campaign_file));
}

scenario::Campaign read_frozen_campaign(fs::path const& folder) {
    std::error_code ignored;  // a name that is too long is not a folder either
    if (!fs::is_regular_file(folder / "campaign.toml", ignored) ||
        !fs::is_regular_file(folder / "engine.json", ignored)) {
        throw core::InputError(fmt::format(
            "{} is not a campaign folder (it has no campaign.toml and engine.json); give the folder "
            "that 'vibrotrough run' made",
            folder.string()));
    }
    return scenario::read_campaign(folder / "campaign.toml");
}

Plan open_plan(fs::path const& folder) {
    scenario::Campaign const campaign = read_frozen_campaign(folder);
    return make_plan(campaign, folder, read_engine(folder).version);
}

engine::Engine read_engine(fs::path const& folder) {
    try {
        auto const json = nlohmann::json::parse(core::read_file(folder / "engine.json"));
        return {json.at("program").get<std::string>(), json.at("version").get<std::string>()};
    } catch (nlohmann::json::exception const&) {
        throw core::InputError(fmt::format("{} is damaged; run the campaign again to repair it",
                                           (folder / "engine.json").string()));
    }
}

bool is_case_id(std::string_view text) {
    return text.size() == 12 && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

PlannedCase open_case(fs::path const& folder, std::string const& id, std::string const& engine_version) {
    fs::path const file = folder / "cases" / id / "scenario.toml";
    if (!is_case_id(id) || !fs::is_regular_file(file))
        throw core::InputError(
            fmt::format("there is no case '{}' in {}; give the folder that 'vibrotrough run' made",
                        core::printable(id, 60), folder.string()));
    scenario::Campaign const frozen = scenario::read_campaign(file);
    if (frozen.cases.size() == 1) {
        PlannedCase planned = plan_case(frozen.cases.front(), folder, engine_version);
        if (planned.id == id) return planned;
    }
    throw core::InputError(
        fmt::format("{} is not the case that its folder's name says (was it written by another version of "
                    "vibrotrough?); run the campaign again",
                    file.string()));
}

}  // namespace vibrotrough::campaign
