#include "campaign/schedule/forecast.hpp"

#include "campaign/schedule/machine_speed.hpp"
#include "deck/estimates.hpp"

#include <algorithm>
#include <cmath>

namespace vibrotrough::campaign {
namespace {

/// Scatter, as a natural logarithm, of a case's cost about the forecast, before there are results.
constexpr double unknown_scatter = 0.55;
/// The machine is never known better than this.
constexpr double least_scatter = 0.1;

/// Cycles of a packing over those of its first round, in the mean of throw numbers 0.8 to 3 for +- 0.075
/// (`ctest -R RealPackings -V`). It counts as one case, because the first results may be easy ones.
constexpr double usual_rounds = 1.16;

/// What the results say.
struct Learned {
    double speed = 0;             ///< grain-steps of a small layer per second and core; 0 without results
    deck::Experience experience;  ///< what the cost of further cases is expected from
    std::vector<double> ratios;   ///< logarithms of true over expected cost
};

Learned learn(std::vector<CaseOverview> const& cases) {
    Learned learned;
    double work = 0, time = 0, cycles = 0, packings = 0, usual = 0, known = 0;
    std::vector<double> deviations;
    for (CaseOverview const& one : cases) {
        if (!one.result || one.result->packings == 0) continue;
        work += deck::work_of(*one.planned->prepared, 0, one.result->cycles);
        time += one.result->core_time;
        cycles += one.result->cycles;
        packings += one.result->packings;
        usual += usual_rounds * deck::first_round_cycles(one.planned->scenario());
        ++known;
        if (one.result->deviation) deviations.push_back(*one.result->deviation);
    }
    if (packings == 0 || time <= 0 || work <= 0) return learned;
    learned.speed = work / time;
    learned.experience.cycles = (known * cycles / packings + usual / known) / (known + 1);
    if (!deviations.empty()) {
        auto const middle = deviations.begin() + static_cast<std::ptrdiff_t>(deviations.size() / 2);
        std::ranges::nth_element(deviations, middle);
        learned.experience.deviation = *middle;
    }
    for (CaseOverview const& one : cases) {
        if (!one.result || one.result->packings == 0) continue;
        double const expected = deck::expected_packings(one.planned->scenario(), learned.experience) *
                                deck::expected_cycles(one.planned->scenario(), learned.experience);
        learned.ratios.push_back(std::log(one.result->cycles / expected));
    }
    return learned;
}

double scatter_of(std::vector<double> const& ratios) {
    if (ratios.size() < 2) return unknown_scatter;
    double sum = 0, squares = 0;
    for (double const ratio : ratios) {
        sum += ratio;
        squares += ratio * ratio;
    }
    auto const n = static_cast<double>(ratios.size());
    return std::max(least_scatter, std::sqrt(std::max(0.0, squares - sum * sum / n) / (n - 1)));
}

/// Packings that a case has or will probably have.
int packings_of(CaseOverview const& one, Learned const& learned) {
    if (one.result) return one.result->packings;
    return std::max(one.packings_done, deck::expected_packings(one.planned->scenario(), learned.experience));
}

}  // namespace

Forecast forecast(std::vector<CaseOverview> const& cases) {
    Learned const learned = learn(cases);
    Forecast result;
    result.results = static_cast<int>(learned.ratios.size());
    result.speed = learned.speed;
    if (result.speed <= 0) {
        MachineSpeed const machine = machine_speed();
        result.speed = machine.grain_steps;
        result.is_of_last_campaign = machine.is_measured;
    }
    int missing_cases = 0;
    for (CaseOverview const& one : cases) {
        result.packings.push_back(packings_of(one, learned));
        int const missing = one.result ? 0 : result.packings.back() - one.packings_done;
        result.cases.push_back(deck::expected_work(*one.planned->prepared, missing, learned.experience) /
                               result.speed);
        result.core_time += result.cases.back();
        missing_cases += missing > 0 ? 1 : 0;
    }
    if (missing_cases == 0) return result;
    double const scatter = scatter_of(learned.ratios);
    double const of_what_is_learned = scatter / std::sqrt(std::max(1, result.results));
    double const of_missing = scatter / std::sqrt(missing_cases);
    result.uncertainty = std::exp(2 * std::hypot(least_scatter, of_what_is_learned, of_missing));
    return result;
}

void WorkOfRun::add(prepare::PreparedCase const& prepared, bool has_settled, int cycles) {
    is_plain &= deck::is_plain(prepared);
    done += deck::work_of(prepared, has_settled ? 1 : 0, cycles);
    driven += deck::work_of(prepared, 0, cycles);
}

TimeToGo time_to_go(WorkOfRun const& work, double elapsed) {
    if (work.done <= 0 || elapsed < 1) return {};
    double const left = std::max(0.0, work.left);
    double const speed = work.core_time > 0 ? work.driven / work.core_time : 0;
    return {left / work.done * elapsed, left / (speed > 0 ? speed : deck::usual_speed)};
}

}  // namespace vibrotrough::campaign
