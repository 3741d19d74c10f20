#pragma once

#include "learn/risk_design.hpp"

#include <optional>
#include <string>

namespace vibrotrough::learn {

/// The models of layers of spheres among which a design chooses where nobody has named one.
struct ModelsToChoose {
    std::optional<DesignModel> atlas;  ///< nothing where it cannot be asked
    std::string why_no_atlas;          ///< a clause
    DesignModel law;                   ///< of rolling layers
    DesignModel point_mass;            ///< the theory
};

/// A design by the model that knows its layer.
struct ChosenDesign {
    DesignTask task;    ///< with one model that decides, and the others beside it
    RiskDesign design;  ///< by that model
};

/// Designs a machine for spheres whose diameter is known. The atlas decides where it knows a layer that
/// carries the mass flow: layers deeper than its own are left aside. Otherwise the rolling-layer law does,
/// first wherever it finds its machine, then at the throw numbers at which deep layers tested it; otherwise
/// the point mass. Where none of them knows a machine that does it, the last one that knows its layer says
/// so. Why the ones before do not decide is among the remarks of the model.
/// @param task  with the diameter of its grains
/// @throws as design_with_risk() does of the point mass
ChosenDesign design_by_known_model(DesignTask const& task, ModelsToChoose const& models);

}  // namespace vibrotrough::learn
