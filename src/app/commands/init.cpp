#include "app/campaign_templates.hpp"
#include "app/commands.hpp"
#include "app/commands/common_options.hpp"
#include "app/exit_code.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/shell.hpp"
#include "core/text.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace vibrotrough::app {
namespace {

namespace fs = std::filesystem;

struct InitArguments {
    std::string kind = "pellets";
    std::string output;
};

std::vector<std::string> kinds() {
    std::vector<std::string> names;
    for (auto const& [name, text] : campaign_templates) names.emplace_back(name);
    return names;
}

int run_init(InitArguments const& options) {
    auto const* const found = std::ranges::find(campaign_templates, std::string_view(options.kind),
                                                [](auto const& one) { return one.first; });
    fs::path const path =
        options.output.empty() ? fs::path(options.kind + ".toml") : fs::path(options.output);
    std::error_code unreadable;
    if (fs::exists(path, unreadable)) {
        throw core::InputError(fmt::format(
            "{} exists already and is not overwritten; choose another name with --output", path.string()));
    }
    core::write_file_atomically(path, found->second);
    std::string const name = core::shell_word(path);
    fmt::print("written: {}\nnext: change its numbers, then: vibrotrough check {}\n",
               core::harmless(path.string()), name);
    fmt::print("and:  vibrotrough run {}\n", name);
    return all_well;
}

}  // namespace

void add_init(CLI::App& program, int& exit_code) {
    auto const options = std::make_shared<InitArguments>();
    CLI::App* const command = program.add_subcommand("init", "Write a commented campaign file to begin with");
    command->add_option("KIND", options->kind, "What the campaign is about; see below")
        ->check(CLI::IsMember(kinds()))
        ->capture_default_str();
    command->add_option("--output", options->output, "File to write; default: KIND.toml")->type_name("FILE");
    command->footer(
        R"(The file can be run as it is, in a few minutes. Kinds:

  pellets   how fast a trough conveys plastic pellets at three speeds of the drive, in t/h
  paper     the experiment of Sloot and Kruyt (1996): layer and theory over the throw number
  rotation  the same layer with grains that rotate freely, against rolling friction, and not at all
  mixture   two materials of different size and density: do they separate?
  design    three machines with the same largest acceleration: which one carries most?

An existing file is never overwritten.

Exit codes:
    0  all well
    2  the input is wrong, for example because the file exists already
    3  something is missing, for example disk space

Example:
  vibrotrough init pellets --output my_trough.toml)");
    command->callback([options, &exit_code] { exit_code = run_init(*options); });
}

}  // namespace vibrotrough::app
