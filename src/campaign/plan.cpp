#include "campaign/plan.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "deck/deck.hpp"

#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::campaign {
namespace {

namespace fs = std::filesystem;

std::string case_id(Scenario scenario, std::string const& engine_version) {
    scenario.campaign = "any";
    deck::Deck const deck = deck::make_deck(scenario, 1);  // the others differ by their seeds only
    std::string all = to_toml(scenario) + engine_version;
    for (auto const& [name, content] : deck.files) all += name + content;
    return sha256_hex(all).substr(0, 12);
}

/// An edited campaign may go on in its folder; another one would hide the first one's cases.
void refuse_other_campaign(Plan const& plan) {
    fs::path const frozen = plan.folder / "campaign.toml";
    std::string name;
    try {
        if (fs::is_regular_file(frozen)) name = read_campaign(frozen).name;
    } catch (InputError const&) {
        return;  // damaged, or of an older program: frozen anew
    }
    if (name.empty() || name == plan.name) return;
    throw InputError(fmt::format("{} holds the campaign '{}', not '{}'; choose another folder with --output",
                                 plan.folder.string(), name, plan.name));
}

}  // namespace

void write_named_files(Scenario const& scenario, fs::path const& folder) {
    for (NamedFile const& file : named_files(scenario)) {
        std::error_code missing;
        if (!fs::exists(folder / file.name, missing) || read_file(folder / file.name) != file.content)
            write_file_atomically(folder / file.name, file.content);
    }
}

void write_case_files(PlannedCase const& planned) {
    make_folder(planned.folder);
    write_named_files(planned.scenario, planned.folder);
    write_file_atomically(planned.folder / "scenario.toml", to_toml(planned.scenario));
}

Plan make_plan(Campaign const& campaign, fs::path const& folder, std::string const& engine_version) {
    Plan plan{campaign.name, folder, engine_version, {}};
    std::set<std::string> ids;
    for (Scenario const& scenario : campaign.cases) {
        std::string const id = case_id(scenario, engine_version);
        if (!ids.insert(id).second) continue;  // two ways to write one case are one case
        plan.cases.push_back({id, scenario, folder / "cases" / id});
    }
    return plan;
}

void freeze(Plan const& plan, fs::path const& campaign_file, engine::Engine const& engine) {
    make_folder(plan.folder / "cases");
    refuse_other_campaign(plan);
    nlohmann::ordered_json const json{{"program", engine.program.string()}, {"version", engine.version}};
    write_file_atomically(plan.folder / "engine.json", json.dump(2) + "\n");
    fs::path const certificate = plan.folder / "certificate.json";
    if (engine.certificate.empty()) {
        fs::remove(certificate);  // another engine's
    } else {
        write_file_atomically(certificate, engine.certificate);
    }
    for (PlannedCase const& planned : plan.cases) write_named_files(planned.scenario, plan.folder);
    write_file_atomically(plan.folder / "campaign.toml", read_file(campaign_file));
}

Plan open_plan(fs::path const& folder) {
    std::error_code ignored;  // a name too long is no folder either
    if (!fs::is_regular_file(folder / "campaign.toml", ignored) ||
        !fs::is_regular_file(folder / "engine.json", ignored)) {
        throw InputError(
            fmt::format("{} is no campaign folder (it has no campaign.toml and engine.json); give the folder "
                        "that 'vibrotrough run' made",
                        folder.string()));
    }
    try {
        auto const json = nlohmann::json::parse(read_file(folder / "engine.json"));
        return make_plan(read_campaign(folder / "campaign.toml"), folder,
                         json.at("version").get<std::string>());
    } catch (nlohmann::json::exception const&) {
        throw InputError(fmt::format("{} is damaged; run the campaign again to mend it",
                                     (folder / "engine.json").string()));
    }
}

}  // namespace vibrotrough::campaign
