#pragma once

#include "prepare/prepared_case.hpp"
#include "scenario/reader/campaign_file.hpp"

#include <compare>
#include <deque>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace vibrotrough::campaign {

/// One case of a campaign and the folder that holds all about it.
struct PlannedCase {
    /// 12 hexadecimal digits of a hash of the scenario in canonical form, of the templates of decks (not
    /// their comments) and of the engine's version; also the name of `folder`.
    std::string id;
    std::shared_ptr<prepare::PreparedCase const> prepared;  ///< everything that follows from the scenario
    std::filesystem::path folder;                           ///< that holds it
    /// What distinguishes it from the other cases, such as "throw_number 2, layer.height 12 mm"; empty when
    /// nothing is swept.
    std::string label = {};
    bool is_added = false;  ///< of the folder "added", not of the campaign file

    /// The scenario of the case.
    scenario::Scenario const& scenario() const { return prepared->scenario; }
    /// Where the result appears when it is complete.
    std::filesystem::path result_file() const { return folder / "result.h5"; }
    /// Where a failure is recorded.
    std::filesystem::path failure_file() const { return folder / "failure.json"; }
    /// The certificate of the engine that the campaign was planned with.
    std::filesystem::path certificate_file() const {
        return folder.parent_path().parent_path() / "certificate.json";
    }
    /// The folder of a packing, numbered from 1.
    std::filesystem::path packing_folder(int packing) const {
        return folder / ("packing-" + std::to_string(packing));
    }
};

/// So many cases are worth a thread of their own when all cases of a plan are looked at: one takes less than
/// a millisecond, but on a shared file system it waits for its files.
constexpr std::size_t cases_per_thread = 8;

/// One packing of one case: the unit that runs on its own anywhere.
struct PackingId {
    std::string case_id;  ///< of the case
    int packing;          ///< from 1
    /// By case, then by number.
    auto operator<=>(PackingId const&) const = default;
};

/// A campaign on disk. Cases keep their addresses when others are added.
struct Plan {
    std::string name;                               ///< of the campaign
    std::filesystem::path folder;                   ///< that holds it
    std::string engine_version;                     ///< of the engine that runs it; part of the ids
    std::deque<PlannedCase> cases;                  ///< in the order of the campaign file, added ones last
    std::vector<std::filesystem::path> files = {};  ///< that the campaign file reads
    scenario::SweptKeys swept = {};                 ///< keys that differ between the cases
};

/// Works out the cases' ids and folders below `folder`: those of the campaign file, and after them those that
/// a policy has added (added_cases.hpp). The same case always has the same id, whatever the campaign's name
/// and its other cases.
/// @throws core::InputError when a case cannot be divided into time steps
Plan make_plan(scenario::Campaign const& campaign, std::filesystem::path const& folder,
               std::string const& engine_version);

/// Says of each case what distinguishes it. The feeds that a search for the capacity adds differ in a key
/// that the campaign file need not vary: it then counts as swept.
void label_cases(Plan& plan);

/// Id and folder of one more case of a plan. @throws as make_plan
PlannedCase plan_case(scenario::Scenario const& scenario, std::filesystem::path const& folder,
                      std::string const& engine_version);

/// The case's id. @throws as make_plan
std::string case_id(prepare::PreparedCase const& prepared, std::string const& engine_version);

/// Number of case folders that do not belong to the plan: of an earlier version of the campaign file.
std::size_t count_left_aside(Plan const& plan);

}  // namespace vibrotrough::campaign
