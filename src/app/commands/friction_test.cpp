#include "app/campaign_run.hpp"
#include "app/commands/command.hpp"
#include "app/engine_certificate.hpp"
#include "app/extra_lines.hpp"
#include "campaign/state/campaign_folder.hpp"
#include "campaign/state/friction_results.hpp"
#include "campaign/state/overview.hpp"
#include "scenario/reader/shake_test.hpp"

namespace vibrotrough::app {
namespace {

struct FrictionTestArguments {
    std::string campaign_file;
    std::optional<double> machine_number;
    StudyOptions study;
};

void print(evaluate::LayerFriction const& test) {
    fmt::print("layer {}, grain friction {:.3g}, K = {:.3f}: ", test.layer, test.grain_friction,
               test.machine_number);
    if (test.displacement) {
        fmt::print("slides {:.4f}", *test.displacement);
        if (test.half_width) fmt::print(" +- {:.4f}", *test.half_width);
        fmt::print(" r, creeps {:+.4f} r per cycle; ", test.creep);
    }
    if (test.friction) {
        fmt::print("effective friction {:.4f} ({:.4f} {}), mode {}", *test.friction, *test.low,
                   test.high ? fmt::format("to {:.4f}", *test.high) : "or more", test.mode);
        if (!test.message.empty()) fmt::print("; {}", test.message);
    } else {
        fmt::print("no friction coefficient: {}", test.message);
    }
    fmt::print("\n");
}

/// Says of how many cases 'compare' shows the friction: of those whose layer is the one that was tested, if
/// the interval has an upper end.
void tell_shown(scenario::Campaign const& campaign, std::vector<evaluate::LayerFriction> const& tests,
                fs::path const& folder) {
    auto const is_tested = [&](scenario::Scenario const& one) {
        std::string const layer = layer_key(one);
        return std::ranges::any_of(tests, [&](auto const& test) { return test.high && test.layer == layer; });
    };
    auto const count = std::ranges::count_if(campaign.cases, is_tested);
    auto const all = std::ssize(campaign.cases);
    if (std::ranges::none_of(tests, [](auto const& test) { return test.high.has_value(); })) {
        fmt::print(
            "no friction with an interval was found, so that 'vibrotrough compare' has none to show\n");
        return;
    }
    fmt::print("'vibrotrough compare {}' shows the theory at this friction for {} of {} cases{}\n",
               core::shell_word(folder), count, all,
               count == all ? ""
                            : ": the other layers are not the tested ones, whose modulus was chosen for the "
                              "shaking; give grains.youngs_modulus in the campaign file");
}

int run_friction_test(FrictionTestArguments const& options) {
    scenario::Campaign const campaign = scenario::read_campaign(options.campaign_file);
    check_extra_lines(options.campaign_file, campaign.cases, options.study.allow_extra);
    engine::Engine engine = engine_at(options.study.engine);
    fs::path const folder = results_folder(options.study.output, campaign.name);
    fs::path const test_folder = folder / "friction-test";
    double friction = 0;
    for (scenario::Scenario const& one : campaign.cases)
        friction = std::max({friction, one.trough.friction, mean_trough_friction(one)});
    double const k = options.machine_number.value_or(evaluate::default_machine_number(friction));

    core::make_folder(folder);
    core::make_folder(test_folder);
    if (!certify(engine, options.study.accept_failed_probes)) return interrupted;
    fs::path const test_file = test_folder / "shake-test.toml";
    for (scenario::Scenario const& one : campaign.cases) campaign::write_named_files(one, test_folder);
    for (fs::path const& file : campaign.files)
        core::write_file_atomically(test_folder / file.filename(), core::read_file(file));
    core::write_file_atomically(test_file, scenario::shake_test_campaign(options.campaign_file, k));
    campaign::Plan plan =
        campaign::make_plan(scenario::read_campaign(test_file), test_folder, engine.version);
    campaign::Summary const summary = run_study(options.study, engine, plan, test_file, campaign.run);
    auto const tests = campaign::measure_friction(plan);
    for (evaluate::LayerFriction const& test : tests) print(test);
    if (summary.interrupted) {
        fmt::print("interrupted: the same command continues it\n");
        return interrupted;
    }
    campaign::write_friction(folder, tests);
    fmt::print("written to {}\n", campaign::friction_file(folder).string());
    tell_shown(campaign, tests, folder);
    bool const all = std::ranges::all_of(tests, [](auto const& test) { return test.friction.has_value(); });
    return all ? all_well : some_cases_failed;
}

}  // namespace

void add_friction_test(CLI::App& program, int& exit_code) {
    auto const options = std::make_shared<FrictionTestArguments>();
    CLI::App* const command = program.add_subcommand(
        "friction-test", R"(Measure the friction coefficient of a campaign's layers as a whole

Each layer is shaken along a level trough. Its friction coefficient is the one with which a point mass slides as far
as the layer does (Sloot & Kruyt 1996, section 3.5). It is lower than the friction coefficient between a grain and the
trough, because grains roll and layers shear.)");
    add_campaign_file(*command, options->campaign_file);
    command
        ->add_option(
            "--machine-number", options->machine_number,
            "K = omega^2 r / g of the shaking. The layer must slide both ways without resting, which needs "
            "K > mu sqrt(1 + pi^2 / 4) = 1.862 mu; the closer K is to that, the more precise the result. "
            "Default: 0.67 as in the paper, or 1.2 times that limit for the largest grain friction when "
            "that is more")
        ->check(CLI::Range(1e-3, 1e3))
        ->type_name("K");
    options->study.add_to(*command);
    command->footer(
        R"(The test is a separate campaign in DIR/friction-test. Prints one line per layer: how far it slides relative to the trough (from peak to peak, in amplitudes
r), its friction coefficient with an interval, and its mode. The numbers are also written to DIR/friction.json, and 'vibrotrough compare DIR' then
shows the theory with this friction too, for the cases with the layer that was tested: also its modulus must be the same,
which is chosen for each drive unless grains.youngs_modulus gives it. Cases with the same grains, layer and trough surface share one test.

Ctrl-C stops the run cleanly, and the same command continues it.

Example:
  vibrotrough friction-test validation/demo/campaign.toml --output runs/demo --jobs 2)");
    command->callback([options, &exit_code] { exit_code = run_friction_test(*options); });
}

}  // namespace vibrotrough::app
