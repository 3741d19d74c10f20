#pragma once

#include "learn/risk_search.hpp"

// Internal to the design with risk (risk_design.cpp).
namespace vibrotrough::learn {

/// A layer as a design: what the models of the task say of it, and what holds it back.
RiskDesign described(RiskSearch const& search, DesignLayer const& layer);

}  // namespace vibrotrough::learn
