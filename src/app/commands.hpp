#pragma once

#include "app/exit_code.hpp"

namespace CLI {
class App;
}

namespace vibrotrough::app {

/// Explains modes in the help of every command that prints them.
constexpr char const* mode_letters =
    "Modes list the phases of one period in order: P slides forwards, N slides backwards, R rests on the "
    "trough, "
    "F flies; P' and N' are slides that start with a landing.";

// Each function adds one command to the program: its options, its help and what it runs. It is defined in
// the file of the same name in commands/; `tutorial` is in init.cpp, `report` in plot.cpp, and `manual` and
// `completion` are in pages.cpp. A command stores its exit code in `exit_code`. It throws errors, and main()
// prints them.
/// @cond its name says what each adds

void add_init(CLI::App& program, int& exit_code);
void add_tutorial(CLI::App& program, int& exit_code);
void add_run(CLI::App& program, int& exit_code);
void add_plan(CLI::App& program, int& exit_code);
void add_prepare(CLI::App& program, int& exit_code);
void add_work(CLI::App& program, int& exit_code);
void add_keys(CLI::App& program, int& exit_code);
void add_quantities(CLI::App& program, int& exit_code);
void add_deck(CLI::App& program, int& exit_code);
void add_measure(CLI::App& program, int& exit_code);
void add_status(CLI::App& program, int& exit_code);
void add_observe(CLI::App& program, int& exit_code);
void add_compare(CLI::App& program, int& exit_code);
void add_archive(CLI::App& program, int& exit_code);
void add_friction_test(CLI::App& program, int& exit_code);
void add_capacity(CLI::App& program, int& exit_code);
void add_convergence(CLI::App& program, int& exit_code);
void add_learn(CLI::App& program, int& exit_code);
void add_calibrate(CLI::App& program, int& exit_code);
void add_design(CLI::App& program, int& exit_code);
void add_predict(CLI::App& program, int& exit_code);
void add_export(CLI::App& program, int& exit_code);
void add_plot(CLI::App& program, int& exit_code);
void add_page(CLI::App& program, int& exit_code);
void add_report(CLI::App& program, int& exit_code);
void add_validate(CLI::App& program, int& exit_code);
void add_check(CLI::App& program, int& exit_code);
void add_cite(CLI::App& program, int& exit_code);
void add_manual(CLI::App& program, int& exit_code);
void add_completion(CLI::App& program, int& exit_code);
void add_theory_point(CLI::App& theory, int& exit_code);
void add_theory_map(CLI::App& theory, int& exit_code);
void add_theory_trace(CLI::App& theory, int& exit_code);
void add_theory_limits(CLI::App& theory, int& exit_code);
void add_theory_friction(CLI::App& theory, int& exit_code);
void add_theory_batch(CLI::App& theory, int& exit_code);
void add_theory_calibrate(CLI::App& theory, int& exit_code);

/// @endcond

}  // namespace vibrotrough::app
