#pragma once

#include "deck/check.hpp"
#include "scenario/reader/campaign_file.hpp"

#include <string>
#include <vector>

namespace vibrotrough::deck {

/// What the check found about one item over all cases of a campaign.
struct CheckedItem {
    Finding worst;               ///< the finding that is furthest beyond its limit, or closest to it
    int worst_case;              ///< the number of its case, counted from 1
    std::string worst_label;     ///< what distinguishes that case, as `run` says it; empty if nothing does
    int cases_beyond_limit = 0;  ///< number of cases in which this item is a warning or an error
};

/// What is known about a campaign before it is simulated.
struct CampaignCheck {
    std::vector<CheckedItem> items;    ///< in the order of deck::check
    int cases = 0;                     ///< number of cases
    double work = 0;                   ///< expected of the whole campaign, see expected_work
    double largest_step_cost = 1;      ///< prepare::relative_step_cost of the largest layer
    double bytes = 0;                  ///< expected size of all files, bytes
    double largest_bytes = 0;          ///< if all cases go to max_packings and max_cycles, bytes
    double engine_memory = 0;          ///< of one engine of the largest case, bytes
    double least_modulus = 0;          ///< Young's modulus of the softest grains, Pa
    double most_modulus = 0;           ///< of the stiffest grains, Pa
    int moduli_chosen = 0;             ///< number of cases whose modulus was not given
    double packings = 0;               ///< number of packings of all cases
    double cycles = 0;                 ///< expected number of cycles of all packings
    std::vector<std::string> remarks;  ///< what was mended or left out of files, each once

    /// Number of items that are a warning in their worst case.
    int warnings() const;
    /// Number of items that are an error in their worst case.
    int errors() const;
    /// One line about the first error; empty when there is none.
    std::string first_error() const;
};

/// Checks every case of a campaign with deck::check and adds up what the cases cost.
CampaignCheck check_campaign(scenario::Campaign const& campaign);

/// One line for people: the key to change, the item, its value and limit, the cases, and what to change.
/// @param cases  number of cases of the campaign
std::string describe(CheckedItem const& item, int cases);

}  // namespace vibrotrough::deck
