#pragma once

#include "learn/risk_design.hpp"

#include <optional>
#include <string>

namespace vibrotrough::learn {

/// Diameters of its grains, of the thinnest layer that a campaign simulates of a design.
inline constexpr double least_simulated_depth = 2;

/// The layer that a campaign simulates of a design.
struct CheckedLayer {
    double half_width = 0.05;  ///< wanted of its velocity efficiency
    /// In diameters: of the part that is continued periodically. It is longer than this where the depth or
    /// the stroke asks for it.
    double box_length = 12, box_width = 6;
};

/// Why the layer of a design cannot be simulated, without a full stop; nothing where it can.
std::optional<std::string> why_no_campaign(DesignTask const& task, RiskDesign const& design);

/// The text of a campaign file that simulates exactly the machine and the layer of a design with spheres, at
/// the median and at the ends of the central 95 % of the friction. What the task does not know of the grains
/// is what the models took for it, and the file says so.
/// @throws std::invalid_argument as why_no_campaign()
std::string design_campaign(DesignTask const& task, RiskDesign const& design, CheckedLayer const& layer);

}  // namespace vibrotrough::learn
