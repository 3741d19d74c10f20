#pragma once

#include "core/outcome.hpp"
#include "store/case_record.hpp"

#include <optional>
#include <vector>

/// @file
/// The largest feed that an open trough carries away, found by trying feeds.

namespace vibrotrough::learn {

/// A feed that was tried.
struct FeedTrial {
    double mass_flow;  ///< kg/s, > 0
    bool is_carried;   ///< whether what is fed also leaves; else the trough fills ever more
};

/// Whether a case shows that its feed is not carried away: the layer reached the feed; more than 3 % of what
/// was to be fed found no room; or the case is not steady and less left the trough than was fed, by more than
/// chance explains (evaluate::unsteady_flow). A case that is not steady for another reason, such as a speed
/// that drifts, does not show it.
/// @param record  of the case; nullptr when it has none
bool is_overfed(core::Outcome outcome, store::CaseRecord const* record);

/// What the trials say of the capacity: it lies between the two. Either is missing while no trial shows it.
struct CapacityBounds {
    std::optional<double> carried;  ///< kg/s, the largest feed that was carried below all that were not
    std::optional<double> refused;  ///< kg/s, the smallest feed that was not carried
    /// kg/s, a feed that was carried although a smaller one was not: near the capacity, the answer depends on
    /// chance.
    std::optional<double> contradiction;
};

/// What trials in any order say.
CapacityBounds capacity_bounds(std::vector<FeedTrial> const& trials);

/// The feed to try next: `first`; twice the largest that was carried, or half of the smallest that was not,
/// until one of each is known; then their geometric mean.
/// @param first      kg/s, > 0
/// @param precision  of the answer, > 0: there is none to try when `refused` is at most so much larger than
///                   `carried`, as a share of it
/// @return kg/s, rounded to three digits when that leaves it between the two; nothing when the capacity is
///         known, or when twelve feeds in a row were all carried or all refused
std::optional<double> next_feed(std::vector<FeedTrial> const& trials, double first, double precision);

}  // namespace vibrotrough::learn
