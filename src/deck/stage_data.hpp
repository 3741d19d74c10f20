#pragma once

#include "core/template.hpp"
#include "prepare/prepared_case.hpp"

namespace vibrotrough::deck {

/// What the template `stages` needs: the parts of the drive, each with its time step and the velocity of the
/// trough. In a ramp this is the change of the displacement per step, from drive_parts(), divided by the
/// step.
void describe_stages(core::TemplateData& data, prepare::PreparedCase const& prepared);

}  // namespace vibrotrough::deck
