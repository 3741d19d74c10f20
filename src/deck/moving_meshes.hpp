#pragma once

#include "core/template.hpp"
#include "prepare/prepared_case.hpp"

namespace vibrotrough::deck {

/// What the templates say of the meshes that move with the trough: the parts of its own mesh with a contact
/// of their own, its walls, and how many meshes there are.
void describe_moving_meshes(core::TemplateData& data, prepare::PreparedCase const& prepared);

}  // namespace vibrotrough::deck
