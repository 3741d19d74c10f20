#pragma once

#include "measure/convergence.hpp"
#include "prepare/numerics_variations.hpp"

#include <limits>
#include <optional>
#include <string>
#include <vector>

// The numerical error of a case's velocity efficiency: how far it would move if its numerical settings
// (Young's modulus, time step, box) were at their limits. It is measured by simulating the case again with
// each setting nearer to its limit.
namespace vibrotrough::evaluate {

/// What a case of a study came to.
struct StudyResult {
    std::string case_id;               ///< in the study's campaign
    std::optional<double> mean;        ///< of velocity efficiency; none when the case has no result
    std::optional<double> half_width;  ///< of its confidence interval
    std::string message;               ///< why there is no mean with an interval
};

/// One variation of a setting and its difference from the default.
struct MeasuredVariation {
    double value;                      ///< of the setting's key, SI
    double coarseness;                 ///< distance from the limit: 1 at the default, 0 at the limit
    StudyResult result;                ///< its velocity efficiency
    std::optional<double> error;       ///< default minus this
    std::optional<double> half_width;  ///< of `error`: both intervals combined
};

/// The error of one setting.
struct SettingError {
    prepare::NumericalSetting setting;               ///< which
    double value;                                    ///< its default, SI
    std::optional<double> order;                     ///< of the error in the coarseness, if it is known
    std::vector<MeasuredVariation> variations = {};  ///< with decreasing coarseness
    std::optional<measure::NumericalError> error =
        {};                    ///< as measured; none when it was left out or could not be measured
    std::string message = {};  ///< why there is no error
    double expected = std::numeric_limits<double>::infinity();  ///< half-width known beforehand

    /// The error by what was measured and what is known beforehand together (measure::with_expected).
    std::optional<measure::NumericalError> known_error() const;

    /// Whether the setting does not matter for the case, so that its part of the budget is zero.
    bool is_left_out() const { return variations.empty(); }
};

/// The numerical errors of one case of a campaign.
struct NumericsBudget {
    std::string case_id;                 ///< of the campaign's case
    double confidence;                   ///< of all intervals
    StudyResult standard;                ///< the case with its own settings, simulated again in the study
    std::vector<SettingError> settings;  ///< in the order of prepare::vary_numerics

    /// The error of all settings together: the sum of their errors (SettingError::known_error), with the root
    /// of the sum of the squares of their half-widths, because they are independent of each other. None when
    /// one of the settings could not be measured.
    std::optional<measure::NumericalError> total() const;

    /// What the size of total() is below: the numerical error that the case's interval contains.
    std::optional<double> numerical_error() const;
};

/// The budget of a case from the results of its study.
/// @param case_id   of the campaign's case
/// @param standard  result with the case's own settings
/// @param varied    the settings and their variations
/// @param results   of all variations, in the order of the settings and their variations
NumericsBudget make_budget(std::string const& case_id, double confidence, StudyResult const& standard,
                           std::vector<prepare::VariedSetting> const& varied,
                           std::vector<StudyResult> const& results);

/// "extrapolated", "resolved" or "not-resolved".
std::string_view name_of(measure::Convergence verdict);

}  // namespace vibrotrough::evaluate
