#pragma once

#include "scenario/reader/case_values.hpp"

#include <optional>
#include <string>
#include <vector>

namespace vibrotrough::scenario {

/// A list of points: values of some keys that are varied together, from zipped lists, explicit points, a CSV
/// file or a sample. A campaign runs the Cartesian product of its sweep and all its lists.
struct PointList {
    std::vector<std::string> keys;           ///< paths of the keys
    std::vector<std::vector<Value>> points;  ///< one row per point with one value per key
    Position where;                          ///< of the section in the campaign file
};

/// The range of a key in the domain of a surface that is learnt.
struct DomainAxis {
    std::string key;   ///< path of the key, whose values are numbers
    double low, high;  ///< ends of the range, SI units

    /// The value at a fraction of the range; a whole number where the key needs one.
    double at(double fraction) const;
};

/// A condition on one key. All bounds that are set must hold.
struct Condition {
    std::string key;                     ///< path of the key
    std::optional<double> above, below;  ///< bounds, SI units; the value itself is not included
    std::optional<Content> equals;       ///< the value; numbers may differ from it by a relative 1e-9
    Position where;                      ///< in the campaign file
};

/// Cases for which all these conditions hold are left out.
using Exclusion = std::vector<Condition>;

/// Sets a key, and removes the key that it excludes.
void set_value(CaseValues& values, std::string const& key, Value const& value);

/// The value that a case has for a key: given, derived from others (such as the throw number of a drive whose
/// frequency was given), or the default. Numbers are in SI units; nullopt when the case has no such value.
/// @param key  path of a key that can be varied
std::optional<Content> value_of(Scenario const& scenario, CaseValues const& given, std::string_view key);

/// Whether at least one of the exclusions applies to the case. A condition on a key without value does not
/// hold.
bool is_excluded(Scenario const& scenario, CaseValues const& given, std::vector<Exclusion> const& exclusions);

}  // namespace vibrotrough::scenario
