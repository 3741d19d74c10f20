#include "app/commands/command.hpp"
#include "app/learning.hpp"
#include "app/progress_log.hpp"
#include "prepare/numerical_errors.hpp"
#include "scenario/reader/swept_keys.hpp"

namespace vibrotrough::app {
namespace {

struct LearnArguments {
    RunOptions shared;
    QuantityOptions quantities;
    Text budget;
};

learn::LearnGoal read_goal(LearnArguments const& options) {
    learn::LearnGoal goal{};
    goal.half_width = options.quantities.required("--half-width");
    goal.budget = read_core_time(required("--budget", options.budget, "\"4 core-hours\""));
    if (auto const batch = options.quantities.value("--batch")) goal.batch = static_cast<int>(*batch);
    return goal;
}

std::string place_text(atlas::Place const& place, std::vector<atlas::SurfaceInput> const& inputs) {
    std::string text;
    for (std::size_t k = 0; k < place.size(); ++k)
        text += fmt::format("{}{}={}", k == 0 ? "" : ",", inputs[k].key,
                            scenario::written_value(*scenario::find_key(inputs[k].key), place[k]));
    return text;
}

std::string describe(learn::LearnStatus const& s, std::vector<atlas::SurfaceInput> const& inputs) {
    return fmt::format(
        "{} cases{}: largest half-width {:.4f} at {}, mean {:.4f}; Q2 {:.3f}, {} of {} left-out points "
        "covered; {:.3g} core-hours spent, "
        "about {:.2g} to go{}",
        s.cases, s.apart > 0 ? fmt::format(" ({} more kept apart)", s.apart) : "",
        s.certainty.at_worst.half_width, place_text(s.certainty.worst, inputs), s.certainty.mean_half_width,
        s.quality.q2, s.quality.covered, s.quality.points, s.core_time / 3600, s.core_time_to_go / 3600,
        s.contradicts_atlas ? "; these layers differ from the atlas more than others do" : "");
}

/// What is wanted of the whole, and what the numerical errors of the simulations leave of it.
struct Whole {
    double half_width;  ///< --half-width
    double numerics;    ///< learn::CampaignPoints::numerics

