#include "campaign/schedule/until_precise.hpp"
#include "campaign_folder.hpp"
#include "simulated_case.hpp"

#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace vibrotrough::campaign {
namespace {

constexpr int longest = 200;  ///< cycles of a packing at most

using Random = std::mt19937;
/// The cycles of a packing by its number (odd ones start below the expected speed); the true mean is 0.
using Maker = std::function<std::vector<double>(int number, Random& random)>;

/// First-order autoregressive cycles with the standard deviation `scatter`.
std::vector<double> noise(double rho, double scatter, Random& random) {
    std::normal_distribution<double> normal;
    std::vector<double> values;
    double value = normal(random);
    for (int i = 0; i < longest; ++i) {
        values.push_back(scatter * value);
        value = rho * value + std::sqrt(1 - rho * rho) * normal(random);
    }
    return values;
}

Maker correlated(double rho) {
    return [=](int, Random& random) { return noise(rho, 0.05, random); };
}

/// Every packing keeps an offset of its own, with the mean 0.
template <typename Distribution>
Maker offset_by(double cycles_scatter, double mean, double scale, Distribution distribution) {
    return [=](int, Random& random) mutable {
        distribution.reset();
        double const own = scale * (distribution(random) - mean);
        std::vector<double> values = noise(0, cycles_scatter, random);
        for (double& value : values) value += own;
        return values;
    };
}

/// A start-up that decays as exp(-i / decay), of size `odd` in odd packings and `even` in even ones.
Maker starting(double odd, double even, double decay) {
    return [=](int number, Random& random) {
        std::vector<double> values = noise(0, 0.05, random);
        for (int i = 0; i < longest; ++i)
            values[static_cast<std::size_t>(i)] += (number % 2 == 1 ? odd : even) * std::exp(-i / decay);
        return values;
    };
}

/// A common start-up of +0.1 that falls along a line and ends after 40 cycles.
std::vector<double> falling(int, Random& random) {
    std::vector<double> values = noise(0, 0.05, random);
    for (int i = 0; i < 40; ++i) values[static_cast<std::size_t>(i)] += 0.1 * (1 - i / 40.0);
    return values;
}

/// Two branches `apart` from each other, equally likely, which last 200 cycles in the mean.
Maker switching(double apart) {
    return [=](int, Random& random) {
        std::uniform_real_distribution<double> chance;
        double branch = chance(random) < 0.5 ? apart / 2 : -apart / 2;
        std::vector<double> values = noise(0, 0.03, random);
        for (double& value : values) {
            value += branch;
            if (chance(random) < 1.0 / 200) branch = -branch;
        }
        return values;
    };
}

/// A branch that 15 % of the packings take, 0.1 above the others.
std::vector<double> rarely_faster(int, Random& random) {
    std::uniform_real_distribution<double> chance;
    double const own = chance(random) < 0.15 ? 0.085 : -0.015;
    std::vector<double> values = noise(0, 0.03, random);
    for (double& value : values) value += own;
    return values;
}

/// What a case may use.
struct Limits {
    int packings = 4, max_packings = 24, max_cycles = longest;
};

/// What must hold of a row, but for three standard deviations of sampling.
struct Bounds {
    double least = 0.93, most = 0.98;  ///< share covered of the sets that are finished
    /// Where that cannot be reached: share of all sets that are finished with a wrong mean.
    std::optional<double> wrong = {};
};

struct Row {
    std::string name;
    Maker make;
    Bounds bounds = {};
    Limits limits = {};
    double half_width = 0.02;
};

/// src/manual/confidence.md has a table of the most instructive rows, and the reasons of other bounds. The
/// interval of a case that drifts may contain the truth always: it counts what is left of decays that are
/// slower than the true one.
std::vector<Row> rows() {
    using Normal = std::normal_distribution<double>;
    using Gamma = std::gamma_distribution<double>;
    Limits const four_of_40{4, 4, 40}, six_of_60{6, 6, 60};
    Bounds const safe{0.93, 1};
    auto const wrong = [](double share) { return Bounds{0, 1, share}; };
    return {
        {"independent cycles", correlated(0)},
        {"correlation 0.5", correlated(0.5)},
        {"correlation 0.8", correlated(0.8)},
        {"correlation 0.9", correlated(0.9)},
        {"correlation 0.9, 40 cycles", correlated(0.9), {}, {4, 24, 40}},
        {"correlation 0.9, 4 x 40", correlated(0.9), {}, four_of_40, 0.04},
        {"normal offsets", offset_by(0.05, 0, 0.02, Normal{})},
        {"offsets of skewness 1", offset_by(0.03, 4, 0.01, Gamma{4, 1})},
        {"offsets of skewness 2", offset_by(0.03, 1, 0.02, Gamma{1, 1}), wrong(0.1)},
        {"start-up from both sides", starting(-0.12, 0.18, 5), safe},
        {"common start-up of 8 cycles", starting(0.2, 0.2, 8), safe},
        {"the same, 4 x 40", starting(0.2, 0.2, 8), safe, four_of_40},
        {"common start-up of 40 cycles", starting(0.1, 0.1, 40), safe},
        {"the same, 6 x 60", starting(0.1, 0.1, 40), wrong(0.09), six_of_60},
        {"common fall, over after 40", falling, safe},
        {"branches 0.06 apart, last 200", switching(0.06), wrong(0.13)},
        {"branches 0.10 apart, last 200", switching(0.10), wrong(0.13)},
        {"a branch of 15 %", rarely_faster, wrong(0.48)},
    };
}

class FabricatedPackings : public CampaignFolder {
  protected:
    SimulatedEnd run(Row const& row, unsigned set) const {
        prepare::PreparedCase prepared = *planned.prepared;
        remove_numerical_errors(prepared.scenario);
        prepared.scenario.measure = {row.limits.packings,     0.95, row.half_width, row.limits.max_cycles,
                                     row.limits.max_packings, {}};
        PlannedCase asked = planned;
        asked.prepared = std::make_shared<prepare::PreparedCase const>(prepared);
        std::map<int, std::vector<double>> made;
        auto const series = [&](int number) -> std::vector<double> const& {
            std::vector<double>& values = made[number];
            if (!values.empty()) return values;
            Random random(1000 * set + static_cast<unsigned>(number));
            return values = row.make(number, random);
        };
        return simulate_case(UntilPrecise{}, asked, series);
    }
};

// How many cases end as `finished`, and how many of these intervals contain the true mean.
TEST_F(FabricatedPackings, FinishedIntervalsCoverTheTruth) {
    constexpr int sets = 400;
    auto const sampling = [](double p, int count) { return 3 * std::sqrt(p * (1 - p) / count); };
    for (Row const& row : rows()) {
        int finished = 0, covered = 0;
        double packings = 0, cycles = 0;
        for (unsigned set = 1; set <= sets; ++set) {
            SimulatedEnd const end = run(row, set);
            packings += end.estimate.packings / static_cast<double>(sets);
            cycles += end.all_cycles() / sets;
            if (end.outcome != core::Outcome::finished) continue;
            ++finished;
            covered += std::abs(*end.estimate.mean) <= *end.estimate.half_width ? 1 : 0;
        }
        double const share = finished > 0 ? covered / static_cast<double>(finished) : 0;
        double const wrong = (finished - covered) / static_cast<double>(sets);
        fmt::print(
            "{:30} finished {:5.1f} %, covered {:5.1f} % of them; wrong {:4.1f} % of all; packings {:4.1f}, "
            "cycles {:4.0f}\n",
            row.name, 100.0 * finished / sets, 100 * share, 100 * wrong, packings, cycles);
        Bounds const& bounds = row.bounds;
        if (bounds.wrong) {
            EXPECT_LE(wrong, *bounds.wrong + sampling(*bounds.wrong, sets)) << row.name;
            continue;
        }
        if (finished == 0) continue;
        EXPECT_GE(share, bounds.least - sampling(bounds.least, finished)) << row.name;
        EXPECT_LE(share, bounds.most + sampling(bounds.most, finished)) << row.name;
    }
}

}  // namespace
}  // namespace vibrotrough::campaign
