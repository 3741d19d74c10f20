#pragma once

#include "campaign/state/left_aside.hpp"

#include <vector>

namespace vibrotrough::app {

/// Says in one line on standard error what of a campaign's folder is not in what the command shows. Says
/// nothing when nothing is left aside.
void tell_left_aside(campaign::Plan const& plan, std::vector<campaign::CaseOverview> const& cases);

}  // namespace vibrotrough::app
