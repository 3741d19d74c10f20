#include "deck/deck.hpp"

#include "app/commands/command.hpp"
#include "app/extra_lines.hpp"
#include "campaign/schedule/policy.hpp"
#include "core/atomic_file.hpp"
#include "core/shell.hpp"
#include "scenario/reader/campaign_file.hpp"
#include "scenario/reader/written_campaign.hpp"

namespace vibrotrough::app {
namespace {

struct DeckArguments {
    std::string campaign_file;
    std::string output;
    std::string templates;
    bool allow_extra = false;
};

/// Writes the scenario of a case, the files that it names, and the decks of its packings.
void write_case(fs::path const& folder, prepare::PreparedCase const& prepared,
                std::vector<deck::PackingPlan> const& packings) {
    std::map<std::string, std::string> files{{"scenario.toml", scenario::to_toml(prepared.scenario)}};
    for (scenario::NamedFile const& file : scenario::named_files(prepared.scenario))
        files[file.name] = file.content;
    std::map<std::string, deck::Deck> decks;
    for (deck::PackingPlan const& packing : packings) {
        std::string const name = fmt::format("packing-{}", packing.number);
        decks[name] = deck::make_deck(prepared, packing);
        for (auto const& [file, content] : decks[name].files) files[name + "/" + file] = content;
    }
    deck::write_case(folder, files);
    for (auto const& [name, deck] : decks) deck::make_frame_folder(deck, folder / name);
}

int run_deck(DeckArguments const& options) {
    scenario::Campaign campaign = scenario::read_campaign(options.campaign_file);
    check_extra_lines(options.campaign_file, campaign.cases, options.allow_extra);
    use_templates(options.templates, campaign.cases);
    tell_not_covered(campaign.cases);
    core::make_folder(options.output);
    int number = 0;
    auto const policy = campaign::make_policy();
    for (scenario::Scenario const& scenario : campaign.cases) {
        campaign::PlannedCase planned;
        planned.prepared = std::make_shared<prepare::PreparedCase const>(prepare::prepare_case(scenario));
        prepare::PreparedCase const& prepared = *planned.prepared;
        fs::path const folder = fs::path(options.output) / fmt::format("case-{:03}", ++number);
        auto const first_round = policy->decide({&planned, {}, {}, {}}).wanted;
        write_case(folder, prepared, first_round);
        fmt::print("{}: throw number {:.4g}, machine number {:.4g}, {} grains, {} packings\n",
                   folder.string(), prepared.throw_number, prepared.machine_number, scenario.layer.grains,
                   first_round.size());
    }
    fmt::print(
        "{} cases written; run one by hand with: cd {} && liggghts -in settle.liggghts && liggghts -in "
        "in.liggghts\n",
        campaign.cases.size(), core::shell_word(fs::path(options.output) / "case-001" / "packing-1"));
    return all_well;
}

}  // namespace

void add_deck(CLI::App& program, int& exit_code) {
    auto const options = std::make_shared<DeckArguments>();
    CLI::App* const command =
        program.add_subcommand("deck", "Write the LIGGGHTS decks of a campaign without running them");
    add_campaign_file(*command, options->campaign_file);
    command
        ->add_option("--output", options->output, "Folder for the decks: case-001/packing-1/in.liggghts ...")
        ->type_name("DIR")
        ->required();
    add_templates(*command, options->templates);
    add_allow_extra(*command, options->allow_extra);
    command->footer(
        R"(Writes a folder with the complete input of LIGGGHTS for each packing of each case, and prints how to
run one by hand. The packings are those with which 'vibrotrough run' begins, with the same starts and numbers of cycles;
by hand they give the same numbers. The file control.in says after which cycle a run ends. The command does not need
LIGGGHTS. It replaces no file: give another folder for another deck.

Example:
  vibrotrough deck validation/demo/campaign.toml --output decks)");
    command->callback([options, &exit_code] { exit_code = run_deck(*options); });
}

}  // namespace vibrotrough::app
