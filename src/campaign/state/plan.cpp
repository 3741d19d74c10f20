#include "campaign/state/plan.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/text.hpp"
#include "deck/deck.hpp"

#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::campaign {
namespace {

namespace fs = std::filesystem;

std::string case_id(scenario::Scenario scenario, std::string const& engine_version) {
    scenario.campaign = "any";
    deck::Deck const deck = deck::make_deck(scenario, 1);  // the others differ by their seeds only
    std::string all = to_toml(scenario) + engine_version;
    for (auto const& [name, content] : deck.files) all += name + content;
    return core::sha256_hex(all).substr(0, 12);
}

/// An edited campaign may go on in its folder; another one would hide the first one's cases.
void refuse_other_campaign(Plan const& plan) {
    fs::path const frozen = plan.folder / "campaign.toml";
    std::string name;
    try {
        if (fs::is_regular_file(frozen)) name = scenario::read_campaign(frozen).name;
    } catch (core::InputError const&) {
        return;  // damaged, or of an older program: frozen anew
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

void write_case_files(PlannedCase const& planned) {
    core::make_folder(planned.folder);
    write_named_files(planned.scenario, planned.folder);
    core::replace_file(planned.folder / "scenario.toml", to_toml(planned.scenario));
}

Plan make_plan(scenario::Campaign const& campaign, fs::path const& folder,
               std::string const& engine_version) {
    Plan plan{campaign.name, folder, engine_version, {}, campaign.files};
    std::set<std::string> ids;
    for (scenario::Scenario const& scenario : campaign.cases) {
        std::string const id = case_id(scenario, engine_version);
        if (!ids.insert(id).second) continue;  // two ways to write one case are one case
        plan.cases.push_back({id, scenario, folder / "cases" / id});
    }
    return plan;
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
        fs::remove(certificate);  // another engine's
    } else {
        core::write_file_atomically(certificate, engine.certificate);
    }
    for (PlannedCase const& planned : plan.cases) write_named_files(planned.scenario, plan.folder);
    core::write_file_atomically(plan.folder / "campaign.toml", core::read_file(campaign_file));
}

Plan open_plan(fs::path const& folder) {
    std::error_code ignored;  // a name too long is no folder either
    if (!fs::is_regular_file(folder / "campaign.toml", ignored) ||
        !fs::is_regular_file(folder / "engine.json", ignored)) {
        throw core::InputError(
            fmt::format("{} is no campaign folder (it has no campaign.toml and engine.json); give the folder "
                        "that 'vibrotrough run' made",
                        folder.string()));
    }
    return make_plan(scenario::read_campaign(folder / "campaign.toml"), folder, read_engine(folder).version);
}

engine::Engine read_engine(fs::path const& folder) {
    try {
        auto const json = nlohmann::json::parse(core::read_file(folder / "engine.json"));
        return {json.at("program").get<std::string>(), json.at("version").get<std::string>()};
    } catch (nlohmann::json::exception const&) {
        throw core::InputError(fmt::format("{} is damaged; run the campaign again to mend it",
                                           (folder / "engine.json").string()));
    }
}

PlannedCase open_case(fs::path const& folder, std::string const& id, std::string const& engine_version) {
    bool const is_id = id.size() == 12 && id.find_first_not_of("0123456789abcdef") == std::string::npos;
    fs::path const file = folder / "cases" / id / "scenario.toml";
    if (!is_id || !fs::is_regular_file(file))
        throw core::InputError(
            fmt::format("there is no case '{}' in {}; give the folder that 'vibrotrough run' made",
                        core::printable(id, 60), folder.string()));
    Plan const plan = make_plan(scenario::read_campaign(file), folder, engine_version);
    if (plan.cases.size() == 1 && plan.cases.front().id == id) return plan.cases.front();
    throw core::InputError(
        fmt::format("{} is not the case that its folder's name says (another version of "
                    "vibrotrough?); run the campaign again",
                    file.string()));
}

}  // namespace vibrotrough::campaign
