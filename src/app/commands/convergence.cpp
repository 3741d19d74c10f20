#include "app/campaign_run.hpp"
#include "app/commands/command.hpp"
#include "app/engine_certificate.hpp"
#include "app/extra_lines.hpp"
#include "campaign/state/campaign_folder.hpp"
#include "campaign/state/numerics_results.hpp"
#include "campaign/state/overview.hpp"
#include "scenario/reader/written_campaign.hpp"

namespace vibrotrough::app {
namespace {

struct ConvergenceArguments {
    std::string campaign;
    std::vector<std::string> cases;
    std::optional<double> half_width;
    StudyOptions study;
};

/// The campaign that is studied: a folder that was run, or a campaign file with the folder that it has or
/// will have.
campaign::Plan open_campaign(ConvergenceArguments const& options, std::string const& engine_version) {
    fs::path const given = options.campaign;
    if (fs::is_directory(given)) {
        if (!options.study.output.empty())
            throw core::InputError(
                "--output belongs to a campaign file; a folder is studied in its own place");
        return campaign::open_plan(given);
    }
    scenario::Campaign const campaign = scenario::read_campaign(given);
    return campaign::make_plan(campaign, results_folder(options.study.output, campaign.name), engine_version);
}

/// The studies of the chosen cases. @throws core::InputError when there is no such case
std::vector<campaign::NumericsStudy> plan_studies(campaign::Plan const& plan,
                                                  ConvergenceArguments const& options) {
    std::vector<campaign::NumericsStudy> studies;
    if (options.cases.empty()) {
        for (std::size_t const number : campaign::representative_cases(plan.cases.size()))
            studies.push_back(campaign::plan_study(plan.cases[number], options.half_width));
    }
    for (std::string const& id : options.cases) {
        campaign::PlannedCase const& planned = case_named(plan, id);
        bool const twice = std::ranges::any_of(studies, [&](auto const& one) { return one.case_id == id; });
        if (!twice) studies.push_back(campaign::plan_study(planned, options.half_width));
    }
    return studies;
}

/// Writes the campaign of all studies into its folder and plans it.
campaign::Plan write_study(campaign::Plan const& original,
                           std::vector<campaign::NumericsStudy> const& studies, fs::path const& folder,
                           std::string const& engine_version) {
    std::vector<scenario::Scenario> scenarios;
    for (campaign::NumericsStudy const& study : studies) {
        for (scenario::Scenario const& one : study.scenarios()) scenarios.push_back(one);
    }
    for (scenario::Scenario const& one : scenarios) campaign::write_named_files(one, folder);
    std::string const comment = fmt::format(
        "The numerical error of cases of {}: their settings one by one nearer to the limit", original.name);
    core::write_file_atomically(folder / "study.toml", scenario::campaign_toml(scenarios, comment));
    return campaign::make_plan(scenario::read_campaign(folder / "study.toml"), folder, engine_version);
}

/// "found" when an error is larger than its interval, else what it is below.
std::string verdict_of(measure::NumericalError const& error) {
    if (std::abs(error.error) > error.half_width) return "found";
    return fmt::format("below {:.4f}", error.bound());
}

std::string describe(evaluate::SettingError const& setting) {
    if (!setting.error)
        return fmt::format("{}: {}", setting.is_left_out() ? "left out" : "unknown", setting.message);
    measure::NumericalError const &measured = *setting.error, known = *setting.known_error();
    std::string text = fmt::format("{:+.4f} +- {:.4f}", measured.error, measured.half_width);
    if (measured.verdict == measure::Convergence::extrapolated) text += ", extrapolated to the limit";
    if (known.half_width < measured.half_width)
        text += fmt::format("; expected 0 +- {:.4f}; together {:+.4f} +- {:.4f}", setting.expected,
                            known.error, known.half_width);
    return text + ": " + verdict_of(known);
}

void print(evaluate::NumericsBudget const& budget) {
    fmt::print("case {}", budget.case_id);
    if (budget.standard.mean) fmt::print(": efficiency {:.4f}", *budget.standard.mean);
    if (budget.standard.half_width) fmt::print(" +- {:.4f}", *budget.standard.half_width);
    fmt::print("\n");
    for (evaluate::SettingError const& setting : budget.settings)
        fmt::print("  {:<24} {}\n", title_of(setting.setting), describe(setting));
    if (auto const total = budget.total()) {
        fmt::print("  {:<24} {:+.4f} +- {:.4f}: {}; counted with {:.4f}\n", "all together", total->error,
                   total->half_width, verdict_of(*total), total->bound());
    } else {
        fmt::print("  {:<24} unknown, because a part of it is\n", "all together");
    }
}

int run_convergence(ConvergenceArguments const& options) {
    if (!fs::exists(options.campaign)) scenario::read_campaign(options.campaign);  // throws with the cure
    engine::Engine engine = engine_at(options.study.engine);
    campaign::Plan const original = open_campaign(options, engine.version);
    std::vector<scenario::Scenario> cases;
    for (campaign::PlannedCase const& planned : original.cases) cases.push_back(planned.scenario());
    check_extra_lines(options.campaign, cases, options.study.allow_extra);
    auto const studies = plan_studies(original, options);
    fs::path const folder = original.folder / "convergence";
    core::make_folder(original.folder);
    core::make_folder(folder);
    if (!certify(engine, options.study.accept_failed_probes)) return interrupted;
    campaign::Plan plan = write_study(original, studies, folder, engine.version);
    tell("{} case{} of '{}' in {} variations\n", studies.size(), studies.size() == 1 ? "" : "s",
         original.name, plan.cases.size());
    campaign::Summary const summary = run_study(options.study, engine, plan, folder / "study.toml");
    auto const budgets = campaign::measure_numerics(plan, studies);
    for (evaluate::NumericsBudget const& budget : budgets) print(budget);
    if (summary.interrupted) {
        fmt::print("interrupted: the same command continues it\n");
        return interrupted;
    }
    campaign::write_numerics(original.folder, budgets);
    bool const was_run = fs::is_regular_file(original.folder / "campaign.h5");
    if (was_run) campaign::write_campaign_file(original);
    fmt::print("written to {}; see it{} with: vibrotrough compare {} --budget\n",
               campaign::numerics_file(original.folder).string(), was_run ? "" : " after 'vibrotrough run'",
               core::shell_word(original.folder));
    bool const all =
        std::ranges::all_of(budgets, [](auto const& one) { return one.numerical_error().has_value(); });
    return all ? all_well : some_cases_failed;
}

}  // namespace

void add_convergence(CLI::App& program, int& exit_code) {
    auto const options = std::make_shared<ConvergenceArguments>();
    CLI::App* const command = program.add_subcommand(
        "convergence", R"(Measure the numerical error of a campaign's velocity efficiencies

The interval of a case says how well its mean is known. It does not say how far that mean is from the one with hard
grains, a vanishing time step and an endless layer. This command simulates chosen cases again with each of these settings
nearer to its limit, one at a time, and adds the differences up to an error budget.)");
    command
        ->add_option("CAMPAIGN", options->campaign,
                     "The campaign file, or the folder of a campaign that was run")
        ->required()
        ->type_name("CAMPAIGN.toml|DIR");
    options->study.add_to(*command);
    add_repeated(*command, "--case", options->cases,
                 "Study this case, an id that 'vibrotrough plan' or 'compare' shows; repeat the option for "
                 "further cases. Default: the first, the middle and the last case of the campaign",
                 "ID");
    command
        ->add_option("--half-width", options->half_width,
                     "Half-width of the interval that is wanted of each variation; default: "
                     "measure.half_width of the case. No error below about 1.4 times this is seen")
        ->check(CLI::Range(1e-5, 1.0))
        ->type_name("H");
    command->footer(
        R"(Each case is simulated with its own settings (unless the campaign has a result that is narrow enough), with Young's modulus times 4 and 16, with half the
time step, and in a box of twice the length and of twice the width. This costs about 13 times as much as the case itself.
What makes no sense is left out and named: the width between side walls, and all of these for a rigid block, whose
contact is made 2 and 4 times stiffer instead. The simulations are a campaign of their own in DIR/convergence.

The error of a setting is the default's value minus that of the limit, with the intervals of both combined. Where
the order of the error is known (Young's modulus: overlaps go with E^(-2/5)), the limit is extrapolated if the values rise or
fall significantly throughout and lie on one line. Otherwise the finest setting stands for the limit.

What other layers showed of each error (0 +- its half-width, as 'vibrotrough check' has it) is known beforehand. Both are
weighted by their inverse squares, unless the measurement contradicts it: then it stands alone. An error is found when it
is larger than its interval; else the line says what it is below. The errors of all settings add up, their half-widths
as the root of the sum of their squares.

The budget is written to DIR/numerics.json. 'vibrotrough compare DIR --budget', the report and campaign.h5 then show
this numerical error beside the statistical one. Cases that were not studied keep what is known beforehand.

Ctrl-C stops the run cleanly, and the same command continues it.

Examples:
  vibrotrough convergence runs/demo --jobs 2
  vibrotrough convergence validation/demo/campaign.toml --output runs/demo --half-width 0.01)");
    command->callback([options, &exit_code] { exit_code = run_convergence(*options); });
}

}  // namespace vibrotrough::app
