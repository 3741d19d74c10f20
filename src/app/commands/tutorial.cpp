#include "app/commands.hpp"
#include "app/exit_code.hpp"
#include "app/tutorial_files.hpp"
#include "core/atomic_file.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace vibrotrough::app {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view page_ending = ".md";

struct TutorialArguments {
    std::string walk = "depth";
    std::string output;
};

/// The names of the pages without their ending. What else is there belongs to the page with the same name.
std::vector<std::string> walks() {
    std::vector<std::string> names;
    for (auto const& [name, text] : tutorial_files) {
        if (name.ends_with(page_ending)) names.emplace_back(name.substr(0, name.size() - page_ending.size()));
    }
    return names;
}

/// Writes a file unless there is one, which a person may have changed.
void write_new_file(fs::path const& path, std::string_view text) {
    std::error_code unreadable;
    bool const exists = fs::exists(fs::symlink_status(path, unreadable));
    if (!exists) core::write_file_atomically(path, text);
    fmt::print("{}: {}\n", exists ? "there already" : "written", path.string());
}

int run_tutorial(TutorialArguments const& options) {
    if (!options.output.empty()) core::make_folder(options.output);
    for (auto const& [name, text] : tutorial_files) {
        if (!name.starts_with(options.walk + ".")) continue;
        bool const is_page = name.ends_with(page_ending);
        if (options.output.empty()) {
            if (is_page) fmt::print("{}", text);
            continue;
        }
        write_new_file(fs::path(options.output) / name, text);
    }
    return all_well;
}

}  // namespace

void add_tutorial(CLI::App& program, int& exit_code) {
    CLI::App* const command =
        program.add_subcommand("tutorial", "Print or write a walk through the program, with every command");
    auto const options = std::make_shared<TutorialArguments>();
    command->add_option("WALK", options->walk, "Which one; see below")
        ->check(CLI::IsMember(walks()))
        ->capture_default_str();
    command
        ->add_option("--output", options->output,
                     "Write the page and the files that it uses into this folder")
        ->type_name("DIR");
    command->footer(
        R"(Each walk takes about two minutes on two cores:

  depth    for researchers: does depth matter for my pellets? From a prediction to a figure
  design   for engineers: from a mass flow to the sheet of a machine that was simulated

Without --output the page is printed. An existing file is never overwritten.

Examples:
  vibrotrough tutorial depth | less
  vibrotrough tutorial design --output walk)");
    command->callback([options, &exit_code] { exit_code = run_tutorial(*options); });
}

}  // namespace vibrotrough::app
