#include "evaluate/numerics_budget.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace vibrotrough::evaluate {
namespace {

std::optional<measure::RefinedMean> known_mean(StudyResult const& result, double coarseness) {
    if (!result.mean || !result.half_width) return {};
    return measure::RefinedMean{coarseness, *result.mean, *result.half_width};
}

/// Why a result cannot be used, with the value for which it was obtained.
std::string why_unusable(StudyResult const& result) {
    return result.message.empty() ? "its mean has no interval" : result.message;
}

/// The error of a setting, or why there is none. A variation that failed leaves the others usable, but the
/// finest is needed: without it the error would be smaller than it is.
void add_error(SettingError& setting, StudyResult const& standard) {
    auto const first = known_mean(standard, 1);
    if (!first) {
        setting.message = fmt::format("the case itself has no result: {}", why_unusable(standard));
        return;
    }
    std::vector<measure::RefinedMean> means{*first};
    for (MeasuredVariation& one : setting.variations) {
        auto const mean = known_mean(one.result, one.coarseness);
        if (!mean) continue;
        measure::NumericalError const found = measure::difference(*first, *mean);
        one.error = found.error;
        one.half_width = found.half_width;
        means.push_back(*mean);
    }
    StudyResult const& finest = setting.variations.back().result;
    if (!known_mean(finest, 0)) {
        setting.message = fmt::format("the finest variation has no result: {}", why_unusable(finest));
        return;
    }
    setting.error = measure::numerical_error(means, setting.order);
    if (setting.order && means.size() > 2 && setting.error->verdict == measure::Convergence::resolved)
        setting.message = "not extrapolated: the values do not lie on one line of the expected order";
}

}  // namespace

std::optional<measure::NumericalError> SettingError::known_error() const {
    if (!error) return {};
    return measure::with_expected(*error, expected);
}

std::optional<measure::NumericalError> NumericsBudget::total() const {
    measure::NumericalError sum{measure::Convergence::not_resolved, 0, 0};
    for (SettingError const& one : settings) {
        if (one.is_left_out()) continue;
        auto const known = one.known_error();
        if (!known) return {};
        sum.error += known->error;
        sum.half_width = std::hypot(sum.half_width, known->half_width);
    }
    if (std::abs(sum.error) > sum.half_width) sum.verdict = measure::Convergence::resolved;
    return sum;
}

std::optional<double> NumericsBudget::numerical_error() const {
    auto const all = total();
    return all ? std::optional(all->bound()) : std::nullopt;
}

NumericsBudget make_budget(std::string const& case_id, double confidence, StudyResult const& standard,
                           std::vector<prepare::VariedSetting> const& varied,
                           std::vector<StudyResult> const& results) {
    NumericsBudget budget{case_id, confidence, standard, {}};
    auto result = results.begin();
    for (prepare::VariedSetting const& one : varied) {
        SettingError setting{one.setting, one.value, one.order, {}, {}, one.left_out, one.expected};
        for (prepare::NumericalVariation const& variation : one.variations) {
            if (result == results.end()) throw std::invalid_argument("a variation without a result");
            setting.variations.push_back({variation.value, variation.coarseness, *result++, {}, {}});
        }
        if (!setting.is_left_out()) add_error(setting, standard);
        budget.settings.push_back(std::move(setting));
    }
    return budget;
}

std::string_view name_of(measure::Convergence verdict) {
    switch (verdict) {
        case measure::Convergence::extrapolated:
            return "extrapolated";
        case measure::Convergence::resolved:
            return "resolved";
        case measure::Convergence::not_resolved:
            return "not-resolved";
    }
    throw std::invalid_argument("no such verdict");
}

}  // namespace vibrotrough::evaluate
