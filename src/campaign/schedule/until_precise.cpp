#include "campaign/schedule/until_precise.hpp"

#include "deck/estimates.hpp"
#include "evaluate/case.hpp"
#include "measure/case_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace vibrotrough::campaign {
namespace {

/// Packings of each kind of start with which two branches are reported.
constexpr int packings_per_branch = 4;
constexpr double least_growth = 1.2, most_growth = 2;

/// Velocity efficiencies at which packings start, relative to the one expected. In its first cycle a layer
/// whose grains all have the same speed gains about 0.13, so that these are 0.12 below and 0.18 above.
constexpr double below = -0.25, above = 0.05;

/// Starts are rounded, so that machines with different arithmetic start alike.
double rounded(double efficiency) {
    return std::round(1000 * efficiency) / 1000;
}

/// The state of the replay: packings with their starts, and the cycles that all of them have.
struct Round {
    std::vector<deck::PackingPlan> packings;
    int cycles;

    int count() const { return static_cast<int>(packings.size()); }
    double total() const { return static_cast<double>(packings.size()) * cycles; }
};

/// One decision about one case, from its first round to the one that is not complete.
class Replay {
  public:
    Replay(KnownCase const& known, std::optional<double> half_width)
        : known_(known),
          prepared_(*known.planned->prepared),
          whole_(half_width.value_or(prepared_.scenario.measure.half_width)),
          plan_(prepare::statistics_plan(prepared_.scenario, whole_)),
          wanted_{plan_.confidence, plan_.half_width} {}

    CaseDecision decide() {
        Round round{{}, first_cycles()};
        bool const is_exact = plan_.packings == 1 || has_given_length(prepared_.scenario);
        extend(round, is_exact ? plan_.packings : plan_.packings + plan_.packings % 2, predicted());
        while (true) {
            for (deck::PackingPlan& packing : round.packings) packing.cycles = round.cycles;
            auto const has_all = [&](deck::PackingPlan const& packing) { return is_enough(known_, packing); };
            if (!std::ranges::all_of(round.packings, has_all))
                return {round.packings, {}, 0, expected(round)};
            if (has_given_length(prepared_.scenario)) return finish(round);
            estimate_ = estimate(round);
            if (!advance(round)) return finish(round);
        }
    }

  private:
    /// Cycles of a packing in the first round.
    int first_cycles() const { return deck::first_round_cycles(prepared_.scenario); }

    /// The result, or the packings whose run was cut when its cycles were already enough.
    CaseDecision finish(Round const& round) const {
        CaseDecision decision{round.packings, {}, 0, round.total()};
        for (deck::PackingPlan const& packing : round.packings) {
            if (!known_.packings.at(packing.number).is_finished) return decision;
        }
        for (deck::PackingPlan const& packing : round.packings) decision.result.push_back(packing.number);
        decision.cycles = round.cycles;
        return decision;
    }

    /// The efficiency that the theory predicts; 0 where it has no answer.
    double predicted() const {
        if (!deck::may_start_moving(prepared_.scenario)) return 0;
        auto const motion = prepare::solve(prepared_.point_mass);
        return motion.converged ? motion.velocity_efficiency : 0;
    }

    void extend(Round& round, int packings, double expected) const {
        for (int number = round.count() + 1; number <= std::min(packings, plan_.max_packings); ++number) {
            deck::PackingPlan packing{number, round.cycles, {}, first_cycles()};
            if (deck::may_start_moving(prepared_.scenario) && plan_.max_packings > 1)
                packing.start_efficiency = start(number, expected);
            round.packings.push_back(packing);
        }
    }

    static std::optional<double> start(int number, double expected) {
        bool const is_below = evaluate::start_of(number) == measure::Start::below;
        double const wanted = rounded(expected + (is_below ? below : above));
        if (is_below && expected >= 0 && wanted <= 0) return {};  // at rest
        return wanted;
    }

    measure::CaseEstimate estimate(Round const& round) const {
        std::vector<measure::PackingValues> values;
        for (deck::PackingPlan const& packing : round.packings) {
            std::span const all(known_.packings.at(packing.number).efficiency);
            values.push_back(
                {all.first(static_cast<std::size_t>(round.cycles)), evaluate::start_of(packing.number)});
        }
        return measure::estimate_case(values, wanted_);
    }

    /// The next round; false when the case ends with this one.
    bool advance(Round& round) const {
        if (estimate_.steadiness != measure::Steadiness::steady) return settle(round);
        if (statistics() <= deck::trusted_half_width(round.count(), plan_, whole_))
            return wants_drift_removed() && (lengthen(round) || grow(round, packings_of_next_round(round)));
        if (round.count() >= plan_.max_packings) {
            double const longer = estimate_.half_width ? statistics() * narrowed_by(plan_.max_cycles) : 0;
            return longer <= wanted_.half_width && lengthen(round);
        }
        if (round.count() > 1 && longer_is_cheaper(round) && lengthen(round)) return true;
        return grow(round, packings_of_next_round(round));
    }

    /// The half-width without what is left of a start-up.
    double statistics() const {
        if (!estimate_.half_width) return std::numeric_limits<double>::infinity();
        return std::sqrt(std::max(0.0, std::pow(*estimate_.half_width, 2) - std::pow(estimate_.drift, 2)));
    }

    /// Whether what is left of a start-up makes an interval too wide that is narrow enough without it.
    bool wants_drift_removed() const { return !measure::is_precise(estimate_, wanted_); }

