#include "deck/campaign_check.hpp"

#include "deck/deck.hpp"
#include "deck/estimates.hpp"
#include "scenario/reader/swept_keys.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace vibrotrough::deck {
namespace {

void add(CampaignCheck& total, Finding const& finding, int number, std::string const& label) {
    auto const item = std::ranges::find_if(
        total.items, [&](CheckedItem const& one) { return one.worst.item == finding.item; });
    bool const beyond = finding.severity != Severity::fine;
    if (item == total.items.end()) {
        total.items.push_back({finding, number, label, beyond ? 1 : 0});
        return;
    }
    if (beyond) ++item->cases_beyond_limit;
    if (excess(finding) <= excess(item->worst)) return;
    item->worst = finding;
    item->worst_case = number;
    item->worst_label = label;
}

int count(CampaignCheck const& total, Severity severity) {
    return static_cast<int>(std::ranges::count_if(
        total.items, [&](CheckedItem const& item) { return item.worst.severity == severity; }));
}

}  // namespace

int CampaignCheck::warnings() const {
    return count(*this, Severity::warning);
}

int CampaignCheck::errors() const {
    return count(*this, Severity::error);
}

std::string CampaignCheck::first_error() const {
    for (CheckedItem const& item : items) {
        if (item.worst.severity == Severity::error) return describe(item, cases);
    }
    return {};
}

CampaignCheck check_campaign(scenario::Campaign const& campaign) {
    CampaignCheck total;
    // The certificate, the frozen campaign and campaign.h5.
    total.bytes = total.largest_bytes = 80e3;
    for (scenario::Scenario const& scenario : campaign.cases) {
        prepare::PreparedCase const prepared = prepare::prepare_case(scenario);
        ++total.cases;
        // A mistake in a template of the case is found now, and not when the first packing starts.
        if (total.cases == 1 && scenario.engine.templates) make_deck(prepared, {1});
        std::string const label = swept_label(scenario, campaign.swept);
        for (Finding const& finding : check(prepared)) add(total, finding, total.cases, label);
        for (std::string const& remark : remarks(scenario))
            if (std::ranges::find(total.remarks, remark) == total.remarks.end())
                total.remarks.push_back(remark);
        double const modulus = prepared.scenario.grains.youngs_modulus.value();
        total.least_modulus = total.cases == 1 ? modulus : std::min(total.least_modulus, modulus);
        total.most_modulus = std::max(total.most_modulus, modulus);
        if (prepared.scenario.grains.is_modulus_chosen) ++total.moduli_chosen;
        double const packings = expected_packings(prepared.scenario);
        total.work += expected_work(prepared, packings);
        total.largest_step_cost = std::max(total.largest_step_cost, prepared.step_cost());
        total.bytes += expected_bytes(prepared);
        total.largest_bytes += largest_bytes(prepared);
        total.engine_memory = std::max(total.engine_memory, expected_memory(prepared));
        total.packings += packings;
        total.cycles += packings * expected_cycles(scenario);
    }
    return total;
}

std::string describe(CheckedItem const& item, int cases) {
    Finding const& finding = item.worst;
    std::string const worst =
        item.worst_label.empty() ? fmt::format("case {}", item.worst_case) : item.worst_label;
    std::string const where = cases == 1 ? ""
                                         : fmt::format(" in {} of {} cases ({} is the worst)",
                                                       item.cases_beyond_limit, cases, worst);
    std::string const refused = finding.severity == Severity::error
                                    ? fmt::format(" ({} {:.3g} it is an error)",
                                                  finding.at_least ? "below" : "above", finding.hard_limit)
                                    : "";
    return fmt::format("{}: {} is {:.3g}{}{}; it should be {} {:.3g}{}; {}", finding.key, finding.item,
                       finding.measured, finding.unit == "1" ? "" : " " + finding.unit, where,
                       finding.at_least ? "at least" : "at most", finding.limit, refused, finding.advice);
}

}  // namespace vibrotrough::deck
