#pragma once

#include "learn/risk_search.hpp"

#include <vector>

namespace vibrotrough::learn {

/// What each uncertain input leaves open of the mass flow of a machine, by one model, the largest first: its
/// standard deviation when that input alone varies and all others are at their means, and how much more would
/// be sure if it were known exactly. All are parts of the distribution by which the probability is computed.
/// For a model that is linear in its inputs their squares add up to the variance of the mass flow.
/// @param median  what the model says at the median of the friction
/// @return nothing where the material has no steady speed at some friction
std::vector<BudgetShare> budget_of(DesignTask const& task, DesignLayer const& layer, std::string const& model,
                                   ModelEfficiency const& median, SpeedDistribution const& speeds);

}  // namespace vibrotrough::learn
