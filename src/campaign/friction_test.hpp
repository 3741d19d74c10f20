#pragma once

#include "campaign/state/plan.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

// The virtual friction test (Sloot & Kruyt, Powder Technology 87, 1996, section 6 and Fig. 8): a layer on a
// level trough that shakes along itself; the largest way that it slides tells the friction of the layer as a
// whole, which rolls and shears, not of its grains.
namespace vibrotrough::campaign {

/// What the test of one layer says.
struct LayerFriction {
    std::string layer;      ///< layer_key() of the scenario
    std::string case_id;    ///< of the test
    double grain_friction;  ///< mu, grain on trough, that was put in
    double machine_number;  ///< K
    /// Largest displacement of the layer against the trough in a cycle, in amplitudes, mean over the
    /// packings, and the half-width of its confidence interval.
    std::optional<double> displacement, half_width;
    double creep = 0;                           ///< of it, per cycle, in amplitudes
    std::optional<double> friction, low, high;  ///< the layer's mu with its interval
    std::string mode;     ///< of the theory at that mu; the layer's own mode is in the test's campaign
    std::string message;  ///< why there is no number, or what to think of it
};

/// K when none is asked for: the paper's 0.67, or a fifth more than what makes a point mass with the largest
/// grain friction slide both ways without a rest, K > mu sqrt(1 + pi^2 / 4).
double default_machine_number(scenario::Campaign const& campaign);

/// Measures the tests that are finished.
/// @param plan  of a campaign made by shake_test_campaign and run
std::vector<LayerFriction> measure_friction(Plan const& plan);

/// Where `compare` looks for the tests' results: DIR/friction.json.
std::filesystem::path friction_file(std::filesystem::path const& campaign_folder);

/// @throws MissingError when the disk refuses
void write_friction(std::filesystem::path const& campaign_folder, std::vector<LayerFriction> const& tests);

/// The tests that gave a number, by layer_key(); none when there is no file.
/// @throws InputError when the file is damaged
std::map<std::string, LayerFriction> read_friction(std::filesystem::path const& campaign_folder);

}  // namespace vibrotrough::campaign
