#pragma once

#include "scenario/model/scenario.hpp"

#include <vector>

/// @file
/// Where the grains are: the surfaces of the trough and what happens at the ends of the box.

namespace vibrotrough::prepare {

/// The space of a layer. The box is periodic along the trough, so that all grains are conserved and the
/// displacement of their centre of mass is the conveying speed.
struct Domain {
    /// Whether there are walls at both sides; periodic across otherwise.
    bool is_closed = false;
    /// The surface of the trough, m, with its nodes exactly on the ends of the box; empty for the flat floor
    /// at z = 0.
    std::vector<scenario::Triangle> surface = {};
    double floor_top = 0;  ///< m, its highest point but for upright walls, above which grains are poured
    double top = 0;        ///< m, its highest point

    /// Whether the trough has another surface than the flat floor.
    bool has_mesh() const { return !surface.empty(); }
};

/// The domain of a scenario.
Domain domain_of(scenario::Scenario const& scenario);

}  // namespace vibrotrough::prepare
