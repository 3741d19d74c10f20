#pragma once

#include "atlas/layer_load.hpp"
#include "learn/risk_design.hpp"

#include <functional>
#include <optional>

namespace vibrotrough::learn {

/// A design, and the task with what follows from the design.
struct ChosenDesign {
    DesignTask task;    ///< whose machine carries the layer of the design
    RiskDesign design;  ///< of it
};

/// kg, of the material on the trough of a task. @param depth  m, of the layer
double material_on(DesignTask const& task, double depth);

/// What the layer of a design does to its trough by the layers of the atlas; nothing where it does not lie
/// among them, or the diameter of its grains is not known.
std::optional<atlas::LayerLoad> load_of(DesignTask const& task, RiskDesign const& design);

/// Sets added mass (unless it was given) and damping of the machine of a task to what the layers of the atlas
/// have, if load_of() knows it, and to what makers count with otherwise.
void settle_load(DesignTask& task, RiskDesign const& design);

/// Designs a machine whose stroke follows from its exciter: repeats a search with another stroke, by the
/// secant method, until the exciter gives under the layer that was found the stroke that was tried, to a
/// thousandth; under a layer as heavy as its trough that knows the stroke to a hundredth (tests/learn). It
/// begins with the empty trough, which keeps the limits, too. What is not known of added mass and damping
/// counts as an error of the stroke.
/// @param task  with a machine that has an exciter, the length of the trough, and, where the machine has
///   springs, one frequency
/// @param find  searches for a machine
/// @throws as `find` and amplitude_of() do, and std::invalid_argument when the stroke does not settle
ChosenDesign design_with_exciter(DesignTask const& task,
                                 std::function<ChosenDesign(DesignTask const&)> const& find);

}  // namespace vibrotrough::learn
