#pragma once

namespace CLI {
class App;
}

namespace vibrotrough::app {

/// Explains modes in the help of every command that prints them.
constexpr char const* mode_letters =
    "Modes list the phases of one period in order: P slides forwards, N slides backwards, R rests on the "
    "trough, "
    "F flies; P' and N' are slides that start with a landing.";

/// @name Commands
/// Each function adds one command to the program: its options, its help and what it runs. It is defined in a
/// file of the same name in commands/. A command stores its exit code in `exit_code`. It throws errors, and
/// main() prints them.
/// @{

/// Writes a campaign file to begin with.
void add_init(CLI::App& program, int& exit_code);
/// Prints or writes a walk through the program.
void add_tutorial(CLI::App& program, int& exit_code);
/// Simulates the cases of a campaign.
void add_run(CLI::App& program, int& exit_code);
/// Lists the cases of a campaign and what they will cost.
void add_plan(CLI::App& program, int& exit_code);
/// Writes a list of tasks for a scheduler.
void add_prepare(CLI::App& program, int& exit_code);
/// Simulates the packings of one task, for a scheduler.
void add_work(CLI::App& program, int& exit_code);
/// Prints the reference of the campaign file.
void add_keys(CLI::App& program, int& exit_code);
/// Prints the reference of everything in the results.
void add_quantities(CLI::App& program, int& exit_code);
/// Writes LIGGGHTS decks without running them.
void add_deck(CLI::App& program, int& exit_code);
/// Measures a run that was made by hand.
void add_measure(CLI::App& program, int& exit_code);
/// Shows how far a campaign is.
void add_status(CLI::App& program, int& exit_code);
/// Measures a person's own quantities.
void add_observe(CLI::App& program, int& exit_code);
/// Prints the table of measured and theoretical conveying.
void add_compare(CLI::App& program, int& exit_code);
/// Makes one file of a campaign, for a paper's supplement.
void add_archive(CLI::App& program, int& exit_code);
/// Measures the friction of layers as a whole.
void add_friction_test(CLI::App& program, int& exit_code);
/// Finds the largest feed of an open trough.
void add_capacity(CLI::App& program, int& exit_code);
/// Measures the numerical error of a campaign's results.
void add_convergence(CLI::App& program, int& exit_code);
/// Learns the velocity efficiency over a domain.
void add_learn(CLI::App& program, int& exit_code);
/// Finds inputs of a simulated layer from measured speeds.
void add_calibrate(CLI::App& program, int& exit_code);
/// Finds a machine for a mass flow, and how sure it is.
void add_design(CLI::App& program, int& exit_code);
/// Predicts the velocity efficiency between the cases of a campaign.
void add_predict(CLI::App& program, int& exit_code);
/// Writes files for ParaView.
void add_export(CLI::App& program, int& exit_code);
/// Draws figures.
void add_plot(CLI::App& program, int& exit_code);
/// Writes the page for browsers.
void add_page(CLI::App& program, int& exit_code);
/// Writes the HTML report; defined in plot.cpp, because it draws the same figures.
void add_report(CLI::App& program, int& exit_code);
/// Tests a LIGGGHTS binary.
/// Runs the validation cases.
void add_validate(CLI::App& program, int& exit_code);
/// Checks a campaign before it is simulated.
void add_check(CLI::App& program, int& exit_code);
/// Prints what to cite.
void add_cite(CLI::App& program, int& exit_code);
/// Prints the manual page.
void add_manual(CLI::App& program, int& exit_code);
/// Prints the completion script of a shell; defined in pages.cpp, beside the manual page.
void add_completion(CLI::App& program, int& exit_code);
/// Solves one motion.
void add_theory_point(CLI::App& theory, int& exit_code);
/// Solves a grid over two inputs.
void add_theory_map(CLI::App& theory, int& exit_code);
/// Prints the motion over one period.
void add_theory_trace(CLI::App& theory, int& exit_code);
/// Prints closed-form results.
void add_theory_limits(CLI::App& theory, int& exit_code);
/// Evaluates a horizontal shake test.
void add_theory_friction(CLI::App& theory, int& exit_code);
/// Solves the motions of a CSV file.
void add_theory_batch(CLI::App& theory, int& exit_code);
/// Finds friction and other quantities from measured speeds.
void add_theory_calibrate(CLI::App& theory, int& exit_code);

/// @}

}  // namespace vibrotrough::app
