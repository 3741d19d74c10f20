#include "campaign/schedule/policy.hpp"

#include "campaign/schedule/fixed_packings.hpp"

namespace vibrotrough::campaign {

std::unique_ptr<Policy> make_policy() {
    return std::make_unique<FixedPackings>();
}

KnownCase know(PlannedCase const& planned) {
    KnownCase known{&planned, read_estimates(planned), {}, {}};
    if (auto const failure = read_failure(planned)) known.failure = failure->outcome;
    return known;
}

}  // namespace vibrotrough::campaign
