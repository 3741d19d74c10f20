#pragma once

#include "campaign/schedule/until_precise.hpp"
#include "evaluate/case.hpp"
#include "measure/case_estimate.hpp"

#include <cmath>
#include <functional>
#include <random>

namespace vibrotrough::campaign {

/// The first-order autoregressive process y_i = rho y_(i-1) + sqrt(1 - rho^2) e_i, of variance 1, plus an
/// offset that a packing keeps, plus a start-up that ends.
struct Process {
    double rho = 0;  ///< correlation of neighbouring cycles
    double offset =
        0;  ///< standard deviation between packings, in units of that of a run's mean of 24 cycles

    /// Variance of the mean of n cycles of a stationary run: (1 + 2 sum (1 - k / n) rho^k) / n.
    double variance_of_mean(int n) const {
        double sum = 1;
        for (int k = 1; k < n; ++k) sum += 2 * (1 - static_cast<double>(k) / n) * std::pow(rho, k);
        return sum / n;
    }

    std::vector<double> make(int cycles, std::mt19937& random) const {
        std::normal_distribution<double> normal;
        double const own = offset * std::sqrt(variance_of_mean(24)) * normal(random);
        double noise = normal(random);
        std::vector<double> values;
        for (int i = 0; i < cycles; ++i) {
            values.push_back(own + noise);
            noise = rho * noise + std::sqrt(1 - rho * rho) * normal(random);
        }
        return values;
    }
};

/// Takes the numerical errors from a scenario, so that its half-width is all left to statistics: grains, box
/// and time step as no engine could simulate them. Made-up packings have only statistical errors.
inline void remove_numerical_errors(scenario::Scenario& scenario) {
    scenario.grains.youngs_modulus = 1e24;
    scenario.layer.length = scenario.layer.width = 1e9;
    scenario.solver.rayleigh_fraction = 1e-12;
}

/// What a case came to under a policy.
struct SimulatedEnd {
    measure::CaseEstimate estimate;
    core::Outcome outcome;
    int cycles;  ///< of each packing
    double all_cycles() const { return static_cast<double>(cycles) * estimate.packings; }
};

/// Lets the policy decide about a case whose packings are made up instead of simulated.
/// @param series  all cycles of a packing, by its number
inline SimulatedEnd simulate_case(Policy const& policy, PlannedCase const& planned,
                                  std::function<std::vector<double> const&(int)> const& series) {
    KnownCase known{&planned, {}, {}, {}};
    while (true) {
        CaseDecision const decision = policy.decide(known);
        for (deck::PackingPlan const& packing : decision.wanted) {
            if (is_enough(known, packing)) continue;
            std::vector<double> const& all = series(packing.number);
            known.packings[packing.number] = {{all.begin(), all.begin() + packing.cycles}, 1, true};
        }
        if (decision.result.empty()) continue;
        std::vector<measure::PackingValues> values;
        for (int const packing : decision.result) {
            std::span const all(known.packings.at(packing).efficiency);
            values.push_back(
                {all.first(static_cast<std::size_t>(decision.cycles)), evaluate::start_of(packing)});
        }
        auto const estimate = measure::estimate_case(values, evaluate::wanted_statistics(planned.scenario()));
        return {estimate, evaluate::outcome_of(estimate, planned.scenario()), decision.cycles};
    }
}

}  // namespace vibrotrough::campaign
