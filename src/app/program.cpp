#include "app/program.hpp"

#include "app/build_data.hpp"
#include "app/commands.hpp"
#include "app/exit_code.hpp"
#include "app/help_formatter.hpp"
#include "app/process.hpp"
#include "app/standard_streams.hpp"
#include "app/with_vtk.hpp"
#include "core/error.hpp"
#include "core/limits.hpp"
#include "core/version.hpp"
#include "engine/engine.hpp"
#include "view/vtk.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <exception>
#include <new>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include <CLI/CLI.hpp>
#include <boost/system/system_error.hpp>
#include <fmt/format.h>

namespace vibrotrough::app {
namespace {

/// The beginning of 'vibrotrough --help': what people come for, with an example each.
constexpr char const* tasks =
    R"(Measures with LIGGGHTS simulations (DEM) how fast a vibrating trough conveys a granular layer, and compares it with
the point-mass theory of vibratory conveying

What do you want to do?

  learn it by an example, from a question to a figure, or to a design that is signed:
      vibrotrough tutorial depth
      vibrotrough tutorial design
  size a trough for a mass flow, and know how sure that is:
      vibrotrough design --mass-flow "12 t/h" --bulk-density "600 kg/m3" --width "300 mm" \
          --friction 0.3 --friction-uncertainty 0.03
  know the speed of a machine, with its material:
      vibrotrough predict --rpm 960 --stroke "8 mm" --vibration-angle "30 deg" --friction 0.3
  know the friction of a material, from a shake test:
      vibrotrough theory friction --machine-number 1.5 --max-relative-displacement 1.9
  know the friction of a material, from speeds that were measured:
      vibrotrough theory calibrate speeds.csv --free friction
  know what my layer does, by simulation:
      vibrotrough init pellets       # writes pellets.toml, a campaign file to change
      vibrotrough check pellets.toml
      vibrotrough run pellets.toml --jobs 2
      vibrotrough report runs/pellets
  see how far a campaign is:
      vibrotrough status runs/pellets
  compare layer and theory:
      vibrotrough compare runs/pellets --sort difference:desc
  measure something of my own, with a function in Python:
      vibrotrough observe --examples > my_observables.py
      vibrotrough observe runs/pellets my_observables.py --allow-python my_observables.py
  give a campaign to the readers of a paper:
      vibrotrough archive runs/pellets
  know how large the numerical error is:
      vibrotrough convergence runs/pellets
  see the grains in ParaView:
      vibrotrough export runs/pellets)";

/// The LIGGGHTS on the PATH.
std::string engine_line() {
    try {
        engine::Engine const engine = engine::find_engine({});
        return fmt::format("{}, {}", engine.program.string(), engine.version);
    } catch (core::Error const& error) {
        return fmt::format("none ({})", error.what());
    }
}

/// What --version prints: program, commit, compiler, libraries and engine, a line each. The first line is
/// "vibrotrough VERSION (COMMIT)".
std::string version_text() {
    return fmt::format("vibrotrough {} ({})\ncompiler   {}\nlibraries  {}, {}\nengine     {}",
                       core::program_version(), core::program_commit(), build_compiler, build_libraries,
                       view::vtk_name(), engine_line());
}

void add_commands(CLI::App& program, int& exit_code) {
    add_tutorial(program, exit_code);
    add_init(program, exit_code);
    add_run(program, exit_code);
    add_plan(program, exit_code);
    add_prepare(program, exit_code);
    add_work(program, exit_code);
    add_keys(program, exit_code);
    add_quantities(program, exit_code);
    add_deck(program, exit_code);
    add_measure(program, exit_code);
    add_status(program, exit_code);
    add_friction_test(program, exit_code);
    add_convergence(program, exit_code);
    add_capacity(program, exit_code);
    add_compare(program, exit_code);
    add_observe(program, exit_code);
    add_archive(program, exit_code);
    add_learn(program, exit_code);
    add_predict(program, exit_code);
    add_calibrate(program, exit_code);
    add_design(program, exit_code);
    add_export(program, exit_code);
    add_plot(program, exit_code);
    add_report(program, exit_code);
    add_page(program, exit_code);
    add_check(program, exit_code);
    add_validate(program, exit_code);
    add_cite(program, exit_code);
    add_manual(program, exit_code);
    add_completion(program, exit_code);
    CLI::App* const theory =
        program.add_subcommand("theory", "Solve the point-mass theory of vibratory conveying");
    theory->require_subcommand(1);
    theory->footer(
        R"(These commands need microseconds to seconds and no simulation. 'vibrotrough theory COMMAND --help'
explains a command. Example:
  vibrotrough theory point --throw-number 2 --vibration-angle "30 deg" --friction 0.23)");
    add_theory_point(*theory, exit_code);
    add_theory_map(*theory, exit_code);
    add_theory_trace(*theory, exit_code);
    add_theory_limits(*theory, exit_code);
    add_theory_friction(*theory, exit_code);
    add_theory_batch(*theory, exit_code);
    add_theory_calibrate(*theory, exit_code);
}

/// One line for an error of the command line: CLI11 itself prints two, and does not name a misspelt command.
std::string describe(CLI::ParseError const& error, CLI::App const& program, int argc, char** argv) {
    CLI::App const* command = &program;
    std::string path = "vibrotrough", problem = error.what();
    for (int i = 1; i < argc && argv[i][0] != '-'; ++i) {
        auto const commands = command->get_subcommands([](CLI::App const*) { return true; });
        if (commands.empty()) break;
        std::string const word = argv[i];
        auto const named =
            std::ranges::find(commands, word, [](CLI::App const* one) { return one->get_name(); });
        if (named == commands.end()) {
            problem = fmt::format("there is no command '{}'", word);
            break;
        }
        command = *named;
        path += " " + word;
    }
    return fmt::format("{}; see '{} --help'", problem, path);
}

int run(int argc, char** argv) {
    CLI::App program{tasks};
    program.name("vibrotrough");
    program.formatter(std::make_shared<HelpFormatter>());
    program.footer("'vibrotrough COMMAND --help' explains a command and gives an example.\n\n" +
                   std::string(exit_codes_help));
    program.set_version_flag("--version", version_text,
                             "Print version, commit, libraries and engine, and exit");
    program.require_subcommand(1);
    int exit_code = all_well;
    add_commands(program, exit_code);
    try {
        program.parse(argc, argv);
    } catch (CLI::Success const& help_or_version) {
        program.exit(help_or_version);
    } catch (CLI::ParseError const& error) {
        throw core::InputError(describe(error, program, argc, argv));
    } catch (std::invalid_argument const& error) {
        // The theory, which knows no options, refuses inputs that it does not cover.
        if (!program.got_subcommand("theory")) throw;
        throw core::InputError(fmt::format("{}; write other values", error.what()));
    }
    return exit_code;
}

/// When the disk is full, a table that could not be written must not end in exit code 0.
void flush_output() {
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
    throw core::MissingError(fmt::format(
        "cannot write the output ({}); free disk space or choose another place", core::reason_of(errno)));
}

/// What the operating system refused. @return the exit code
int tell_of_system(std::exception const& error) {
    tell("vibrotrough: {}; check the disk and its permissions, and the limits (ulimit -a)\n", error.what());
    return something_missing;
}

}  // namespace

int run_program(std::string_view program_with_vtk, int argc, char** argv) {
    try {
        continue_with_vtk(program_with_vtk, argc, argv);
        prepare_process();
        int const exit_code = run(argc, argv);
        flush_output();
        return exit_code;
    } catch (core::Error const& error) {
        for (std::string const& problem : error.problems()) tell("vibrotrough: {}\n", problem);
        return error.kind() == core::ErrorKind::input ? wrong_input : something_missing;
    } catch (std::system_error const& error) {
        return tell_of_system(error);
    } catch (boost::system::system_error const& error) {
        return tell_of_system(error);
    } catch (std::bad_alloc const&) {
        tell("vibrotrough: there is not enough memory; use a smaller campaign or another machine\n");
        return something_missing;
    } catch (std::length_error const&) {
        tell("vibrotrough: a file or a table is too large for the memory; remove or shorten it\n");
        return something_missing;
    } catch (std::exception const& error) {
        tell("vibrotrough: internal error: {}\n", error.what());
        return internal_error;
    }
}

}  // namespace vibrotrough::app
