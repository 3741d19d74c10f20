#include "theory/batch.hpp"

#include "app/commands/command.hpp"
#include "app/commands/theory/options.hpp"
#include "app/outputs.hpp"
#include "store/theory_table.hpp"

namespace vibrotrough::app {
namespace {

struct TheoryBatchArguments {
    std::string input;
    RollingOption rolling;
    QuantityOptions counts;
    Text output;
    Outputs outputs;
};

/// By which an earlier answer is recognised.
char const* mark_of(std::filesystem::path const& extension) {
    return extension == ".csv" ? "velocity_efficiency,half_width,mode,period_cycles,converged"
                               : "vibrotrough theory table";
}

void run_theory_batch(TheoryBatchArguments options) {
    std::string const output = required("--output", options.output, "answers.csv");
    auto const extension = std::filesystem::path(output).extension();
    if (extension != ".csv" && extension != ".h5") {
        throw core::InputError(fmt::format(
            "--output {}: must end in .csv or .h5; write for example --output answers.csv", output));
    }
    options.outputs.inputs.emplace_back(options.input);
    options.outputs.check("--output", output, mark_of(extension));
    int const jobs = static_cast<int>(options.counts.value("--jobs").value_or(0));
    store::TheoryPoints const table = store::read_theory_points(options.input);
    auto const law = options.rolling.law();
    int const starts = count_starts(options.counts, law.has_value());
    theory::BatchResult answer;
    try {
        answer = theory::solve_batch(table.points, jobs, law, 1, starts);
    } catch (std::invalid_argument const& error) {
        throw core::InputError(fmt::format("{}: {}; write a value within", options.input, error.what()));
    }
    if (law && !options.rolling.accepts_untested())
        tell_withheld(theory::withhold_untested(table.points, answer.points), table.points.size());
    if (extension == ".csv") {
        core::write_file_atomically(output, store::theory_answers_csv(table, answer.points, answer.motions));
    } else {
        store::write_theory_answers(output, table, answer.points, answer.motions);
    }
    std::size_t const count = table.points.size();
    fmt::print("{} point{}, {:.1f} microseconds of CPU per solution, written to {}\n", count,
               count == 1 ? "" : "s", 1e6 * answer.cpu_seconds_per_solution, output);
}

}  // namespace

void add_theory_batch(CLI::App& theory, int& exit_code) {
    CLI::App* const command = theory.add_subcommand("batch", "Solve many motions from a CSV file");
    auto const options = std::make_shared<TheoryBatchArguments>();
    command->add_option("input", options->input, "CSV file to read")->required();
    command->add_option("--output", options->output, "File to write, .csv or .h5");
    options->outputs.add_to(*command);
    options->rolling.add_to(*command);
    options->counts.add_to(*command, {{"--jobs"}, {"--starts"}});
    command->footer(
        std::string(
            R"(The first line of the CSV file names the inputs: throw_number, machine_number, frequency_hz or rpm;
amplitude_m, amplitude_mm or stroke_mm, which a frequency needs; tan_vibration_angle or vibration_angle_deg;
tan_inclination or inclination_deg; friction; restitution; and so on ('vibrotrough theory map --help' lists all names).
Each further line is one motion. An empty cell means that this motion does not have that input.

The output repeats the inputs and adds the columns velocity_efficiency, half_width (of its 95 % confidence interval when
the motion has no period, else 0), mode, period_cycles, converged and, when a motion has an amplitude,
conveying_speed_m_per_s. With --starts it also has the number of motions to which they lead, and for each of them
efficiency_1, fraction_1 (of the starts) and period_cycles_1, efficiency_2 and so on; number 1 is the motion of the
standard start.

)") + mode_letters +
        R"(

Write --rolling-layer behind the file, or the file's name is taken for its value. Where that law has not been tested
the efficiency is nan, unless --accept-untested is given.

Example:
  vibrotrough theory batch points.csv --output answers.csv

The same points as layers of grains that roll:
  vibrotrough theory batch points.csv --output answers.csv --rolling-layer)");
    command->callback([options, &exit_code] {
        run_theory_batch(*options);
        exit_code = all_well;
    });
}

}  // namespace vibrotrough::app
