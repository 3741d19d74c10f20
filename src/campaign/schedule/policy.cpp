#include "campaign/schedule/policy.hpp"

#include "campaign/schedule/until_precise.hpp"

namespace vibrotrough::campaign {

std::unique_ptr<Policy> make_policy(HalfWidths half_widths) {
    return std::make_unique<UntilPrecise>(std::move(half_widths));
}

bool is_enough(KnownCase const& known, deck::PackingPlan const& wanted) {
    auto const found = known.packings.find(wanted.number);
    return found != known.packings.end() &&
           found->second.efficiency.size() >= static_cast<std::size_t>(wanted.cycles);
}

bool is_done(KnownCase const& known, deck::PackingPlan const& wanted) {
    return is_enough(known, wanted) && known.packings.at(wanted.number).is_finished;
}

KnownCase know(PlannedCase const& planned) {
    KnownCase known{&planned, read_known_packings(planned), {}, {}};
    if (auto const failure = read_failure(planned)) known.failure = failure->outcome;
    return known;
}

}  // namespace vibrotrough::campaign
