#include "app/campaign_templates.hpp"
#include "app/commands/command.hpp"
#include "app/tutorial_files.hpp"

namespace vibrotrough::app {
namespace {

struct InitArguments {
    std::string kind = "pellets";
    std::string output;
};

struct TutorialArguments {
    std::string walk = "depth";
    std::string output;
};

constexpr std::string_view campaign_ending = ".toml", page_ending = ".md";

/// The names of the files with an ending, without it. What else is there belongs to the file with the same
/// name, such as the mesh of a trough.
template <typename Files>
std::vector<std::string> names_of(Files const& files, std::string_view ending) {
    std::vector<std::string> names;
    for (auto const& [name, text] : files)
        if (name.ends_with(ending)) names.emplace_back(name.substr(0, name.size() - ending.size()));
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

void add_init(CLI::App& program, int& exit_code) {
    auto const options = std::make_shared<InitArguments>();
    CLI::App* const command = program.add_subcommand("init", "Write a commented campaign file to begin with");
    command->add_option("KIND", options->kind, "What the campaign is about; see below")
        ->check(CLI::IsMember(names_of(campaign_templates, campaign_ending)))
        ->capture_default_str();
    add_text(*command, "--output", options->output, "File to write; default: KIND.toml", "FILE");
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

void add_tutorial(CLI::App& program, int& exit_code) {
    CLI::App* const command =
        program.add_subcommand("tutorial", "Print or write a walk through the program, with every command");
    auto const options = std::make_shared<TutorialArguments>();
    command->add_option("WALK", options->walk, "Which one; see below")
        ->check(CLI::IsMember(names_of(tutorial_files, page_ending)))
        ->capture_default_str();
    add_text(*command, "--output", options->output,
             "Write the page and the files that it uses into this folder", "DIR");
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
