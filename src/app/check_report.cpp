#include "app/check_report.hpp"

#include "deck/estimates.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace vibrotrough::app {
namespace {

/// How far a finding is beyond its limit (above 1) or within it.
double excess(deck::Finding const& finding) {
    return finding.at_least ? finding.limit / finding.measured : finding.measured / finding.limit;
}

void add(CheckReport& report, deck::Finding const& finding, int number) {
    auto const row = std::ranges::find_if(
        report.rows, [&](CheckRow const& one) { return one.worst.item == finding.item; });
    bool const beyond = finding.severity != deck::Severity::fine;
    if (row == report.rows.end()) {
        report.rows.push_back({finding, number, beyond ? 1 : 0});
        return;
    }
    if (beyond) ++row->beyond;
    if (excess(finding) <= excess(row->worst)) return;
    row->worst = finding;
    row->worst_case = number;
}

int count(CheckReport const& report, deck::Severity severity) {
    return static_cast<int>(std::ranges::count_if(
        report.rows, [&](CheckRow const& row) { return row.worst.severity == severity; }));
}

}  // namespace

int CheckReport::warnings() const {
    return count(*this, deck::Severity::warning);
}

int CheckReport::errors() const {
    return count(*this, deck::Severity::error);
}

std::string CheckReport::first_error() const {
    for (CheckRow const& row : rows) {
        if (row.worst.severity == deck::Severity::error) return describe(row, cases);
    }
    return {};
}

CheckReport check_campaign(scenario::Campaign const& campaign) {
    CheckReport report;
    prepare::CasePreparer preparer;
    for (scenario::Scenario const& scenario : campaign.cases) {
        prepare::PreparedCase const prepared = preparer.prepare(scenario);
        ++report.cases;
        for (deck::Finding const& finding : deck::check(prepared)) add(report, finding, report.cases);
        report.grain_steps += deck::expected_work(prepared);
        report.bytes += deck::expected_bytes(prepared);
        report.packings += scenario.measure.packings;
        report.cycles += scenario.measure.packings * deck::expected_cycles(prepared);
    }
    return report;
}

std::string describe(CheckRow const& row, int cases) {
    deck::Finding const& finding = row.worst;
    std::string const where =
        cases == 1 ? ""
                   : fmt::format(" in {} of {} cases, worst in case {}", row.beyond, cases, row.worst_case);
    return fmt::format("{}: {} is {:.3g}{}, {} {:.3g}{}; {}", finding.key, finding.item, finding.measured,
                       finding.unit == "1" ? "" : " " + finding.unit,
                       finding.at_least ? "at least" : "at most",
                       finding.severity == deck::Severity::error ? finding.hard_limit : finding.limit, where,
                       finding.advice);
}

void print_warnings(CheckReport const& report, std::string const& campaign_file) {
    int const count = report.warnings() + report.errors();
    if (count == 0) return;
    fmt::print(stderr, "check: {} finding{} ('vibrotrough check {}' shows all):\n", count,
               count == 1 ? "" : "s", campaign_file);
    for (CheckRow const& row : report.rows) {
        if (row.worst.severity == deck::Severity::fine) continue;
        fmt::print(stderr, "  {}: {}\n", to_string(row.worst.severity), describe(row, report.cases));
    }
}

}  // namespace vibrotrough::app