    /// What is left for statistics; nothing when it is too little.
    std::optional<double> left() const { return prepare::left_for_statistics(half_width, numerics); }
};

/// Says how learning ended. @return the exit code
int conclude(learn::LearnStatus const& status, learn::LearnGoal const& goal, Whole const& whole,
             std::string const& folder) {
    bool const is_learnt = learn::Learner::has_reached(status, goal);
    constexpr double rounding = 1 + 1e-12;
    double const largest = std::hypot(status.certainty.at_worst.half_width, whole.numerics);
    bool const reached = is_learnt && largest <= rounding * whole.half_width;
    if (reached) {
        fmt::print(
            "the surface is known to +- {:g} everywhere in the domain: statistics {:.4f} at most, numerical "
            "errors of the simulations {:.4f}\n",
            whole.half_width, status.certainty.at_worst.half_width, whole.numerics);
    } else if (is_learnt) {
        fmt::print(
            "not reached: the statistics are as asked ({:.4f} at most), but with the numerical errors of the "
            "simulations, which may be {:.4f}, they are more than +- {:g}; stiffer grains and a larger box "
            "make these errors smaller ('vibrotrough check' shows them)\n",
            status.certainty.at_worst.half_width, whole.numerics, whole.half_width);
    } else if (status.certainty.at_worst.half_width > goal.half_width) {
        fmt::print(
            "not reached: the largest half-width of the statistics is {:.4f} instead of {:.4g}, and no "
            "further step is "
            "possible; raise --budget, or what a case may have (measure.max_packings, measure.max_cycles)\n",
            status.certainty.at_worst.half_width, goal.half_width);
    } else if (status.quality.points < status.least_points) {
        fmt::print(
            "not reached: the half-widths are as asked, but they rest on {} points where {} are needed to "
            "trust them, and no further step is possible; raise --budget, or what a case may have "
            "(measure.max_packings, measure.max_cycles)\n",
            status.quality.points, status.least_points);
    } else {
        fmt::print("not reached: the half-widths are as asked, but they cannot be trusted\n");
    }
    for (std::string const& doubt : status.doubts) fmt::print("{}\n", doubt);
    fmt::print("ask it with: vibrotrough predict {} --at KEY=VALUE,...\n", folder);
    return reached && status.doubts.empty() ? all_well : some_cases_failed;
}

int run_learn(LearnArguments const& options) {
    learn::LearnGoal goal = read_goal(options);
    ReadyCampaign ready = prepare_run(options.shared);
    if (ready.is_interrupted) return interrupted;
    auto wanted = learn::read_wanted_half_widths(ready.plan.folder);
    if (!options.quantities.has("--batch")) goal.batch = usual_batch(options.shared.jobs, ready.plan);
    scenario::CaseMaker const maker(options.shared.campaign_file);
    keep_known_cases(ready.plan, maker, wanted);
    Whole const whole{goal.half_width, learn::campaign_points(ready.plan, maker).numerics};
    goal.half_width = whole.left().value_or(whole.half_width);
    if (!whole.left()) {
        tell(
            "learn: the numerical errors of the simulations alone may be {:.4f}, which is too much for "
            "--half-width {:g}; its statistics are learnt to that, and stiffer grains or a larger box are "
            "needed for the rest\n",
            whole.numerics, whole.half_width);
    }
    learn::Learner learner(ready.plan, maker, goal);
    for (campaign::PlannedCase const& planned : ready.plan.cases)
        wanted.emplace(planned.id, learner.first_half_width(planned.scenario()));
    learn::write_wanted_half_widths(ready.plan.folder, wanted);
    while (true) {
        if (!simulate(options.shared, ready, wanted)) return interrupted;
        learn::LearnStatus const status = learner.look();
        std::string const line = describe(status, learner.inputs());
        CampaignLog(ready.plan.folder).info("learn: " + line);
        fmt::print("{}\n", line);
        std::fflush(stdout);
        auto const steps =
            learn::Learner::has_reached(status, goal) ? std::vector<learn::LearnStep>{} : learner.choose();
        if (steps.empty() || !take_steps(steps, ready.plan, wanted))
            return conclude(status, goal,
                            {whole.half_width, learn::campaign_points(ready.plan, maker).numerics},
                            core::shell_word(ready.plan.folder));
    }
}

}  // namespace

void add_learn(CLI::App& program, int& exit_code) {
    auto const options = std::make_shared<LearnArguments>();
    CLI::App* const command = program.add_subcommand(
        "learn", "Learn the velocity efficiency over a domain with the least core-hours");
    options->shared.add_to(*command);
    options->quantities.add_to(*command, {{"--half-width"}, {"--batch"}});
    command->add_option("--budget", options->budget,
                        "Core time of all simulations together, for example \"4 core-hours\"");
    command->footer(
        R"(The section [domain] of the campaign file gives the ranges of the inputs. A few cases that fill the domain are
simulated first. Then a surface is fitted (see 'vibrotrough predict --help'), and each further batch is chosen so that
it lowers the uncertainty of the surface most per core-hour: cases at new places, or more packings of cases that are
there. Learning ends when the largest half-width is as asked, left-out points lie within their predicted intervals as
often as they should, and there are at least five points for each input (ten for layers that the atlas does not cover,
or that differ from it more than others do); or when the budget allows no further step. It then says why the goal was
not reached. The half-width holds statistics and the bound of the numerical errors of the cases together; what the
latter leave of it is what the statistics are learnt to.

Each step prints the worst place, Q2, how many left-out points are covered, the core time so far and an estimate of
what is to go. Ctrl-C stops cleanly, and the same command continues.

Example:
  vibrotrough learn domain.toml --half-width 0.05 --budget "4 core-hours" --output runs/domain)");
    command->callback([options, &exit_code] { exit_code = run_learn(*options); });
}

}  // namespace vibrotrough::app
