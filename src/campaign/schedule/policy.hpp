#pragma once

#include "campaign/state/case_state.hpp"
#include "campaign/state/plan.hpp"
#include "deck/deck.hpp"
#include "store/case_record.hpp"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vibrotrough::campaign {

/// What is known of one case when a policy is asked.
struct KnownCase {
    PlannedCase const* planned;               ///< the case
    KnownPackings packings;                   ///< those of which something is known, by number
    std::optional<store::CaseRecord> result;  ///< its summary, when the case has a result
    std::optional<core::Outcome> failure;     ///< when it failed
};

/// What a policy says about one case.
struct CaseDecision {
    /// Packings that the case needs, in the order in which they are wanted; finished ones may be among them.
    std::vector<deck::PackingPlan> wanted;
    /// The packings that the result is made of, once they are enough; empty while they are not.
    std::vector<int> result = {};
    int cycles = 0;       ///< of each of these packings, from the first, that the result is made of
    double expected = 0;  ///< cycles of all packings that the case will probably have had in the end
};

/// Answers one question: given what is known, which packings and cases come next, and which are enough?
///
/// A policy knows no executor: whether packings run on this machine or on a cluster makes no difference to
/// it. It has no memory of its own either, so that after a crash its next answer follows from the files
/// alone. The same knowledge must always give the same answer; to make results independent of the order in
/// which packings happen to end, a policy should decide on packings 1 ... n only when all of them are
/// finished.
class Policy {
  public:
    virtual ~Policy() = default;

    /// Decides about a case that has not failed. Each answer must either name a result or want a packing that
    /// is_done() does not find.
    virtual CaseDecision decide(KnownCase const& known) const = 0;

    /// Cases that the campaign should have beside those that it has. Asked at the start of a run and after
    /// each case that ends; cases that exist already are ignored.
    virtual std::vector<scenario::Scenario> further_cases(std::vector<KnownCase const*> const& known) const {
        static_cast<void>(known);
        return {};
    }
};

/// Whether a packing has the cycles that are wanted of it.
bool is_enough(KnownCase const& known, deck::PackingPlan const& wanted);

/// Whether it has them, and its run has ended.
bool is_done(KnownCase const& known, deck::PackingPlan const& wanted);

/// Half-widths wanted of single cases, by id, in place of measure.half_width.
using HalfWidths = std::map<std::string, double>;

/// The policy that a campaign asks for: the only place that chooses one.
std::unique_ptr<Policy> make_policy(HalfWidths half_widths = {});

/// What the files say of a case, for a policy. Reads the cycles of finished packings.
KnownCase know(PlannedCase const& planned);

}  // namespace vibrotrough::campaign
