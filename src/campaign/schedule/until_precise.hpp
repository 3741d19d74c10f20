#pragma once

#include "campaign/schedule/policy.hpp"

#include <utility>

namespace vibrotrough::campaign {

/// Adds packings, or cycles to all packings, until the interval of the case is as narrow as
/// measure.half_width asks.
///
/// The work is done in rounds (src/manual/measured.md). All packings of a round have the same number of
/// cycles, and the next round is decided only when all of them have them, from these cycles alone. So the
/// answer does not depend on which packing happened to end first, and it can be found again from the files
/// after a crash.
class UntilPrecise : public Policy {
  public:
    /// @param half_widths  of single cases; all others as measure.half_width asks
    explicit UntilPrecise(HalfWidths half_widths = {}) : half_widths_(std::move(half_widths)) {}
    CaseDecision decide(KnownCase const& known) const override;

  private:
    HalfWidths half_widths_;
};

}  // namespace vibrotrough::campaign
