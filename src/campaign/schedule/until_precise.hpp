#pragma once

#include "campaign/schedule/policy.hpp"

#include <map>
#include <string>

namespace vibrotrough::campaign {

/// Adds packings, or cycles to all packings, until the interval of the case is as narrow as
/// measure.half_width asks.
///
/// The work is done in rounds. All packings of a round have the same number of cycles, and the next round is
/// decided only when all of them have them, from these cycles alone. So the answer does not depend on which
/// packing happened to end first, and it can be found again from the files after a crash.
/// - The first round has measure.packings packings (one, or an even number) of 24 cycles, or fewer for wide
///   intervals (deck::first_round_cycles). They start in turn below and above the speed that the theory
///   predicts; those of later rounds below and above the mean so far. Clumps and blocks start at rest.
/// - While the case is not steady, all packings are continued to twice the number of cycles, up to
///   measure.max_cycles. If packings that started below and above still differ then, at least four of each
///   kind are run, and the case ends as bistable-or-slow.
/// - A steady case whose interval is too wide gets as many packings as it probably needs, at least 20 % more
///   and at most twice as many. It gets cycles instead where they cost less: where the packings hardly differ
///   by more than the fluctuations within a run explain, a longer run saves the start-up of another.
/// - Fewer than six packings are enough only when their interval is at most half as wide as asked.
/// - Where the interval would be narrow enough but for what is left of a start-up
///   (measure::CaseEstimate::drift), all packings are continued to twice the number of cycles. At
///   measure.max_cycles packings are added instead: together they know the start-up better.
/// - A case whose drive has stages has one round: measure.packings packings with all cycles of its stages.
/// - It ends when the interval is narrow enough, or as not-precise when measure.max_packings or
///   measure.max_core_time do not allow another round.
class UntilPrecise : public Policy {
  public:
    /// Half-widths wanted of single cases, by id, in place of measure.half_width.
    using HalfWidths = std::map<std::string, double>;

    /// @param half_widths  of single cases; all others as measure.half_width asks
    explicit UntilPrecise(HalfWidths half_widths = {}) : half_widths_(std::move(half_widths)) {}
    CaseDecision decide(KnownCase const& known) const override;

  private:
    HalfWidths half_widths_;
};

}  // namespace vibrotrough::campaign
