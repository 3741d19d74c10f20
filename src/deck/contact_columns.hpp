#pragma once

#include "core/template.hpp"

namespace vibrotrough::deck {

/// Sets what the engine's two computes of contacts are asked for and which of their columns are written: the
/// engine allows one for the contacts of grains and one for those with walls, so that frames and
/// the largest overlap of phases.csv share them.
/// @param frames  whether the contacts of frames are written
void describe_contact_columns(core::TemplateData& data, bool frames);

}  // namespace vibrotrough::deck