    /// For a case that is not steady: more cycles, and at the end enough packings to report both branches.
    bool settle(Round& round) const {
        if (lengthen(round)) return true;
        bool const shows_branches = round.count() >= 2 * packings_per_branch;
        if (estimate_.steadiness == measure::Steadiness::drifting || shows_branches) return false;
        return grow(round, 2 * packings_per_branch);
    }

    int packings_of_next_round(Round const& round) const {
        double const count = round.count();
        double const needed = measure::packings_needed(estimate_, wanted_).value_or(1);
        double const most = std::max(most_growth * count, count + 2);
        int const next = static_cast<int>(
            std::ceil(std::clamp(needed, std::min(most, std::max(least_growth * count, count + 2)), most)));
        return next + next % 2;
    }

    bool grow(Round& round, int packings) const {
        int const target = std::min(packings, plan_.max_packings);
        if (target <= round.count() || !is_affordable(round, (target - round.count()) * round.cycles))
            return false;
        extend(round, target, estimate_.mean.value_or(0));
        return true;
    }

    int lengthened(Round const& round) const { return std::min(2 * round.cycles, plan_.max_cycles); }

    bool lengthen(Round& round) const {
        int const cycles = lengthened(round);
        if (cycles <= round.cycles || !is_affordable(round, (cycles - round.cycles) * round.count()))
            return false;
        round.cycles = cycles;
        return true;
    }

    /// Whether the case will probably be precise with fewer cycles in all when its packings are continued
    /// than when others are added. What is left of a start-up goes away with longer packings only.
    bool longer_is_cheaper(Round const& round) const {
        if (estimate_.drift >= wanted_.half_width) return true;
        if (!can_be_precise()) return longer_tells_more(round);
        int const cycles = lengthened(round);
        int const more = std::max(round.count() + 2, packings_with(1));
        int const as_many = std::max(round.count(), packings_with(narrowed_by(cycles)));
        return as_many * cycles < more * round.cycles;
    }

    /// Packings that are enough where the deviation of one is changed by a factor, at most max_packings.
    int packings_with(double factor) const {
        return deck::expected_packings(plan_, whole_,
                                       {.deviation = factor * estimate_.deviation.value_or(0)});
    }

    /// Whether the largest number of packings and cycles is probably enough.
    bool can_be_precise() const {
        measure::CaseEstimate longest = estimate_;
        longest.deviation = narrowed_by(plan_.max_cycles) * estimate_.deviation.value_or(0);
        return measure::packings_needed(longest, wanted_).value_or(1) <= plan_.max_packings;
    }

    /// Twice the cycles cost as much as twice the packings. They leave the variance b + w (L - s) / (2 L - s)
    /// of a packing's mean, with the part b that runs do not share, the part w of the fluctuations, the
    /// length L and the start-up s, where twice the packings leave the equivalent of (b + w) / 2.
    bool longer_tells_more(Round const& round) const {
        double const within = std::pow(estimate_.deviation_within, 2);
        double const between = std::max(0.0, std::pow(estimate_.deviation.value_or(0), 2) - within);
        double const startup = estimate_.discarded;
        return between < within * startup / (2 * round.cycles - startup);
    }

    /// The factor by which the deviation of a packing will probably change with so many cycles: the part of
    /// the fluctuations within a run goes with the root of the cycles kept, that between packings stays.
    double narrowed_by(int cycles) const {
        double const total = std::pow(estimate_.deviation.value_or(0), 2);
        if (total == 0) return 1;
        double const within = std::pow(estimate_.deviation_within, 2);
        double const longer = within * estimate_.measured / (cycles - estimate_.discarded);
        return std::sqrt((std::max(0.0, total - within) + longer) / total);
    }

    /// Whether measure.max_core_time allows so many cycles more than those of a round. What was spent on
    /// later rounds does not count, so that the answer stays the same when they have been run.
    bool is_affordable(Round const& round, int more_cycles) const {
        if (!plan_.max_core_time) return true;
        double spent = 0;
        for (deck::PackingPlan const& wanted : round.packings) {
            KnownPacking const& packing = known_.packings.at(wanted.number);
            spent += packing.core_time * round.cycles / static_cast<double>(packing.efficiency.size());
        }
        return spent * (1 + more_cycles / round.total()) <= *plan_.max_core_time;
    }

    /// Cycles in the end: of this round, whose packings are not all there, and of those that will probably
    /// follow.
    double expected(Round const& round) const {
        int const packings = deck::expected_packings(plan_, whole_, experience());
        return std::max(round.count(), packings) * static_cast<double>(round.cycles);
    }

    deck::Experience experience() const {
        deck::Experience experience;
        experience.deviation = estimate_.deviation.value_or(experience.deviation);
        return experience;
    }

    KnownCase const& known_;
    prepare::PreparedCase const& prepared_;
    double whole_;                    ///< half-width wanted of statistics and numerics together
    scenario::MeasurementPlan plan_;  ///< with the half-width that is left to statistics
    measure::Precision wanted_;       ///< of the statistics
    measure::CaseEstimate estimate_;  ///< of the last complete round
};

}  // namespace

CaseDecision UntilPrecise::decide(KnownCase const& known) const {
    auto const given = half_widths_.find(known.planned->id);
    return Replay(known, given == half_widths_.end() ? std::nullopt : std::optional(given->second)).decide();
}

}  // namespace vibrotrough::campaign
