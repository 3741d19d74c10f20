#pragma once

#include "prepare/prepared_case.hpp"

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vibrotrough::prepare {

/// A setting on which results should depend as little as possible.
enum class NumericalSetting {
    youngs_modulus,   ///< of grains and trough, softer than in reality
    time_step,        ///< of the engine
    length,           ///< of the periodic box along the trough
    width,            ///< of the periodic box across the trough
    block_stiffness,  ///< of the contact of a rigid block
};

/// The setting's name in files, such as "youngs_modulus".
std::string_view name_of(NumericalSetting setting);
/// The setting's name for people, such as "Young's modulus".
std::string_view title_of(NumericalSetting setting);
/// The key of the campaign file that changes it.
std::string_view key_of(NumericalSetting setting);
/// The unit of its values: "Pa", "m", or "1".
std::string_view unit_of(NumericalSetting setting);

/// A case that differs from another in one numerical setting.
struct NumericalVariation {
    double value;                 ///< of the setting's key, SI
    double coarseness;            ///< distance from the limit: 1 at the default, 0 at the limit
    scenario::Scenario scenario;  ///< the case
};

/// One numerical setting of a case and its variations towards the limit.
struct VariedSetting {
    NumericalSetting setting;                         ///< which
    double value;                                     ///< its default, SI
    std::optional<double> order;                      ///< of the error in the coarseness, if it is known
    std::vector<NumericalVariation> variations = {};  ///< with decreasing coarseness; none when left out
    std::string left_out = {};                        ///< why there are no variations
    /// Half-width of the setting's error that is known beforehand (numerical_errors), infinite when it is
    /// not. That of the box is shared by its length and its width, so that both together have all of it.
    double expected = std::numeric_limits<double>::infinity();
};

/// The variations by which the numerical error of a case is measured.
///
/// - Young's modulus times 4 and 16. The overlaps at impact and the contact times go with E^(-2/5) (Johnson,
///   Contact Mechanics, 1985, section 11.4). This is the coarseness, and the error is taken to be of first
///   order in it. The energy density of a cohesion grows with it such that the pull-off force stays.
/// - Half the time step. It is set by solver.rayleigh_fraction to half the fraction that the case really
///   uses, which may be below the one asked for.
/// - Twice the length and twice the width of the periodic box, with the same height of the layer. Their order
///   is not known.
/// - A rigid block has no periodic layer and no Young's modulus: instead the stiffness of its contact times 2
///   and 4, with an error of first order in the contact's duration. Its time step follows from the contact.
///
/// A setting is left out when it is part of the problem (the width between side walls) or when its variation
/// is not allowed by the key's range.
std::vector<VariedSetting> vary_numerics(PreparedCase const& prepared);

}  // namespace vibrotrough::prepare
