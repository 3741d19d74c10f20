#include "app/campaign_templates.hpp"
#include "app/commands.hpp"
#include "app/commands/common_options.hpp"
#include "app/exit_code.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/shell.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
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

constexpr std::string_view campaign_ending = ".toml";

/// The names of the campaign files without their ending. What else is there belongs to the campaign with the
/// same name, such as the mesh of a trough.
std::vector<std::string> kinds() {
    std::vector<std::string> names;
    for (auto const& [name, text] : campaign_templates) {
        if (name.ends_with(campaign_ending))
            names.emplace_back(name.substr(0, name.size() - campaign_ending.size()));
    }
    return names;
}

int run_init(InitArguments const& options) {
    std::map<fs::path, std::string_view> files;
    fs::path const path =
        options.output.empty() ? fs::path(options.kind + ".toml") : fs::path(options.output);
    for (auto const& [name, text] : campaign_templates) {
        if (!name.starts_with(options.kind + ".")) continue;
        files.emplace(name.ends_with(campaign_ending) ? path : path.parent_path() / name, text);
    }
    for (auto const& [file, text] : files) {
        std::error_code unreadable;
        if (!fs::exists(file, unreadable)) continue;
        bool const is_same = file != path && fs::is_regular_file(file, unreadable) &&
                             core::read_file(file, core::largest_note) == text;
        if (is_same) continue;
        throw core::InputError(fmt::format(
            "{} exists already and is not overwritten; choose another name or folder with --output",
            file.string()));
    }
    for (auto const& [file, text] : files) {
        core::write_file_atomically(file, text);
        fmt::print("written: {}\n", file.string());
    }
    std::string const name = core::shell_word(path);
    fmt::print("next: change its numbers, then: vibrotrough check {}\n", name);
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

  pellets     how fast a trough conveys plastic pellets at three speeds of the drive, in t/h
  paper       the experiment of Sloot and Kruyt (1996): layer and theory over the throw number
  rotation    the same layer with grains that rotate freely, against rolling friction, or not at all
  chute       a trough of your own from an STL file: a V with a step
  open        a trough with feed and discharge: flows, depth, how long grains stay
  mixture     two materials of different size and density: do they separate?
  screen      a vibrating screen: which sizes pass, how fast, and which stay?
  fed-screen  a screen with feed and discharge: what passes, what leaves over its end?
  stages      a trough that starts and stops twice: how fast is the layer, and where does it stop?
  design      three machines with the same largest acceleration: which one carries most?

An existing file is never overwritten.

Example:
  vibrotrough init pellets --output my_trough.toml)");
    command->callback([options, &exit_code] { exit_code = run_init(*options); });
}

}  // namespace vibrotrough::app
