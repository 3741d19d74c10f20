#include "theory/batch.hpp"

#include "app/commands.hpp"
#include "app/commands/theory/options.hpp"
#include "app/exit_code.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "store/theory_map.hpp"

#include <filesystem>
#include <fstream>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace vibrotrough::app {
namespace {

struct Options {
    std::string input;
    Text output, jobs;
};

/// A table of numbers: the columns in the order of the file.
struct Table {
    std::vector<theory::Input> columns;
    std::vector<std::vector<std::string>> rows;  ///< as written, so that the output repeats them
};

std::string trimmed(std::string const& text) {
    auto const first = text.find_first_not_of(" \t\r");
    return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string> split(std::string const& line) {
    std::vector<std::string> cells;
    std::size_t begin = 0;
    for (std::size_t comma = line.find(','); comma != std::string::npos; comma = line.find(',', begin)) {
        cells.push_back(trimmed(line.substr(begin, comma - begin)));
        begin = comma + 1;
    }
    cells.push_back(trimmed(line.substr(begin)));
    return cells;
}

Table read_table(std::string const& path) {
    std::ifstream file(path);
    if (!file) throw core::InputError(fmt::format("{}: cannot be read; write the path of a CSV file", path));
    Table table;
    std::string line;
    for (int number = 1; std::getline(file, line); ++number) {
        if (trimmed(line).empty() || line.front() == '#') continue;
        auto cells = split(line);
        if (table.columns.empty()) {
            for (auto const& name : cells) {
                auto const input = theory::input_named(name);
                if (!input) {
                    throw core::InputError(
                        fmt::format("{}:{}: column '{}' is no input; write names such as throw_number, "
                                    "tan_vibration_angle, friction",
                                    path, number, name));
                }
                table.columns.push_back(*input);
            }
            continue;
        }
        if (cells.size() != table.columns.size()) {
            throw core::InputError(
                fmt::format("{}:{}: has {} values for {} columns; write one value per column", path, number,
                            cells.size(), table.columns.size()));
        }
        table.rows.push_back(std::move(cells));
    }
    if (table.columns.empty())
        throw core::InputError(fmt::format("{}: is empty; write a line of column names first", path));
    return table;
}

std::vector<theory::Inputs> points_of(Table const& table, std::string const& path) {
    std::vector<theory::Inputs> points;
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
        theory::Inputs inputs;
        for (std::size_t c = 0; c < table.columns.size(); ++c) {
            if (table.rows[r][c].empty()) continue;  // not given in this row
            auto const where =
                fmt::format("{}: point {}, {}", path, r + 1, theory::name_of(table.columns[c]));
            inputs.set(table.columns[c], read_number(where, table.rows[r][c], "0.5"));
        }
        if (auto const problem = inputs.incomplete()) {
            throw core::InputError(fmt::format("{}: point {}: {}; write the value", path, r + 1, *problem));
        }
        points.push_back(inputs);
    }
    return points;
}

void write_csv(std::string const& path, Table const& table, std::vector<theory::MapPoint> const& answers) {
    std::string text;
    for (auto const input : table.columns) text += std::string(theory::name_of(input)) + ",";
    text += "velocity_efficiency,half_width,mode,period_cycles,converged\n";
    for (std::size_t r = 0; r < answers.size(); ++r) {
        theory::MapPoint const& a = answers[r];
        for (auto const& cell : table.rows[r]) text += cell + ",";
        text +=
            fmt::format("{},{},{},{},{}\n", a.velocity_efficiency, a.half_width, theory::to_string(a.mode),
                        a.period_cycles, a.outcome == theory::Outcome::periodic);
    }
    core::write_file_atomically(path, text);
}

void write_hdf5(std::string const& path, Table const& table, std::vector<theory::Inputs> const& points,
                std::vector<theory::MapPoint> const& answers) {
    std::vector<store::TheoryColumn> columns;
    for (auto const input : table.columns) {
        store::TheoryColumn column{
            std::string(theory::name_of(input)), store::units_of(input), "Input", {}, {}};
        for (auto const& point : points) column.numbers.push_back(point.get(input).value_or(std::nan("")));
        columns.push_back(std::move(column));
    }
    store::TheoryColumn eta{
        "velocity_efficiency", "1", "Velocity efficiency eta; infinite where the mass runs away", {}, {}};
    store::TheoryColumn half{
        "half_width", "1", "Half-width of eta at 95 % confidence; 0 when periodic", {}, {}};
    store::TheoryColumn mode{"mode", "1", "Phases of the motion in order", {}, {}};
    store::TheoryColumn period{
        "period_cycles", "1", "Cycles after which the motion repeats; 0 when it does not", {}, {}};
    store::TheoryColumn converged{"converged", "1", "1 when the periodic motion was found, else 0", {}, {}};
    for (theory::MapPoint const& a : answers) {
        eta.numbers.push_back(a.velocity_efficiency);
        half.numbers.push_back(a.half_width);
        mode.texts.push_back(theory::to_string(a.mode));
        period.numbers.push_back(a.period_cycles);
        converged.numbers.push_back(a.outcome == theory::Outcome::periodic ? 1 : 0);
    }
    for (auto* column : {&eta, &half, &mode, &period, &converged}) columns.push_back(std::move(*column));
    store::write_theory_table(path, columns);
}

void run(Options const& options) {
    std::string const& output = required("--output", options.output, "answers.csv");
    auto const extension = std::filesystem::path(output).extension();
    if (extension != ".csv" && extension != ".h5") {
        throw core::InputError(fmt::format(
            "--output {}: must end in .csv or .h5; write for example --output answers.csv", output));
    }
    int const jobs = options.jobs ? read_count("--jobs", *options.jobs, "2", 1, 4096) : 0;
    Table const table = read_table(options.input);
    auto const points = points_of(table, options.input);
    theory::BatchResult answer;
    try {
        answer = theory::solve_batch(points, jobs);
    } catch (std::invalid_argument const& error) {
        throw core::InputError(fmt::format("{}: {}; write a value within", options.input, error.what()));
    }
    if (extension == ".csv") {
        write_csv(output, table, answer.points);
    } else {
        write_hdf5(output, table, points, answer.points);
    }
    fmt::print("{} points, {:.3f} microseconds of CPU per solution, written to {}\n", points.size(),
               1e6 * answer.cpu_seconds_per_solution, output);
}

}  // namespace

void add_theory_batch(CLI::App& theory, int& exit_code) {
    CLI::App* const command = theory.add_subcommand(
        "batch",
        "Solve many points at once: a CSV with one line of column names (throw_number, tan_vibration_angle "
        "or\n"
        "vibration_angle_deg, tan_inclination or inclination_deg, friction, restitution, ...) and one point "
        "per line.\n"
        "The output repeats them and adds velocity_efficiency, half_width, mode, period_cycles, converged.\n"
        "Example: vibrotrough theory batch points.csv --output answers.csv");
    auto const options = std::make_shared<Options>();
    command->add_option("input", options->input, "CSV file to read")->required();
    command->add_option("--output", options->output, "File to write, .csv or .h5");
    command->add_option("--jobs", options->jobs, "Threads; all cores when not given");
    command->callback([options, &exit_code] {
        run(*options);
        exit_code = all_well;
    });
}

}  // namespace vibrotrough::app
