#include "evaluate/observable.hpp"

#include "evaluate/case.hpp"
#include "measure/mass_flow.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vibrotrough::evaluate {
namespace {

using Series = std::vector<std::vector<double>>;  ///< of one point, by packing

/// The cycles at the beginning in which a packing has no value yet.
std::size_t count_undefined(std::vector<ObservedPacking> const& packings, std::size_t point,
                            std::size_t cycles) {
    std::size_t count = 0;
    for (ObservedPacking const& packing : packings) {
        auto const begin = packing.cycles.begin();
        auto const first = std::find_if(begin, begin + static_cast<std::ptrdiff_t>(cycles),
                                        [&](auto const& values) { return std::isfinite(values[point]); });
        count = std::max(count, static_cast<std::size_t>(first - begin));
    }
    return count;
}

/// The values of one point in the cycles from `first` on.
Series series_of(std::vector<ObservedPacking> const& packings, std::size_t point, std::size_t first,
                 std::size_t cycles) {
    Series series;
    for (ObservedPacking const& packing : packings) {
        series.emplace_back();
        for (std::size_t k = first; k < cycles; ++k) series.back().push_back(packing.cycles[k][point]);
    }
    return series;
}

/// Whether there is a value in each of the cycles, of which there is at least one.
bool is_whole(Series const& series) {
    return std::ranges::all_of(series, [](auto const& values) {
        return !values.empty() &&
               std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
    });
}

std::vector<std::span<double const>> runs_of(Series const& series) {
    return {series.begin(), series.end()};
}

/// All cycles of a drive of given length count equally.
store::ObservedValue value_of_given_length(Series const& series, double confidence) {
    std::vector<double> means;
    for (auto const& values : series)
        means.push_back(std::accumulate(values.begin(), values.end(), 0.0) /
                        static_cast<double>(values.size()));
    return {std::accumulate(means.begin(), means.end(), 0.0) / static_cast<double>(means.size()),
            measure::student_half_width(means, confidence),
            std::string(store::name_of(measure::Steadiness::steady))};
}

store::ObservedValue value_of(Series const& series, std::vector<ObservedPacking> const& packings,
                              double confidence, int startup) {
    std::vector<measure::PackingValues> values;
    for (std::size_t i = 0; i < series.size(); ++i)
        values.push_back({series[i], start_of(packings[i].number)});
    // Nobody has said how much a change matters: each that is significant counts.
    measure::CaseEstimate const estimate = measure::estimate_case(values, {confidence, 0}, startup);
    return {estimate.mean, estimate.half_width, std::string(store::name_of(estimate.steadiness))};
}

}  // namespace

store::ObservedCase observe_case(store::CaseRecord const& record,
                                 std::vector<ObservedPacking> const& packings,
                                 std::vector<double> const& at) {
    auto const cycles =
        std::ranges::min(packings, {}, [](auto const& one) { return one.cycles.size(); }).cycles.size();
    std::size_t const points = at.empty() ? 1 : at.size();
    bool const is_of_given_length = has_given_length(record.scenario);
    std::vector<Series> all;
    std::vector<int> undefined;
    int startup = 0;
    if (!is_of_given_length && !record.packings.empty())
        startup = std::min(record.packings.front().estimate.discarded, static_cast<int>(cycles / 2));
    for (std::size_t point = 0; point < points; ++point) {
        std::size_t const first = count_undefined(packings, point, cycles);
        undefined.push_back(static_cast<int>(first));
        all.push_back(series_of(packings, point, first, cycles));
        if (is_of_given_length || !is_whole(all.back())) continue;
        startup = std::max(startup, undefined.back() + measure::common_startup_length(runs_of(all.back())));
    }
    store::ObservedCase observed{
        record.id, store::mark_of(record), {}, startup, static_cast<int>(cycles) - startup, at, {}};
    for (ObservedPacking const& packing : packings) observed.packings.push_back(packing.number);
    double const confidence = record.scenario.measure.confidence;
    for (std::size_t point = 0; point < points; ++point) {
        Series const& series = all[point];
        if (!is_whole(series)) {
            observed.values.push_back({{}, {}, std::string(store::name_of(measure::Steadiness::steady))});
        } else if (is_of_given_length) {
            observed.values.push_back(value_of_given_length(series, confidence));
        } else {
            observed.values.push_back(
                value_of(series, packings, confidence, std::max(0, startup - undefined[point])));
        }
    }
    return observed;
}

}  // namespace vibrotrough::evaluate
