#include "campaign/schedule/fixed_packings.hpp"

#include <algorithm>
#include <numeric>

namespace vibrotrough::campaign {

CaseDecision FixedPackings::decide(KnownCase const& known) const {
    std::vector<int> all(static_cast<std::size_t>(known.planned->scenario().measure.packings));
    std::iota(all.begin(), all.end(), 1);
    bool const is_enough =
        std::ranges::all_of(all, [&](int packing) { return known.finished.contains(packing); });
    return {all, is_enough ? all : std::vector<int>{}};
}

}  // namespace vibrotrough::campaign
