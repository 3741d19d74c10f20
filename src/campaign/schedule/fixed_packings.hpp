#pragma once

#include "campaign/schedule/policy.hpp"

namespace vibrotrough::campaign {

/// Every case has as many packings as measure.packings says, and no case is added.
class FixedPackings : public Policy {
  public:
    CaseDecision decide(KnownCase const& known) const override;
};

}  // namespace vibrotrough::campaign
