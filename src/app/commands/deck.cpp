#include "deck/deck.hpp"

#include "app/commands.hpp"
#include "app/commands/common_options.hpp"
#include "app/exit_code.hpp"
#include "campaign/state/campaign_folder.hpp"
#include "core/shell.hpp"
#include "scenario/reader/campaign_file.hpp"

#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace vibrotrough::app {
namespace {

namespace fs = std::filesystem;

struct Options {
    std::string campaign_file;
    std::string output;
};

int run(Options const& options) {
    scenario::Campaign const campaign = scenario::read_campaign(options.campaign_file);
    int number = 0;
    prepare::CasePreparer preparer;
    for (scenario::Scenario const& scenario : campaign.cases) {
        prepare::PreparedCase const prepared = preparer.prepare(scenario);
        fs::path const folder = fs::path(options.output) / fmt::format("case-{:03}", ++number);
        for (int packing = 1; packing <= scenario.measure.packings; ++packing) {
            deck::write_deck(deck::make_deck(prepared, {packing}),
                             folder / fmt::format("packing-{}", packing));
        }
        campaign::write_scenario(scenario, folder);
        fmt::print("{}: throw number {:.4g}, machine number {:.4g}, {} grains, {} packings\n",
                   folder.string(), prepared.throw_number, prepared.machine_number, scenario.layer.grains,
                   scenario.measure.packings);
    }
    fmt::print(
        "{} cases written; run one by hand with: cd {} && liggghts -in settle.liggghts && liggghts -in "
        "in.liggghts\n",
        campaign.cases.size(), core::shell_word(fs::path(options.output) / "case-001" / "packing-1"));
    return all_well;
}

}  // namespace

void add_deck(CLI::App& program, int& exit_code) {
    auto const options = std::make_shared<Options>();
    CLI::App* const command =
        program.add_subcommand("deck", "Write the LIGGGHTS decks of a campaign without running them");
    add_campaign_file(*command, options->campaign_file);
    command
        ->add_option("--output", options->output, "Folder for the decks: case-001/packing-1/in.liggghts ...")
        ->type_name("DIR")
        ->required();
    command->footer(
        R"(Writes a folder with the complete input of LIGGGHTS for each packing of each case, and prints how to
run one by hand. There are measure.packings packings of each case; their grains start at rest, and they run for
measure.max_cycles cycles. The command does not need LIGGGHTS.

Example:
  vibrotrough deck validation/demo/campaign.toml --output decks)");
    command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace vibrotrough::app
