#pragma once

#include "atlas/value.hpp"
#include "campaign/state/added_cases.hpp"
#include "core/temporary_folder.hpp"
#include "inference/gaussian_process.hpp"
#include "learn/learner.hpp"
#include "scenario/example_campaign.hpp"
#include "scenario/reader/sample_cube.hpp"
#include "scenario/reader/swept_keys.hpp"
#include "scenario/reader/written_campaign.hpp"
#include "store/result_file.hpp"
#include "store/sample_record.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <random>

namespace vibrotrough::learn {

/// Spheres: the trend of their surface is the atlas.
inline std::string const domain_campaign =
    with("rolling_friction = 0.0", "rolling_friction = 0.1\nrotation = \"rolling\"") +
    "\n[domain]\n\"trough.throw_number\" = { from = 1, to = 3 }\n\"grains.rolling_friction\" = { from = 0, "
    "to = 0.3 }\n";
/// Layers that the atlas does not cover: the trend of their surface is the theory.
inline std::string const campaign_of_another_kind = domain_campaign + "[engine]\ncontact = \"hooke\"\n";

/// Velocity efficiency of a layer, by throw number, rolling friction and velocity efficiency of the theory.
using Layer = std::function<double(double gamma, double rolling, double theory)>;

/// A random function over throw number 1 to 3 and rolling friction 0 to 0.3, as layers differ from a trend: a
/// Matern process with the standard deviation of unseen layers about the atlas, 0.03, and the lengths of its
/// own process.
class RoughDifference {
  public:
    explicit RoughDifference(unsigned seed) : process_(draw(seed)) {}
    double operator()(double gamma, double rolling) const {
        return process_.mean(Eigen::Vector2d((gamma - 1) / 2, rolling / 0.3), Eigen::VectorXd::Ones(1));
    }

  private:
    static inference::GaussianProcess draw(unsigned seed) {
        inference::Hyperparameters const rough{0.03, Eigen::Vector2d(0.31, 1.27), 0};
        inference::TrendPrior const zero{Eigen::VectorXd::Zero(1), Eigen::VectorXd::Constant(1, 1e-6)};
        auto const places = scenario::sample_cube(scenario::SampleMethod::sobol, 100, 2, seed);
        inference::ProcessData data;
        std::mt19937_64 random(seed);
        std::normal_distribution<double> normal;
        // One value after the other, each given those before it.
        for (auto const& place : places) {
            Eigen::Vector2d const x(place[0], place[1]);
            Eigen::VectorXd const one = Eigen::VectorXd::Ones(1);
            auto const next = data.values.size() == 0
                                  ? inference::ProcessValue{0, rough.deviation}
                                  : inference::GaussianProcess(data, zero, rough).predict(x, one);
            Eigen::Index const n = data.values.size();
            data.inputs.conservativeResize(n + 1, 2);
            data.trend.conservativeResize(n + 1, 1);
            data.values.conservativeResize(n + 1);
            data.noise.conservativeResize(n + 1);
            data.inputs.row(n) = x;
            data.trend(n, 0) = 1;
            data.values(n) = next.mean + next.sd * normal(random);
            data.noise(n) = 1e-5;
        }
        return {data, zero, rough};
    }

    inference::GaussianProcess process_;
};

/// A layer that is faster than the theory around throw number 1.75, the more so the easier it rolls.
inline double layer_beside_theory(double gamma, double rolling, double theory) {
    return theory + 0.3 * std::exp(-std::pow((gamma - 1.75) / 0.4, 2)) * std::exp(-rolling / 0.15);
}

/// What the atlas says of the layers of the campaign.
inline double layer_of_atlas(double gamma, double rolling, double) {
    atlas::Place const place{gamma, std::tan(std::acos(-1.0) / 6), 0, 0.23, 2, 4, 0.5, rolling, 0.5};
    return *atlas::efficiency_at(atlas::within_ranges(place));
}

/// A layer with a random difference from another.
inline Layer roughened(Layer const& layer, unsigned seed) {
    return [layer, difference = RoughDifference(seed)](double gamma, double rolling, double theory) {
        return layer(gamma, rolling, theory) + difference(gamma, rolling);
    };
}

/// A campaign whose results are written by the test instead of being simulated.
class SyntheticCampaign {
  public:
    explicit SyntheticCampaign(std::string const& text = campaign_of_another_kind, unsigned seed = 4,
                               Layer layer = layer_beside_theory)
        : random_(seed), layer_(std::move(layer)) {
        std::ofstream(file_) << text;
        maker.emplace(file_);
        plan = campaign::make_plan(scenario::read_campaign(file_), own_folder_.path() / "campaign",
                                   "LIGGGHTS 3.8.0");
    }

    double layer_at(scenario::Scenario const& scenario) const {
        return layer_(*scenario::number_of(scenario, "trough.throw_number"),
                      *scenario::number_of(scenario, "grains.rolling_friction"),
                      prepare::solve(prepare::prepare_case(scenario).point_mass).velocity_efficiency);
    }

    /// Writes the result of a case with so wide an interval, which costs 1 core-second at 0.02.
    void simulate(campaign::PlannedCase const& planned, double half_width,
                  core::Outcome outcome = core::Outcome::finished) {
        store::CaseRecord record = store::sample_record(planned.id);
        record.outcome = outcome;
        record.estimate.mean = layer_at(planned.scenario()) + half_width / 1.96 * normal_(random_);
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
    Layer layer_;
};

}  // namespace vibrotrough::learn
