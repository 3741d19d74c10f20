#include "app/extra_lines.hpp"

#include "app/standard_streams.hpp"
#include "campaign/state/foreign_commands.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_templates = 30;

std::shared_ptr<scenario::DeckTemplates const> read_templates(fs::path const& folder) {
    scenario::DeckTemplates templates;
    std::error_code failure;
    for (fs::directory_entry const& entry : fs::directory_iterator(folder, failure)) {
        std::string const name = entry.path().filename().string();
        if (!scenario::is_template_name(name)) continue;
        templates.files.push_back({name, core::read_file(entry.path(), core::largest_note)});
    }
    if (templates.files.empty() || templates.files.size() > most_templates)
        throw core::InputError(
            fmt::format("--templates: {} holds {} templates; give a folder with 1 to {} files such as "
                        "contact.mustache (see input_templates)",
                        folder.string(), templates.files.size(), most_templates));
    std::ranges::sort(templates.files, {}, &scenario::NamedFile::name);
    return std::make_shared<scenario::DeckTemplates const>(std::move(templates));
}

}  // namespace

void add_templates(CLI::App& command, std::string& folder) {
    command
        .add_option(
            "--templates", folder,
            "Folder with templates of the decks (*.mustache) in place of the program's own that have their "
            "names. The cases are marked as not covered by the engine's certificate")
        ->type_name("DIR");
}

void use_templates(std::string const& folder, std::vector<scenario::Scenario>& cases) {
    if (folder.empty()) return;
    auto const templates = read_templates(folder);
    for (scenario::Scenario& one : cases) {
        if (one.engine.templates)
            throw core::InputError(
                "--templates: the campaign file names templates itself; remove one of the two");
        one.engine.templates = templates;
    }
}

void add_allow_extra(CLI::App& command, bool& allowed) {
    command.add_flag(
        "--allow-extra", allowed,
        "Let the decks be made from engine.templates, whose commands of LIGGGHTS can start any program");
}

void check_extra_lines(std::string const& file, std::vector<scenario::Scenario> const& cases, bool allowed) {
    for (scenario::Scenario const& one : cases) campaign::check_foreign_commands(file, one, {allowed});
}

void tell_not_covered(std::vector<scenario::Scenario> const& cases) {
    std::set<std::string> parts;
    for (scenario::Scenario const& one : cases) parts.insert(not_covered(one.engine));
    parts.erase("");
    if (!parts.empty()) tell("not covered by the engine's certificate: {}\n", fmt::join(parts, "; "));
}

}  // namespace vibrotrough::app
