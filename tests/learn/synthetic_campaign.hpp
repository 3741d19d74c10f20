#pragma once

#include "campaign/state/added_cases.hpp"
#include "core/temporary_folder.hpp"
#include "learn/learner.hpp"
#include "scenario/example_campaign.hpp"
#include "scenario/reader/swept_keys.hpp"
#include "scenario/reader/written_campaign.hpp"
#include "store/result_file.hpp"
#include "store/sample_record.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <random>

namespace vibrotrough::learn {

inline std::string const domain_campaign =
    with("rolling_friction = 0.0", "rolling_friction = 0.1\nrotation = \"rolling\"") +
    "\n[domain]\n\"trough.throw_number\" = { from = 1, to = 3 }\n\"grains.rolling_friction\" = { from = 0, "
    "to = 0.3 }\n";

/// A campaign whose results are written by the test instead of being simulated.
class SyntheticCampaign {
  public:
    explicit SyntheticCampaign(std::string const& text = domain_campaign, unsigned seed = 4) : random_(seed) {
        std::ofstream(file_) << text;
        maker.emplace(file_);
        plan = campaign::make_plan(scenario::read_campaign(file_), own_folder_.path() / "campaign",
                                   "LIGGGHTS 3.8.0");
    }

    /// A layer that is faster than the theory around throw number 1.75, the more so the easier it rolls.
    static double layer_at(double gamma, double rolling, double theory) {
        return theory + 0.3 * std::exp(-std::pow((gamma - 1.75) / 0.4, 2)) * std::exp(-rolling / 0.15);
    }

    static double layer_at(campaign::PlannedCase const& planned) {
        return layer_at(*scenario::number_of(planned.scenario(), "trough.throw_number"),
                        *scenario::number_of(planned.scenario(), "grains.rolling_friction"),
                        prepare::solve(planned.prepared->point_mass).velocity_efficiency);
    }

    /// Writes the result of a case with so wide an interval, which costs 1 core-second at 0.02.
    void simulate(campaign::PlannedCase const& planned, double half_width,
                  core::Outcome outcome = core::Outcome::finished) {
        store::CaseRecord record = store::sample_record(planned.id);
        record.outcome = outcome;
        record.estimate.mean = layer_at(planned) + half_width / 1.96 * normal_(random_);
        record.estimate.half_width = half_width;
        if (outcome == core::Outcome::bistable_or_slow) record.estimate.mean.reset();
        for (auto& packing : record.packings)
            packing.core_time = std::pow(0.02 / half_width, 2) / static_cast<double>(record.packings.size());
        std::filesystem::create_directories(planned.folder);
        store::write_result(planned.result_file(), record);
    }

    void simulate_all(double half_width) {
        for (campaign::PlannedCase const& planned : plan.cases) simulate(planned, half_width);
    }

    /// Learns until the goal is reached; false when it is not within 60 batches.
    bool learn_until(Learner& learner, LearnGoal const& goal, LearnStatus& status) {
        for (campaign::PlannedCase const& planned : plan.cases)
            simulate(planned, learner.first_half_width(planned.scenario()));
        status = learner.look();
        for (int batch = 0; batch < 60 && !Learner::has_reached(status, goal); ++batch) {
            for (LearnStep const& step : learner.choose()) {
                if (step.added) {
                    if (auto const* added = campaign::add_case(plan, *step.added))
                        simulate(*added, step.half_width);
                } else {
                    for (auto const& planned : plan.cases)
                        if (planned.id == step.case_id) simulate(planned, step.half_width);
                }
            }
            status = learner.look();
        }
        return Learner::has_reached(status, goal);
    }

    std::optional<scenario::CaseMaker> maker;
    campaign::Plan plan;

  private:
    core::TemporaryFolder own_folder_;
    std::filesystem::path file_ = own_folder_.path() / "campaign.toml";
    std::mt19937_64 random_;
    std::normal_distribution<double> normal_;
};

}  // namespace vibrotrough::learn
