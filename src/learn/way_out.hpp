#pragma once

#include "learn/risk_design.hpp"

#include <string>

// Internal to the design with risk (risk_design.cpp).
namespace vibrotrough::learn {

/// The layers among which a machine is looked for.
struct AllowedLayers {
    theory::DriveSpace drives;  ///< that the limits of a task and its models allow
    theory::Range depth;        ///< m, likewise
};

/// Before any speed is looked at. @throws std::invalid_argument when there are none
AllowedLayers allowed_layers(DesignTask const& task);

/// Why no machine keeps all limits of a task: what the models know, and each limit that alone would have to
/// give way, with the value that lets a machine through. A sentence without a full stop, for an error.
std::string why_no_machine(DesignTask const& task);

}  // namespace vibrotrough::learn
