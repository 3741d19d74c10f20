#pragma once

#include "scenario/model/scenario.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

/// @file
/// Where the grains are: the surfaces of the trough and what happens at the ends of the box.

namespace vibrotrough::prepare {

/// How often grains are fed within a cycle, evenly.
constexpr int feeds_per_cycle = 10;

/// A trough that is fed at its back wall and discharged over its edge. m and m/s; x from the back wall, z
/// from the floor at rest.
struct OpenTrough {
    double feed_start, feed_end;      ///< ends of the zone that the feed falls into, along the trough
    double feed_bottom, feed_top;     ///< heights between which grains appear
    double feed_speed;                ///< with which they fall
    double window_start, window_end;  ///< ends of the piece of trough whose speed is measured
    double out_x;                     ///< behind it grains have left the trough
    double out_near_x, out_z;         ///< so have grains that are behind out_near_x and below out_z
    double longest_cycle;             ///< s, of the drive
    double bin;                       ///< length of a bin along the trough
    double box_start, box_end;        ///< ends of the box along the trough
    double box_side;                  ///< of the box beyond each side wall
    double box_bottom;                ///< lower end of the box
    /// Of a screen: upper and lower end of the wall that hangs below the edge and separates what passed from
    /// what left over the edge.
    std::optional<std::array<double, 2>> end_wall = {};
};

/// A floor with holes, and what is below it. m; z from the floor at rest.
struct ScreenFloor {
    int along, across;  ///< numbers of holes in the two directions; 0 without holes
    double plate;       ///< length of the closed sheet before the first row of holes and bars
    double out_z;       ///< grains with their centres below it at the end of a cycle have passed
    double catch_z;     ///< a plane on which grains come to rest if they are not taken out before
};

/// A part of a mesh with a contact of its own.
struct TroughPart {
    std::string name;                         ///< as pairs name it
    std::vector<scenario::Triangle> surface;  ///< m
};

/// The space of a layer. The box is periodic along the trough, so that all grains are conserved and the
/// displacement of their centre of mass is the conveying speed; or the trough is open.
struct Domain {
    /// Whether there are walls at both sides; periodic across otherwise.
    bool is_closed = false;
    /// The surface of the trough, m, with its nodes exactly on the ends of the box; empty for the flat floor
    /// at z = 0.
    std::vector<scenario::Triangle> surface = {};
    std::vector<TroughPart> parts = {};  ///< what is not in `surface`: scenario::own_parts()
    double floor_top = 0;  ///< m, its highest point but for upright walls, above which grains are poured
    double top = 0;        ///< m, its highest point
    std::optional<OpenTrough> open = {};     ///< only of an open trough
    std::optional<ScreenFloor> screen = {};  ///< only of a screen

    /// Whether the trough has another surface than the flat floor.
    bool has_mesh() const { return !surface.empty(); }

    /// Whether grains leave the layer, so that its centre of mass does not show the conveying speed.
    bool loses_grains() const { return open || screen; }
};

/// The domain of a scenario.
Domain domain_of(scenario::Scenario const& scenario);

}  // namespace vibrotrough::prepare
