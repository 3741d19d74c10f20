#pragma once

#include "learn/calibration.hpp"

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace vibrotrough::learn {

/// The calibration in plain sentences: whether any value of the free parameters explains the speeds, how
/// large the model discrepancy is, which parameters cannot be found from them, and whether the chains
/// converged. A model counts as contradicted when its p-value is below 0.01.
/// @param model  how it is called in sentences, such as "the point mass"
std::vector<std::string> verdict(Calibration const& calibration, std::string const& model);

/// All numbers for people: a table of parameters and one of misfits, followed by the verdict.
std::string calibration_text(Calibration const& calibration, std::string const& model);

/// All numbers for programs. `parameters` is a list of objects with `name`, `unit`, `median`, `low`, `high`
/// (95 %), `rhat`, `ess`, `remaining`, `identifiable`, `ranges` and `prior`; beside it `model_discrepancy`,
/// `measurements`, `best_fit`, `converged` and `verdict`.
nlohmann::ordered_json calibration_json(Calibration const& calibration, std::string const& model);

/// What vibrotrough.figures.corner draws: the numbers of calibration_json() and at most 4000 draws.
nlohmann::ordered_json corner_plot_data(Calibration const& calibration, std::string const& model);

}  // namespace vibrotrough::learn
