#pragma once

namespace CLI {
class App;
}

namespace vibrotrough::app {

/// Explains modes in the help of every command that prints them.
constexpr char const* mode_letters =
    "A mode lists the phases of one period in order: F flight, P slide forwards relative to the trough, N "
    "slide\n"
    "backwards, R rest; P' and N' are slides that directly follow a landing.\n";

// Each function adds one subcommand to the program: its options, its help, and what it runs, in a file
// of the same name. What a subcommand runs stores its exit code; errors are thrown and worded by main.
void add_run(CLI::App& program, int& exit_code);
void add_plan(CLI::App& program, int& exit_code);
void add_work(CLI::App& program, int& exit_code);
void add_keys(CLI::App& program, int& exit_code);
void add_deck(CLI::App& program, int& exit_code);
void add_status(CLI::App& program, int& exit_code);
void add_compare(CLI::App& program, int& exit_code);
void add_friction_test(CLI::App& program, int& exit_code);
void add_export(CLI::App& program, int& exit_code);
void add_plot(CLI::App& program, int& exit_code);
void add_report(CLI::App& program, int& exit_code);  // in plot.cpp: the report is drawn with the figures
void add_probe_engine(CLI::App& program, int& exit_code);
void add_validate(CLI::App& program, int& exit_code);
void add_check(CLI::App& program, int& exit_code);
void add_theory_point(CLI::App& theory, int& exit_code);
void add_theory_map(CLI::App& theory, int& exit_code);
void add_theory_trace(CLI::App& theory, int& exit_code);
void add_theory_limits(CLI::App& theory, int& exit_code);
void add_theory_friction(CLI::App& theory, int& exit_code);
void add_theory_sensitivity(CLI::App& theory, int& exit_code);
void add_theory_design(CLI::App& theory, int& exit_code);
void add_theory_batch(CLI::App& theory, int& exit_code);

}  // namespace vibrotrough::app
