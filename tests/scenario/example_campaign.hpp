#pragma once

#include "scenario/reader/campaign_file.hpp"

#include <string>
#include <string_view>

namespace vibrotrough {

/// The campaign file of the contract, without its sweep.
inline std::string const example_campaign = R"([campaign]
name = "pvc-horizontal"

[trough]
inclination = "0 deg"
vibration_angle = "30 deg"
amplitude = "6 mm"
throw_number = 2.0
friction = 0.23
restitution = 0.5

[grains]
diameter = "3 mm"
diameter_spread = 0.1
density = "1400 kg/m3"
youngs_modulus = "5 MPa"
poisson_ratio = 0.35
friction = 0.5
restitution = 0.5
rolling_friction = 0.0

[layer]
length = "36 mm"
width = "18 mm"
height = "12 mm"

[measure]
packings = 3
confidence = 0.95
half_width = 0.02
max_cycles = 200

[output]
frames_per_cycle = 0
)";

/// The example with the first occurrence of `from` replaced by `to`.
inline std::string with(std::string_view from, std::string_view to, std::string text = example_campaign) {
    text.replace(text.find(from), from.size(), to);
    return text;
}

/// The first case of a campaign file with this text.
inline scenario::Scenario scenario_of(std::string const& text = example_campaign) {
    return scenario::parse_campaign(text, "test.toml").cases.front();
}

}  // namespace vibrotrough
