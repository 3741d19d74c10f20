#include "app/commands.hpp"
#include "app/exit_code.hpp"
#include "campaign/friction_test.hpp"
#include "campaign/overview.hpp"
#include "compare/comparison.hpp"
#include "scenario/shake_test.hpp"

#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace vibrotrough::app {
namespace {

struct Options {
    std::string folder;
    bool json = false;
    bool csv = false;
    bool curves = false;
};

int run(Options const& options) {
    campaign::Plan const plan = campaign::open_plan(options.folder);
    auto const tests = campaign::read_friction(options.folder);
    std::vector<compare::Row> rows;
    for (campaign::CaseOverview const& one : campaign::look_at(plan)) {
        std::optional<compare::MeasuredFriction> friction;
        if (auto const test = tests.find(layer_key(one.planned->scenario)); test != tests.end())
            friction = {*test->second.friction, *test->second.low, *test->second.high};
        rows.push_back(
            compare::compare(one.planned->id, one.planned->scenario, one.record, one.outcome, friction));
    }
    if (options.json) {
        fmt::print("{}", compare::to_json(rows));
    } else if (options.curves) {
        fmt::print("{}", compare::theory_curves_csv(rows));
    } else if (options.csv) {
        fmt::print("{}", compare::to_csv(rows));
    } else {
        fmt::print("{}", compare::to_table(rows));
    }
    return all_well;
}

}  // namespace

void add_compare(CLI::App& program, int& exit_code) {
    auto const options = std::make_shared<Options>();
    CLI::App* const command = program.add_subcommand(
        "compare", "Set the measured velocity efficiency of every case beside the point-mass theory");
    command->add_option("DIR", options->folder, "The campaign's folder, as given to run --output")
        ->required();
    CLI::Option* const json = command->add_flag("--json", options->json, "Print JSON for scripts");
    CLI::Option* const csv =
        command->add_flag("--csv", options->csv, "Print CSV with the same columns")->excludes(json);
    command
        ->add_flag("--theory-curves", options->curves,
                   "Print fine theory curves through the cases as CSV, for figures")
        ->excludes(json)
        ->excludes(csv);
    command->footer(
        "eta is the mean velocity of the layer relative to the trough over omega r cos(beta), +- the "
        "half-width of its\n"
        "confidence interval over all packings. After 'vibrotrough friction-test' the theory stands there "
        "twice: at "
        "the grain's\nfriction and at the layer's. Example: vibrotrough compare runs/demo --csv > demo.csv");
    command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace vibrotrough::app
