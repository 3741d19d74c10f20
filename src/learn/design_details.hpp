#pragma once

#include "learn/risk_design.hpp"

#include <string>

#include <nlohmann/json_fwd.hpp>

// Parts of the report of a design (design_report.hpp).
namespace vibrotrough::learn {

inline constexpr double tonnes_per_hour = 3.6;  ///< in one kg/s

/// What to measure first, by the model that is least sure of the mass flow, for people; empty where nothing
/// is uncertain, or no probability is known.
std::string budget_text(RiskDesign const& design);

/// The budget of a forecast for programs: a list of `source`, `sd_t_per_h`, `share_of_variance` and
/// `sure_if_known_t_per_h`.
nlohmann::ordered_json budget_json(ModelForecast const& forecast);

/// The exciter and what it does to the stroke, for people; empty where the task says nothing of the machine.
std::string exciter_text(DesignTask const& task, RiskDesign const& design);

/// The same for programs; null where the task says nothing of the machine.
nlohmann::ordered_json exciter_json(DesignTask const& task, RiskDesign const& design);

/// m, the depth of the layer that carries a mass flow (kg/s) on the machine, by the model that answers first,
/// at the median of the friction: thinner than the design's, which carries it surely; nothing where a layer
/// of an allowed depth does not.
std::optional<double> depth_at(DesignTask const& task, RiskDesign const& design, double mass_flow);

/// m, by how much side walls stand above the trough, as usual: half of the layer above it, but 50 mm at
/// least, in steps of 10 mm. @param depth  m, of the design's layer
double side_wall(double depth);

/// Which usual kind of drive builds the machine, for people; empty where no kinds are known.
std::string drive_text(DesignTask const& task, RiskDesign const& design);

/// What rules of thumb say of the machine, for people, and why where that differs from the answer by more
/// than a tenth.
std::string rules_text(RiskDesign const& design);

/// The same for programs: a list of `rule`, `source`, `speed_m_per_s`, `low_m_per_s`, `high_m_per_s` and
/// `why_different`, which is null where it does not differ.
nlohmann::ordered_json rules_json(RiskDesign const& design);

}  // namespace vibrotrough::learn
