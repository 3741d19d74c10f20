#pragma once

#include "learn/speed_model.hpp"

#include <functional>
#include <optional>
#include <vector>

// Internal to the design with risk (risk_search.cpp).
namespace vibrotrough::learn {

/// The layers among which a design chooses: every drive of a space that keeps its largest machine number and
/// throw number, with every depth of a range.
///
/// Each of them is a point of a unit cube whose dimensions are the quantities that may be chosen. The ends of
/// frequency and amplitude follow from those of the quantities before them, so that the limits are faces of
/// the cube, and the vigorous machines that lie on them are easily found.
class LayerSpace {
  public:
    /// @param depth  m, of the layer, low > 0
    LayerSpace(theory::DriveSpace const& space, theory::Range const& depth);

    /// The number of quantities that may be chosen, 0 to 5.
    std::size_t dimensions() const { return free_.size(); }
    /// The layer at a point; nothing where the angles leave no frequency and amplitude.
    std::optional<DesignLayer> at(std::vector<double> const& point) const;
    /// Points that fill the cube evenly, and for each its neighbours with the largest amplitude and the
    /// largest depth.
    std::vector<std::vector<double>> sample() const;

  private:
    enum Quantity { angle, inclination, frequency, amplitude, depth_of_layer };

    theory::DriveSpace space_;
    theory::Range depth_;
    std::vector<Quantity> free_;
};

/// A number that depends on the layer.
using LayerFunction = std::function<double(DesignLayer const&)>;

/// What is looked for among layers.
struct LayerGoal {
    LayerFunction merit;                  ///< to be as large as possible; not finite: of no use
    std::vector<LayerFunction> excesses;  ///< limits: each is relative and must not be positive
};

/// A layer that was found.
struct FoundLayer {
    std::vector<double> point;  ///< of the space
    DesignLayer layer;          ///< there
    double merit;               ///< of it
};

/// Looks at the sample of a space, and climbs from the best of its layers, and from `starts`, by NLopt's
/// COBYLA. The same question always has the same answer.
/// @return the best layers that keep all limits, at most four, the best one first; empty where there is none
std::vector<FoundLayer> best_layers(LayerSpace const& space, LayerGoal const& goal,
                                    std::vector<std::vector<double>> const& starts = {});

/// Climbs a short way from a point: for a goal that is slow, and nearly the one by which it was found.
/// @return nothing where no layer on the way keeps all limits
std::optional<FoundLayer> polished(LayerSpace const& space, LayerGoal const& goal,
                                   std::vector<double> const& start);

}  // namespace vibrotrough::learn
