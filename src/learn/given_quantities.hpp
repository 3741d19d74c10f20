#pragma once

#include "learn/calibration.hpp"
#include "theory/drive.hpp"

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// Internal to this module.
namespace vibrotrough::learn {

/// The quantities of a model of measured speeds: some are free, some fixed, and angles may be measured.
class GivenQuantities {
  public:
    /// One number for each quantity of the model, in its order; what is not given is empty.
    using Values = std::vector<std::optional<double>>;

    /// @param known  the quantities of the model, with `inclination` and `vibration_angle` in degrees
    /// @param whose  names the model in errors, such as "the point mass"
    /// @throws core::InputError when a name is unknown or given twice, or a measurement has no vibration
    /// angle and none is given for all
    GivenQuantities(std::vector<std::string> const& free, std::map<std::string, double> const& fixed,
                    std::vector<FreeParameter> const& known, std::string_view whose,
                    std::vector<MeasuredSpeed> const& speeds);

    /// Whether a quantity is free or fixed.
    bool has(std::string const& name) const;
    bool is_free(std::string const& name) const;  ///< by a calibration
    /// With the values of the free quantities.
    Values at(std::span<double const> free) const;
    /// The machine of a measurement. A given inclination or vibration angle replaces the measured one; an
    /// inclination that is given nowhere is zero.
    theory::Drive drive(Values const& values, MeasuredSpeed const& measured) const;

  private:
    std::size_t index_of(std::string const& name) const;

    std::vector<FreeParameter> const& known_;
    Values fixed_;
    std::vector<std::size_t> free_;
};

}  // namespace vibrotrough::learn
