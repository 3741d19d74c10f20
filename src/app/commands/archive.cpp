#include "app/commands/command.hpp"
#include "archive/bundle.hpp"
#include "campaign/execute/executors.hpp"
#include "campaign/state/campaign_folder.hpp"

namespace vibrotrough::app {
namespace {

struct ArchiveArguments {
    std::string folder, output;
    archive::BundleWords words;
};

/// A licence is named by its address, so that a machine can follow it.
void check_license(std::string const& license) {
    if (license.empty() || license.starts_with("https://") || license.starts_with("http://")) return;
    throw core::InputError(
        fmt::format("--license {}: is not an address; give one such as "
                    "https://creativecommons.org/licenses/by/4.0/",
                    license));
}

/// Why campaign.h5 is not in the bundle; empty when it is.
std::string fault_of(campaign::CampaignFileState state) {
    using enum campaign::CampaignFileState;
    switch (state) {
        case missing:
            return "which is not there";
        case outdated:
            return "which is damaged or does not hold the results that are there";
        case up_to_date:
            break;
    }
    return "";
}

int run_archive(ArchiveArguments const& options) {
    check_license(options.words.license);
    campaign::Plan const plan = campaign::open_plan(options.folder);
    fs::path const output = options.output.empty() ? fs::path(plan.name + ".zip") : fs::path(options.output);
    archive::BundleReport const report =
        archive::write_bundle(plan, campaign::activity_in(plan.folder), output, options.words);
    fmt::print("{}: {} files, {:.1f} MB, {} of {} cases with a result\n", output.string(), report.files,
               static_cast<double>(report.bytes) / 1e6, report.results, plan.cases.size());
    std::string const folder = core::shell_word(options.folder);
    if (!report.left_aside.empty()) fmt::print("left aside: {}\n", report.left_aside);
    if (std::string const fault = fault_of(report.campaign_file); !fault.empty())
        fmt::print("without campaign.h5, {}: 'vibrotrough run' writes it\n", fault);
    if (!report.has_report)
        fmt::print("without figures and report: 'vibrotrough report {}' makes them\n", folder);
    if (options.words.license.empty())
        fmt::print("no licence is named, so that nobody may use it: see --license\n");
    fmt::print("unpack it, and see its table with: vibrotrough compare FOLDER\n");
    return all_well;
}

}  // namespace

void add_archive(CLI::App& program, int& exit_code) {
    auto const options = std::make_shared<ArchiveArguments>();
    CLI::App* const command =
        program.add_subcommand("archive", "Make one ZIP file of a campaign, for the supplement of a paper");
    add_campaign_folder(*command, options->folder);
    add_text(*command, "--output", options->output,
             "The ZIP file; default <name of the campaign>.zip. An earlier bundle is replaced, any "
             "other file is not",
             "FILE");
    add_repeated(*command, "--author", options->words.authors,
                 "Name of an author, for the bundle's metadata; repeat the option for several", "NAME");
    add_text(*command, "--license", options->words.license,
             "Address of the licence under which others may use the data", "URL");
    command->add_flag("--partial", options->words.partial,
                      "Archive the cases that have a result although others have none, or although the "
                      "campaign file in the folder was changed");
    command->footer(
        R"(The bundle holds the frozen campaign file with the files that it names, the decks of every case, its results
with all cycles, the engine's certificate, the table of 'vibrotrough compare' as CSV, JSON and text, campaign.h5, figures and
report where they were made, the versions of all programs that took part, the SHA-256 of every file, and metadata by RO-Crate 1.1
(ro-crate-metadata.json), which repositories such as Zenodo and Dataverse know. Its README.txt explains the files. Restart files,
cycles.csv and frames are left out: the results hold all cycles, and the decks make the rest again.

Unpacked, a bundle is a campaign's folder: 'sha256sum -c SHA256SUMS' in it checks every file, and 'vibrotrough compare FOLDER'
prints the same table, digit for digit. The same campaign makes the same bytes.
A bundle names the machines on which it was simulated and the path of the engine.

Example:
  vibrotrough archive runs/demo --output supplement.zip --author "A. Researcher" \
      --license https://creativecommons.org/licenses/by/4.0/)");
    command->callback([options, &exit_code] { exit_code = run_archive(*options); });
}

}  // namespace vibrotrough::app
