#pragma once

#include "deck/deck.hpp"

#include <map>
#include <string>

namespace vibrotrough::deck {

/// Numbers of the template `phases` by name: how often the layer is looked at within a cycle, and in what
/// bins. Lengths in m.
std::map<std::string, std::string> phase_sampling(Scenario const& scenario, TimeGrid const& time);

}  // namespace vibrotrough::deck
