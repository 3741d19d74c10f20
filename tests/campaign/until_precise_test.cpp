#include "campaign/schedule/until_precise.hpp"

#include "campaign_folder.hpp"
#include "simulated_case.hpp"

#include <algorithm>
#include <map>
#include <numeric>

namespace vibrotrough::campaign {
namespace {

/// A case of which packings are made up; the half-width wanted and the limits can be set.
class UntilPreciseTest : public CampaignFolder {
  protected:
    PlannedCase asking(double half_width, int packings = 4, int max_packings = 24, int max_cycles = 192) {
        prepare::PreparedCase prepared = *planned.prepared;
        remove_numerical_errors(prepared.scenario);
        prepared.scenario.measure = {packings, 0.95, half_width, max_cycles, max_packings, {}};
        PlannedCase changed = planned;
        changed.prepared = std::make_shared<prepare::PreparedCase const>(prepared);
        return changed;
    }

    /// The packings of a process by number, always the same for one seed, times `scale`.
    static auto packings_of(Process const& process, unsigned seed, double scale = 1) {
        return [process, seed, scale, made = std::map<int, std::vector<double>>()](
                   int number) mutable -> std::vector<double> const& {
            auto& values = made[number];
            if (values.empty()) {
                std::mt19937 random(1000 * seed + static_cast<unsigned>(number));
                values = process.make(200, random);
                for (double& value : values) value *= scale;
            }
            return values;
        };
    }

