#pragma once

#include "prepare/prepared_case.hpp"
#include "store/case_record.hpp"

#include <filesystem>
#include <optional>
#include <string>

// The virtual friction test (Sloot & Kruyt, Powder Technology 87, 1996, section 3.5 and Fig. 8): a layer on a
// level trough that shakes along itself. The largest distance that it slides gives the friction of the layer
// as a whole, which rolls and shears, as opposed to the friction of its grains.
namespace vibrotrough::evaluate {

/// The result of the test of one layer.
struct LayerFriction {
    std::string layer;      ///< layer_key() of the scenario
    std::string case_id;    ///< of the test
    double grain_friction;  ///< mu, grain on trough, that was put in
    double machine_number;  ///< K
    /// Largest displacement of the layer relative to the trough in a cycle, in amplitudes, mean over the
    /// packings, and the half-width of its confidence interval.
    std::optional<double> displacement, half_width;
    double creep = 0;                           ///< displacement per cycle, in amplitudes
    std::optional<double> friction, low, high;  ///< the layer's mu with its interval
    std::string mode;                           ///< of the theory at that mu
    std::string message;                        ///< why there is no number, or what to be aware of
};

/// Measures a test whose case has a result.
/// @param case_folder  holds the packings' folders packing-1, packing-2 ...
/// @throws core::InputError when a packing's files are damaged, core::MissingError when they are missing
LayerFriction evaluate_friction_test(prepare::PreparedCase const& prepared, std::string const& case_id,
                                     store::CaseRecord const& record,
                                     std::filesystem::path const& case_folder);

/// A test without a number: identity of layer and case, and why.
LayerFriction failed_friction_test(prepare::PreparedCase const& prepared, std::string const& case_id,
                                   std::string const& why);

/// K when none is asked for: the paper's 0.67, or a fifth more than what makes a point mass with this
/// friction slide both ways without a rest, K > mu sqrt(1 + pi^2 / 4).
double default_machine_number(double largest_friction);

}  // namespace vibrotrough::evaluate
