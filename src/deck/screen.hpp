#pragma once

#include "core/template.hpp"
#include "prepare/prepared_case.hpp"

#include <map>
#include <string>

namespace vibrotrough::deck {

/// Name of the mesh of the floor on which the grains settle: a plate without holes, which the screen replaces
/// when the drive begins, or the floor that moves.
std::string settling_floor(scenario::Scenario const& scenario);

/// The STL text of a screen. @pre has_holes()
std::string screen_mesh(prepare::PreparedCase const& prepared);

/// How many triangles the moving mesh of a screen has; 0 for other floors and without holes.
int triangles_of_screen(prepare::PreparedCase const& prepared);

/// The mesh of a screen that is fed, beside the sheet: the wall below its edge.
void add_end_wall(std::map<std::string, std::string>& files, prepare::PreparedCase const& prepared);

/// What the templates say about a screen, as the settling deck has it. Behind describe_open().
void describe_screen(core::TemplateData& data, prepare::PreparedCase const& prepared);

/// The floor of the deck with the drive, in place of that on which the grains settle.
void describe_moving_floor(core::TemplateData& data, prepare::PreparedCase const& prepared);

}  // namespace vibrotrough::deck
