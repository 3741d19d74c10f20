#pragma once

#include "campaign/state/plan.hpp"
#include "evaluate/numerics_budget.hpp"
#include "store/result_file.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace vibrotrough::campaign {

/// The study of the numerical error of one case of a campaign.
struct NumericsStudy {
    std::string case_id;                           ///< of the campaign's case
    prepare::PreparedCase standard;                ///< the case with its own settings, as it is studied
    std::vector<prepare::VariedSetting> settings;  ///< and their variations
    /// Of the case itself, when the campaign has simulated it well enough: it is then not simulated again.
    std::optional<evaluate::StudyResult> known;

    /// What is to be simulated: the case, unless its result is known, and all its variations, in the order of
    /// the settings.
    std::vector<scenario::Scenario> scenarios() const;
};

/// The study of a case. It writes no frames, which would change the time step.
/// @param half_width  of the interval that is wanted of each of its cases; none: the case's own
NumericsStudy plan_study(PlannedCase const& planned, std::optional<double> half_width);

/// The numbers (from 0) of the cases that are studied when nobody chooses: first, middle and last.
std::vector<std::size_t> representative_cases(std::size_t count);

/// Measures what the finished cases of studies say, and says of the others why they have no number.
/// @param plan     of the campaign made of the studies' scenarios, and run
/// @param studies  of the campaign's cases
std::vector<evaluate::NumericsBudget> measure_numerics(Plan const& plan,
                                                       std::vector<NumericsStudy> const& studies);

/// Where `compare` finds the budgets: DIR/numerics.json.
std::filesystem::path numerics_file(std::filesystem::path const& campaign_folder);

/// Writes the budgets. Those of other cases that are in the file stay.
/// @throws core::MissingError when the disk refuses
/// @throws core::InputError when the file that is there is damaged
void write_numerics(std::filesystem::path const& campaign_folder,
                    std::vector<evaluate::NumericsBudget> const& budgets);

/// The numerical errors (NumericsBudget::numerical_error) of the studied cases, by id. Empty when there is no
/// file. Budgets with unknown parts are not used. The others have what is known beforehand
/// (prepare::numerical_errors): an error differs from layer to layer.
/// @throws core::InputError when the file is damaged
std::map<std::string, double> read_case_numerics(std::filesystem::path const& campaign_folder);

}  // namespace vibrotrough::campaign
