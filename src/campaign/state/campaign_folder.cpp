#include "campaign/state/campaign_folder.hpp"

#include "campaign/state/notes.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/parallel.hpp"
#include "scenario/reader/written_campaign.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace vibrotrough::campaign {
namespace {

namespace fs = std::filesystem;

/// What is frozen in a folder: names of files and their contents.
using FrozenFiles = std::map<std::string, std::string>;

/// engine.json of a campaign's folder. @throws core::InputError when it is damaged
EngineNote read_facts(fs::path const& folder) {
    fs::path const path = folder / "engine.json";
    try {
        return parse_engine(core::read_file(path, core::largest_note));
    } catch (core::note::Fault const& fault) {
        throw core::InputError(
            fmt::format("{} is damaged; run the campaign again after removing this file ({})", path.string(),
                        fault.what()));
    }
}

/// Refuses a folder that holds somebody else's files under the names of those that a run writes.
/// (friction.json and numerics.json may be there before the campaign: friction-test and convergence write
/// them.)
void refuse_foreign_folder(fs::path const& folder, FrozenFiles const& files) {
    if (fs::exists(folder / "engine.json")) {
        read_facts(folder);
        return;
    }
    auto const refuse = [&](fs::path const& path) {
        throw core::InputError(
            fmt::format("{} is there already, but {} is not the folder of a campaign; move it away, or "
                        "choose another folder with --output",
                        path.string(), folder.string()));
    };
    for (auto const& [name, content] : files) {
        if (fs::exists(folder / name) && core::read_file(folder / name) != content) refuse(folder / name);
    }
    if (fs::exists(folder / "campaign.toml")) return;
    for (char const* name : {"campaign.h5", "certificate.json", "cases", "packings"}) {
        if (fs::exists(folder / name) && !fs::is_empty(folder / name)) refuse(folder / name);
    }
}

/// Writes engine.json and the files whose contents have changed.
void write_frozen(fs::path const& folder, EngineNote const& facts, FrozenFiles const& files) {
    core::write_file_atomically(folder / "engine.json", to_json(facts));
    for (auto const& [name, content] : files) {
        if (!fs::exists(folder / name) || core::read_file(folder / name) != content)
            core::write_file_atomically(folder / name, content);
    }
}

/// The names of the templates with which the decks of a plan are made; empty: the program's own.
std::vector<std::string> template_names(Plan const& plan) {
    std::vector<std::string> names;
    if (plan.cases.empty() || !plan.cases.front().scenario().engine.templates) return names;
    for (scenario::NamedFile const& file : plan.cases.front().scenario().engine.templates->files)
        names.push_back(file.name);
    return names;
}

/// Takes the templates that are frozen in a folder for all cases, if 'run --templates' made it.
void use_frozen_templates(fs::path const& folder, EngineNote const& facts,
                          std::vector<scenario::Scenario>& cases) {
    if (facts.templates.empty()) return;
    scenario::DeckTemplates templates;
    for (std::string const& name : facts.templates)
        templates.files.push_back({name, core::read_file(folder / name, core::largest_note)});
    auto const shared = std::make_shared<scenario::DeckTemplates const>(std::move(templates));
    for (scenario::Scenario& one : cases) one.engine.templates = shared;
}

/// An edited campaign may continue in its folder; a different one would hide the cases of the first.
void refuse_other_campaign(Plan const& plan) {
    fs::path const frozen = plan.folder / "campaign.toml";
    if (!fs::exists(plan.folder / "engine.json") || !fs::exists(frozen)) return;
    std::string name;
    try {
        name = scenario::read_campaign(frozen).name;
    } catch (core::InputError const&) {
        return;  // of an older program, or damaged
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
        if (!fs::exists(folder / file.name, missing) ||
            core::read_file(folder / file.name, core::largest_note) != file.content)
            core::write_file_atomically(folder / file.name, file.content);
    }
}

void write_scenario(scenario::Scenario const& scenario, fs::path const& folder) {
    core::make_folder(folder);
    write_named_files(scenario, folder);
    core::replace_file(folder / "scenario.toml", to_toml(scenario));
}

void write_case_files(std::vector<PlannedCase const*> cases) {
    std::ranges::sort(cases);
    cases.erase(std::unique(cases.begin(), cases.end()), cases.end());
    core::for_each_index(cases.size(), cases_per_thread, [&] {
        return [&](std::size_t i) { write_scenario(cases[i]->scenario(), cases[i]->folder); };
    });
}

void freeze(Plan const& plan, fs::path const& campaign_file, engine::Engine const& engine) {
    FrozenFiles files{{"campaign.toml", core::read_file(campaign_file, core::largest_note)}};
    for (fs::path const& file : plan.files)
        files[file.filename().string()] = core::read_file(file, core::largest_note);
    for (PlannedCase const& planned : plan.cases) {
        for (scenario::NamedFile const& file : named_files(planned.scenario()))
            files[file.name] = file.content;
    }
    refuse_other_campaign(plan);
    refuse_foreign_folder(plan.folder, files);
    write_frozen(plan.folder,
                 {engine.program.string(), engine.version, engine.binary_sha256, template_names(plan)},
                 files);
    fs::path const certificate = plan.folder / "certificate.json";
    if (engine.certificate.empty()) {
        fs::remove(certificate);  // it belongs to another engine
    } else {
        core::write_file_atomically(certificate, engine.certificate);
    }
    core::make_folder(plan.folder / "cases");
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
    scenario::Campaign campaign = scenario::read_campaign(folder / "campaign.toml");
    EngineNote const facts = read_facts(folder);
    use_frozen_templates(folder, facts, campaign.cases);
    return campaign;
}

Plan open_plan(fs::path const& folder) {
    scenario::Campaign const campaign = read_frozen_campaign(folder);
    return make_plan(campaign, folder, read_engine(folder).version);
}

engine::Engine read_engine(fs::path const& folder) {
    EngineNote const facts = read_facts(folder);
    engine::Engine engine{facts.program, facts.version};
    engine.binary_sha256 = facts.binary_sha256;
    return engine;
}

bool is_case_id(std::string_view text) {
    return text.size() == 12 && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

PlannedCase open_case(fs::path const& folder, std::string const& id, std::string const& engine_version) {
    fs::path const file = folder / "cases" / id / "scenario.toml";
    if (!is_case_id(id) || !fs::is_regular_file(file))
        throw core::InputError(fmt::format(
            "there is no case '{}' in {}; give the folder that 'vibrotrough run' made", id, folder.string()));
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
