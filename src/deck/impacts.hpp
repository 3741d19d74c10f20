#pragma once

#include "core/template.hpp"
#include "prepare/prepared_case.hpp"

#include <string>

/// @file
/// How the contacts are watched for impacts (measure.impacts): all of them are written every few steps during
/// the last cycles of the first round, which every packing has.

namespace vibrotrough::deck {

/// The cycles in which the contacts are watched.
struct WatchedCycles {
    int from;  ///< cycles that are done when it begins
    int to;    ///< and when it ends
};

/// Two cycles, because layers often repeat only after two.
WatchedCycles watched_cycles(scenario::Scenario const& scenario);

/// Steps from one list of the contacts to the next: a divisor of the cycle, and at most a fifth of the
/// duration of the fastest impact that is expected, so that the first two lists of an impact are in its
/// approach. Slower impacts take longer.
int steps_between_lists(prepare::TimeGrid const& time);

/// Names of the files of a watched cycle, which begins when so many are done.
std::string grain_contacts_file(int done);
std::string floor_contacts_file(int done);  ///< of grains with the trough
std::string masses_file(int done);          ///< number, type, radius and mass of all grains

/// Sets the data of the template `impacts`.
void describe_impacts(core::TemplateData& data, prepare::PreparedCase const& prepared);

/// Bytes of these files, which are removed when the packing has ended.
double watched_bytes(prepare::PreparedCase const& prepared, double spheres);

}  // namespace vibrotrough::deck