    UntilPrecise policy;
};

TEST_F(UntilPreciseTest, BeginsWithTheLeastNumberOfPackingsRoundedUpToPairs) {
    for (auto const& [asked, wanted] : {std::pair{1, 1}, {2, 2}, {3, 4}, {4, 4}, {7, 8}}) {
        PlannedCase const one = asking(0.02, asked);
        CaseDecision const decision = policy.decide({&one, {}, {}, {}});
        EXPECT_EQ(static_cast<int>(decision.wanted.size()), wanted);
        EXPECT_TRUE(decision.result.empty());
        for (auto const& packing : decision.wanted) EXPECT_EQ(packing.cycles, 24);
    }
    PlannedCase const short_runs = asking(0.02, 4, 24, 20);
    EXPECT_EQ(policy.decide({&short_runs, {}, {}, {}}).wanted.front().cycles, 20);
    PlannedCase const few = asking(0.02, 3, 3);
    EXPECT_EQ(policy.decide({&few, {}, {}, {}}).wanted.size(), 3u);
}

// 1.35 / half_width cycles, from 18 to 24; 24 for a single packing, whose interval needs 20, and from rest.
TEST_F(UntilPreciseTest, WideIntervalsNeedShorterPackings) {
    auto const first_cycles = [&](PlannedCase const& one) {
        return policy.decide({&one, {}, {}, {}}).wanted.front().cycles;
    };
    for (auto const& [half_width, cycles] :
         {std::pair{0.001, 24}, {0.05, 24}, {0.056, 24}, {0.0675, 20}, {0.075, 18}, {1.0, 18}})
        EXPECT_EQ(first_cycles(asking(half_width)), cycles) << half_width;
    EXPECT_EQ(first_cycles(asking(0.5, 1)), 24);
    EXPECT_EQ(first_cycles(asking(0.5, 4, 24, 12)), 12) << "max_cycles";
    PlannedCase cubes = asking(0.5);
    prepare::PreparedCase prepared = *cubes.prepared;
    prepared.scenario.grains.shape = "cube";
    cubes.prepared = std::make_shared<prepare::PreparedCase const>(prepared);
    EXPECT_EQ(first_cycles(cubes), 24);
}

// Odd packings start 0.25 below the expected efficiency (at rest if that is below zero), even ones 0.05
// above.
TEST_F(UntilPreciseTest, StartsInTurnBelowAndAboveTheExpectedSpeed) {
    PlannedCase const one = asking(0.02);
    double const theory = prepare::solve(one.prepared->point_mass).velocity_efficiency;
    auto const first = policy.decide({&one, {}, {}, {}}).wanted;
    ASSERT_TRUE(first[1].start_efficiency);
    EXPECT_NEAR(*first[1].start_efficiency, theory + 0.05, 0.0005);  // rounded to 0.001
    EXPECT_NEAR(first[0].start_efficiency.value_or(0), std::max(0.0, theory - 0.25), 0.0005);
    // The packings that are added start about the mean so far, which is 0.8 here.
    KnownCase known{&one, {}, {}, {}};
    for (int number = 1; number <= 4; ++number) {
        double const own = 0.8 + 0.05 * (number <= 2 ? 1 : -1);
        known.packings[number] = {std::vector<double>(24, own), 1, true};
    }
    auto const second = policy.decide(known).wanted;
    ASSERT_GE(second.size(), 6u);
    EXPECT_EQ(second[4].start_efficiency.value(), 0.55);
    EXPECT_EQ(second[5].start_efficiency.value(), 0.85);
    EXPECT_EQ(second[0].start_efficiency, first[0].start_efficiency);
}

TEST_F(UntilPreciseTest, ClumpsStartAtRest) {
    prepare::PreparedCase prepared = *planned.prepared;
    prepared.scenario.grains.shape = "cube";
    PlannedCase cubes = planned;
    cubes.prepared = std::make_shared<prepare::PreparedCase const>(prepared);
    for (auto const& packing : policy.decide({&cubes, {}, {}, {}}).wanted)
        EXPECT_FALSE(packing.start_efficiency) << packing.number;
}

// The answer follows from the files: whatever subset of the wanted packings is there, the others are wanted
// with the same starts and cycles.
TEST_F(UntilPreciseTest, DoesNotDependOnTheOrderInWhichPackingsEnd) {
    PlannedCase const one = asking(0.3);
    auto series = packings_of({.rho = 0.5}, 5);
    KnownCase known{&one, {}, {}, {}};
    std::mt19937 random(1);
    CaseDecision decision = policy.decide(known);
    while (decision.result.empty()) {
        std::vector<deck::PackingPlan> missing;
        for (auto const& packing : decision.wanted)
            if (!is_enough(known, packing)) missing.push_back(packing);
        ASSERT_FALSE(missing.empty());
        auto const& done = missing[random() % missing.size()];
        auto const& all = series(done.number);
        known.packings[done.number] = {{all.begin(), all.begin() + done.cycles}, 1, true};
        CaseDecision const next = policy.decide(known);
        if (missing.size() > 1) {
            ASSERT_EQ(next.wanted.size(), decision.wanted.size());
            for (std::size_t i = 0; i < next.wanted.size(); ++i) {
                EXPECT_EQ(next.wanted[i].cycles, decision.wanted[i].cycles);
                EXPECT_EQ(next.wanted[i].start_efficiency, decision.wanted[i].start_efficiency);
            }
        }
        decision = next;
    }
    SimulatedEnd const straight = simulate_case(policy, one, packings_of({.rho = 0.5}, 5));
    EXPECT_EQ(decision.result.size(), static_cast<std::size_t>(straight.estimate.packings));
    EXPECT_EQ(decision.cycles, straight.cycles);
}

// Packings that start below stay at 0.20, those above at 0.30: no number of cycles makes them agree.
TEST_F(UntilPreciseTest, ReportsBothBranchesOfABistableCase) {
    PlannedCase const one = asking(0.02);
    std::map<int, std::vector<double>> made;
    auto const series = [&](int number) -> std::vector<double> const& {
        std::mt19937 random(static_cast<unsigned>(number));
        std::normal_distribution<double> noise(number % 2 == 1 ? 0.2 : 0.3, 0.01);
        for (int i = 0; made[number].size() < 200; ++i) made[number].push_back(noise(random));
        return made[number];
    };
    SimulatedEnd const end = simulate_case(policy, one, series);
    EXPECT_EQ(end.outcome, core::Outcome::bistable_or_slow);
    EXPECT_EQ(end.cycles, 192) << "first as many cycles as allowed";
    EXPECT_GE(end.estimate.packings, 8) << "four of each branch";
    ASSERT_TRUE(end.estimate.below && end.estimate.above);
    EXPECT_NEAR(end.estimate.below->mean, 0.2, 0.002);  // noise of 0.01 over 4 x 150 cycles
    EXPECT_NEAR(end.estimate.above->mean, 0.3, 0.002);
}

TEST_F(UntilPreciseTest, ContinuesPackingsThatStillDrift) {
    PlannedCase const one = asking(0.02);
    std::map<int, std::vector<double>> made;
    auto const drifting = [&](double limit) {
        return [&made, limit](int number) -> std::vector<double> const& {
            std::mt19937 random(static_cast<unsigned>(number));
            std::normal_distribution<double> noise(0, 0.005);
            for (int i = 0; made[number].size() < 768; ++i)
                made[number].push_back(std::min(limit, 0.01 * i) + noise(random));
            return made[number];
        };
    };
    // A drift that ends after 40 cycles; decays as slow as c / i are excluded only when it is long over.
    SimulatedEnd const ends = simulate_case(policy, asking(0.02, 4, 24, 768), drifting(0.4));
    EXPECT_EQ(ends.outcome, core::Outcome::finished);
    EXPECT_GE(ends.cycles, 96);
    EXPECT_NEAR(*ends.estimate.mean, 0.4, 0.01);
    made.clear();
    SimulatedEnd const never = simulate_case(policy, one, drifting(100));
    EXPECT_EQ(never.outcome, core::Outcome::not_steady);
    EXPECT_EQ(never.cycles, 192);
}

// All packings fall by the decay 0.1 exp(-i / 12) and differ by -a, -a, a, a with a = 0.002, so that the
// statistics of four are t(0.9875; 3) a sqrt(4/3) / 2 = 4.177 x 0.002309 / 2 = 0.0048 and less than half of
// 0.02. Of 24 cycles, 12 are left out; 0.1 exp(-1) (1 - exp(-1)) = 0.023 is left in the mean of the others,
// and the packings are continued.
TEST_F(UntilPreciseTest, ContinuesPackingsInWhoseMeanAStartUpIsLeft) {
    PlannedCase const one = asking(0.02);
    std::map<int, std::vector<double>> made;
    auto const series = [&made](int number) -> std::vector<double> const& {
        for (int i = 0; made[number].size() < 200; ++i)
            made[number].push_back(0.5 + 0.1 * std::exp(-i / 12.0) + (number % 4 < 2 ? -0.002 : 0.002));
        return made[number];
    };
    SimulatedEnd const end = simulate_case(policy, one, series);
    EXPECT_EQ(end.outcome, core::Outcome::finished);
    EXPECT_GE(end.cycles, 48);
    EXPECT_EQ(end.estimate.packings, 4);
    EXPECT_LE(std::abs(*end.estimate.mean - 0.5), *end.estimate.half_width);
}

// Means of -a, a, -a, a, where starts make no difference: the interval of four is t(0.9875; 3) a sqrt(4/3) /
// 2 = 2.41 a. It is trusted where it is at most half of 0.02: for a = 0.004, not for a = 0.005.
TEST_F(UntilPreciseTest, FourPackingsAreEnoughOnlyWithHalfOfTheHalfWidth) {
    PlannedCase const one = asking(0.02);
    for (auto const& [apart, packings] : {std::pair{0.004, 4}, {0.005, 6}}) {
        std::map<int, std::vector<double>> made;
        auto const series = [&made, apart = apart](int number) -> std::vector<double> const& {
            for (int i = 0; made[number].size() < 200; ++i)
                made[number].push_back(0.5 + (number % 4 < 2 ? -apart : apart) + (i % 2 == 0 ? 1e-4 : -1e-4));
            return made[number];
        };
        SimulatedEnd const end = simulate_case(policy, one, series);
        EXPECT_EQ(end.outcome, core::Outcome::finished);
        EXPECT_EQ(end.cycles, 24);
        EXPECT_EQ(end.estimate.packings, packings) << apart;
    }
    SimulatedEnd const limited = simulate_case(policy, asking(0.02, 4, 4), packings_of({}, 3, 0.01));
    EXPECT_EQ(limited.outcome, core::Outcome::finished) << "where no more are allowed, four must do";
}

TEST_F(UntilPreciseTest, EndsAsNotPreciseAtTheLimits) {
    PlannedCase const few = asking(0.02, 4, 10);
    SimulatedEnd const end = simulate_case(policy, few, packings_of({}, 3));
    EXPECT_EQ(end.outcome, core::Outcome::not_precise);
    EXPECT_EQ(end.estimate.packings, 10);
    auto const needed = measure::packings_needed(end.estimate, {0.95, 0.02});
    ASSERT_TRUE(needed);
    // Independent cycles without offsets are continued to 192 cycles, which are cheaper than more packings.
    // The mean of 190 of them has the deviation 0.073: (2.1 x 0.073 / 0.02)^2 = 59 packings, known to a
    // factor of two from ten.
    EXPECT_EQ(end.cycles, 192);
    EXPECT_GT(*needed, 30);
    EXPECT_LT(*needed, 120);

    // One second per packing: four packings are affordable, six are not.
    PlannedCase limited = asking(0.02);
    prepare::PreparedCase prepared = *limited.prepared;
    prepared.scenario.measure.max_core_time = 5;
    limited.prepared = std::make_shared<prepare::PreparedCase const>(prepared);
    SimulatedEnd const cheap = simulate_case(policy, limited, packings_of({}, 3));
    EXPECT_EQ(cheap.outcome, core::Outcome::not_precise);
    EXPECT_EQ(cheap.estimate.packings, 4);
}

// What later rounds cost does not change the decision that led to them.
TEST_F(UntilPreciseTest, TheLimitOfCoreTimeGivesTheSameAnswerLater) {
    PlannedCase limited = asking(0.02);
    prepare::PreparedCase prepared = *limited.prepared;
    prepared.scenario.measure.max_core_time = 9;
    prepared.scenario.measure.max_cycles = 24;
    limited.prepared = std::make_shared<prepare::PreparedCase const>(prepared);
    SimulatedEnd const end = simulate_case(policy, limited, packings_of({.offset = 3}, 3));
    EXPECT_EQ(end.outcome, core::Outcome::not_precise);
    EXPECT_EQ(end.estimate.packings, 8) << "twice the first four; sixteen would take 16 s";
}

// A packing that was cut while it was being continued counts with the cycles up to its checkpoint, but a
// result is made of finished ones only.
TEST_F(UntilPreciseTest, WantsPackingsThatWereCutAfterTheirLastCycle) {
    PlannedCase const one = asking(0.5);
    KnownCase known{&one, {}, {}, {}};
    for (int number = 1; number <= 4; ++number)
        known.packings[number] = {std::vector<double>(24, 0.8), 1, true};
    ASSERT_EQ(policy.decide(known).result.size(), 4u);
    known.packings[3].is_finished = false;
    CaseDecision const decision = policy.decide(known);
    EXPECT_TRUE(decision.result.empty());
    EXPECT_FALSE(is_done(known, decision.wanted.at(2)));
}

/// How often the final interval contains the truth, and how wide it is compared with that of known variance.
struct Coverage {
    double covered = 0, width = 0, packings = 0;
};

// The width of the intervals, against those that known variances give for the same packings and the cycles
// kept, z s / sqrt(P): at most 1.6. Student's t at 97.5 % with eight packings is already 1.45 times as wide.
// The values are scaled so that half-widths of 0.03 and 0.075 are asked for, whose first rounds have 24 and
// 18 cycles, and so that a packing's mean scatters by 1 / 1.6 and 1 / 0.6 of them. Over all of these cases,
// 93 to 98 % of the intervals contain the truth; each row of 400 does so within three standard deviations.
class FinalIntervalTest : public UntilPreciseTest, public ::testing::WithParamInterface<double> {};

TEST_P(FinalIntervalTest, CoversTheTruth) {
    constexpr int cases = 400;
    constexpr double sampling = 0.02;  // three standard deviations of 0.98
    PlannedCase const one = asking(GetParam());
    std::vector<Process> const processes{{0, 0}, {0.95, 0}, {0, 1}, {0.8, 1}, {0.5, 3}};
    std::vector<double> shares;
    for (Process const& process : processes) {
        double const deviation =
            std::sqrt(process.variance_of_mean(24) * (1 + process.offset * process.offset));
        for (double const relative : {1.6, 0.6}) {
            double const scale = GetParam() / (relative * deviation);
            Coverage found;
            for (unsigned seed = 1; seed <= cases; ++seed) {
                SimulatedEnd const end = simulate_case(policy, one, packings_of(process, seed, scale));
                if (!end.estimate.half_width) continue;
                double const known = 1.96 * scale *
                                     std::sqrt((process.variance_of_mean(end.estimate.measured) +
                                                std::pow(process.offset, 2) * process.variance_of_mean(24)) /
                                               end.estimate.packings);
                found.covered += std::abs(*end.estimate.mean) <= *end.estimate.half_width ? 1.0 / cases : 0;
                found.width += *end.estimate.half_width / known / cases;
                found.packings += end.estimate.packings / static_cast<double>(cases);
            }
            fmt::print(
                "rho {:4} offset {} half-width / deviation {:3}: covered {:.3f}, width {:.2f}, packings "
                "{:.1f}\n",
                process.rho, process.offset, relative, found.covered, found.width, found.packings);
            shares.push_back(found.covered);
            EXPECT_GE(found.covered, 0.93 - 0.038);  // three standard deviations of 0.93
            EXPECT_LE(found.covered, 0.98 + sampling);
            EXPECT_LE(found.width, 1.6);
        }
    }
    double const all =
        std::accumulate(shares.begin(), shares.end(), 0.0) / static_cast<double>(shares.size());
    EXPECT_GE(all, 0.93);
    EXPECT_LE(all, 0.98);
}

INSTANTIATE_TEST_SUITE_P(UntilPreciseTest, FinalIntervalTest, ::testing::Values(0.03, 0.075));

}  // namespace
}  // namespace vibrotrough::campaign
