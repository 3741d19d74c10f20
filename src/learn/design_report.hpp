#pragma once

#include "learn/risk_design.hpp"

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace vibrotrough::learn {

/// How an objective is called on the command line, in JSON and in sentences: "least-machine-number".
std::string name_of(Objective objective);

/// Whether the mass flow is reached, and with which probability, as a sentence.
std::string first_sentence(DesignTask const& task, RiskDesign const& design);

/// A design for people: the answer, the machine, what each model says, what holds it back, rules of thumb and
/// warnings.
std::string design_text(DesignTask const& task, RiskDesign const& design);

/// All numbers for programs: the machine, `models` (a list with the mass flow, its interval and the
/// probability by each), `active_limits`, `rules_of_thumb`, `warnings`.
nlohmann::ordered_json design_json(DesignTask const& task, RiskDesign const& design);

/// What vibrotrough.report.decision writes the page of a design from: the numbers of design_json(), the
/// task, and quantiles of the mass flow.
nlohmann::ordered_json design_page_data(DesignTask const& task, RiskDesign const& design);

}  // namespace vibrotrough::learn
