#pragma once

#include "deck/check.hpp"
#include "scenario/reader/campaign_file.hpp"

#include <string>
#include <vector>

namespace vibrotrough::app {

/// What was found about one item over all cases of a campaign.
struct CheckRow {
    deck::Finding worst;  ///< of all cases
    int worst_case;       ///< its number, from 1
    int beyond = 0;       ///< cases that are not fine
};

struct CheckReport {
    std::vector<CheckRow> rows;  ///< in the order of deck::check
    int cases = 0;
    double grain_steps = 0;  ///< of the whole campaign, expected
    double bytes = 0;        ///< on disk, expected
    double packings = 0;
    double cycles = 0;  ///< of all packings, expected

    int warnings() const;
    int errors() const;
    std::string first_error() const;  ///< one line; empty when there is none
};

/// Checks every case.
CheckReport check_campaign(scenario::Campaign const& campaign);

/// One line for people: item, measured number, limit, where, what to change.
std::string describe(CheckRow const& row, int cases);

/// Shows what is not fine on standard error, a line each; nothing when all is.
void print_warnings(CheckReport const& report, std::string const& campaign_file);

}  // namespace vibrotrough::app
