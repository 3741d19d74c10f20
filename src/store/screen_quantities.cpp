#include "store/screen_quantities.hpp"

#include "prepare/screen.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace vibrotrough::store {
namespace {

using Case = CaseRecord const&;
using measure::EnsembleNumber;
using measure::Screening;

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

bool has_screen(Case record) {
    return is_screen(record.scenario) && !record.packings.empty();
}

bool has_batch(Case record) {
    return has_screen(record) && record.scenario.screen.time.has_value();
}

MeasuredNumber screening(std::optional<double> Screening::*member) {
    return field(&PackingRecord::screening, member);
}

/// Cycles that all packings have.
int cycles_of(Case record) {
    int cycles = record.packings.front().series.cycles();
    for (PackingRecord const& packing : record.packings) cycles = std::min(cycles, packing.series.cycles());
    return cycles;
}

double period_of(Case record) {
    return 1 / record.scenario.trough.frequency;
}

double opening_of(Case record) {
    return *record.scenario.screen.opening;
}

/// A column of shares, with the ends of their intervals. Student's interval knows no bounds: an end beyond 0
/// or 1, which no share can have, is moved there.
class MeasuredShare : public MeasuredColumn {
  public:
    using MeasuredColumn::MeasuredColumn;

    void put_into(std::vector<CaseValues>& columns) const {
        MeasuredColumn::put_into(columns);
        std::vector<double> low, high;
        for (std::size_t i = 0; i < means.size(); ++i) {
            low.push_back(std::isnan(half_widths[i]) ? not_known : std::max(0.0, means[i] - half_widths[i]));
            high.push_back(std::isnan(half_widths[i]) ? not_known : std::min(1.0, means[i] + half_widths[i]));
        }
        columns.emplace_back(low);
        columns.emplace_back(high);
    }
};

/// In how many cycles grains can fall through: all of a batch, and with a feed those that the layer needs
/// along the holes. NaN when its speed is not known.
double cycles_over_holes(Case record) {
    scenario::Scenario const& s = record.scenario;
    if (has_batch(record)) return cycles_of(record);
    double const speed = record.estimate.mean.value_or(not_known) * velocity_scale(s.trough);
    return speed > 0 ? holes_along(s) * hole_pitch(s.screen) / speed * s.trough.frequency : not_known;
}

/// The probability that a grain is still on the screen after some attempts.
double share_by_model(Case record, double diameter, double attempts) {
    return std::pow(1 - prepare::passage_probability(record.scenario.screen, diameter), attempts);
}

/// Attempts per cycle that would leave this share: ln(share) / (n ln(1 - p)).
double attempts_per_cycle(Case record, double diameter, double share) {
    double const probability = prepare::passage_probability(record.scenario.screen, diameter);
    if (probability <= 0 || share <= 0 || share >= 1) return not_known;
    return std::log(share) / (cycles_over_holes(record) * std::log1p(-probability));
}

/// Efficiency of screening with one attempt in each cycle.
std::optional<double> efficiency_by_model(Case record) {
    if (!has_screen(record)) return {};
    Screening const& s = record.packings.front().screening;
    double all = 0, passed = 0;
    for (std::size_t i = 0; i < s.diameter.size() && s.diameter[i] < opening_of(record); ++i) {
        all += s.number[i] * s.mass[i];
        passed +=
            s.number[i] * s.mass[i] * (1 - share_by_model(record, s.diameter[i], cycles_over_holes(record)));
    }
    if (all == 0 || std::isnan(passed)) return {};
    return passed / all;
}

/// Share of the grains of a size that did not pass; NaN when there was none.
double share_that_stays(Case record, Screening const& screening, std::size_t size) {
    if (has_batch(record)) return share_curve(screening, size, cycles_of(record)).back();
    double const number = screening.number[size];
    return number > 0 ? 1 - screening.passed[size] / number : not_known;
}

/// s, until half of a size has passed; NaN when it has not, and with a feed.
double half_time_of(Case record, Screening const& screening, std::size_t size) {
    if (!has_batch(record)) return not_known;
    auto const curve = share_curve(screening, size, cycles_of(record));
    return measure::half_time(curve, period_of(record)).value_or(not_known);
}

std::vector<CaseValues> partition_values(Case record) {
    if (!has_screen(record)) return {};
    Screening const& first = record.packings.front().screening;
    double const confidence = record.scenario.measure.confidence;
    MeasuredShare stays(confidence);
    MeasuredColumn times(confidence);
    std::vector<double> relative, probability, model, attempts;
    for (std::size_t i = 0; i < first.diameter.size(); ++i) {
        EnsembleNumber share, time;
        for (PackingRecord const& packing : record.packings) {
            share.values.push_back(share_that_stays(record, packing.screening, i));
            time.values.push_back(half_time_of(record, packing.screening, i));
        }
        stays.add(share);
        times.add(time);
        double const d = first.diameter[i];
        relative.push_back(d / opening_of(record));
        probability.push_back(prepare::passage_probability(record.scenario.screen, d));
        model.push_back(share_by_model(record, d, cycles_over_holes(record)));
        attempts.push_back(attempts_per_cycle(record, d, share.mean()));
    }
    std::vector<CaseValues> columns{first.diameter, relative, first.number};
    stays.put_into(columns);
    for (auto const* const column : {&probability, &model, &attempts}) columns.emplace_back(*column);
    times.put_into(columns);
    return columns;
}

std::vector<CaseValues> screening_values(Case record) {
    if (!has_batch(record)) return {};
    double const confidence = record.scenario.measure.confidence;
    MeasuredColumn distance(confidence), held(confidence), efficiency(confidence), speed(confidence);
    std::vector<std::vector<double>> curves;
    for (PackingRecord const& packing : record.packings)
        curves.push_back(efficiency_curve(packing.screening, opening_of(record), cycles_of(record)));
    std::vector<double> times, gone(record.packings.size());
    for (std::size_t k = 0; k <= static_cast<std::size_t>(cycles_of(record)); ++k) {
        times.push_back(static_cast<double>(k) * period_of(record));
        EnsembleNumber ways, masses, shares, speeds;
        for (std::size_t i = 0; i < record.packings.size(); ++i) {
            measure::CycleSeries const& series = record.packings[i].series;
            double const velocity = k == 0 ? not_known : series.mean_velocity[k - 1];
            if (k > 0) gone[i] += velocity * period_of(record);
            ways.values.push_back(gone[i]);
            masses.values.push_back(series.open.held_mass[k] / series.open.held_mass[0]);
            shares.values.push_back(curves[i].empty() ? not_known : curves[i][k]);
            speeds.values.push_back(velocity);
        }
        distance.add(ways);
        held.add(masses);
        efficiency.add(shares);
        speed.add(speeds);
    }
    std::vector<CaseValues> columns{times};
    for (auto const* const column : {&distance, &held, &efficiency, &speed}) column->put_into(columns);
    return columns;
}

std::vector<CaseValues> partition_cycles_values(Case record) {
    if (!has_batch(record)) return {};
    MeasuredShare stays(record.scenario.measure.confidence);
    std::vector<double> diameters, times;
    Screening const& first = record.packings.front().screening;
    for (std::size_t i = 0; i < first.diameter.size(); ++i) {
        std::vector<std::vector<double>> curves;
        for (PackingRecord const& packing : record.packings)
            curves.push_back(share_curve(packing.screening, i, cycles_of(record)));
        for (std::size_t k = 0; k < curves.front().size(); ++k) {
            diameters.push_back(first.diameter[i]);
            times.push_back(static_cast<double>(k) * period_of(record));
            EnsembleNumber share;
            for (auto const& curve : curves) share.values.push_back(curve[k]);
            stays.add(share);
        }
    }
    std::vector<CaseValues> columns{diameters, times};
    stays.put_into(columns);
    return columns;
}

void add_share(std::vector<Entry>& entries, std::string const& meaning) {
    add_measured(entries, {"stays", "1", meaning});
    entries.push_back({"stays_low", "1",
                       "Lower end of this interval, at least 0, because a share is; NaN with one packing"});
    entries.push_back({"stays_high", "1", "Upper end of this interval, at most 1; NaN with one packing"});
}

CaseTable partition_table() {
    std::vector<Entry> entries{
        {"diameter", "m", "Diameter of the grains of one size, from the smallest; only of screens"},
        {"relative_diameter", "1", "The same over the opening; infinite without holes"},
        {"number", "1",
         "Grains of this size in a packing at first; with a feed, in the first packing those that passed or "
         "left over the edge in the cycles that count"}};
    add_share(
        entries,
        "Share of them that is on the screen at the end, with a feed that left over the edge, mean over "
        "the packings");
    entries.insert(
        entries.end(),
        {{"probability", "1",
          "Probability p = ((a - d) / (a + w))^2 that a grain passes at one attempt (Gaudin 1939): of a "
          "sphere of diameter d that falls straight on a screen with the opening a and the bars w"},
         {"stays_by_model", "1",
          "Share that stays with one attempt in each of n cycles: (1 - p)^n; with a feed n is the time that "
          "the layer needs along the holes over the period"},
         {"attempts", "1",
          "Attempts per cycle with which the model leaves the share that was measured: ln(stays) / (n ln(1 - "
          "p)); NaN where none or all of a size can pass or have passed"}});
    add_measured(entries, {"half_time", "s",
                           "Time until half of this size has passed, mean over the packings; NaN when it has "
                           "not in one of them"});
    return {"partition", "sizes", entries, partition_values};
}

CaseTable screening_table() {
    std::vector<Entry> entries{{"time", "s", "End of cycle 0 ... n; only of screens"}};
    add_measured(entries, {"distance", "m",
                           "How far the layer on the screen was conveyed until then, mean over the packings: "
                           "the length of screen that the time stands for"});
    add_measured(entries,
                 {"held_share", "1", "Mass on the screen over that at first, mean over the packings"});
    add_measured(entries,
                 {"efficiency", "1",
                  "Efficiency of screening: mass of undersize (grains smaller than the opening) that "
                  "passed until then over that at first, mean over the packings; NaN without "
                  "undersize"});
    add_measured(entries, {"conveying_speed", "m/s",
                           "Speed of the layer on the screen along it in the cycle that ends, mean over the "
                           "packings; NaN in the first row"});
    return {"screening", "cycles + 1", entries, screening_values};
}

CaseTable partition_cycles_table() {
    std::vector<Entry> entries{
        {"diameter", "m", "Diameter of the grains of one size, from the smallest; only of screens"},
        {"time", "s", "End of cycle 0 ... n"}};
    add_share(entries,
              "Share of the grains of this size that is still on the screen, mean over the packings");
    return {"partition_cycles", "sizes * (cycles + 1)", entries, partition_cycles_values};
}

bool is_batch(scenario::Scenario const& s) {
    return s.screen.time.has_value();
}

auto at_end_of_cycle(std::vector<double> measure::OpenSeries::*member) {
    return field(&PackingRecord::series, &measure::CycleSeries::open, member);
}

auto size(std::vector<double> Screening::*member) {
    return field(&PackingRecord::screening, member);
}

auto size_in_cycle(std::vector<double> measure::SizeTable::*member) {
    return field(&PackingRecord::screening, &Screening::by_size, member);
}

std::vector<PackingTable> batch_tables() {
    return {
        {"sizes",
         "sizes",
         scenario::is_screen,
         {{{"diameter", "m", "Diameter of the grains of one size, from the smallest; only of screens"},
           size(&Screening::diameter)},
          {{"number", "1",
            "Grains of this size at first; with a feed, that passed the screen or left over its edge in "
            "the cycles that count"},
           size(&Screening::number)},
          {{"mass", "kg", "Mass of one of them"}, size(&Screening::mass)},
          {{"passed", "1", "How many of them passed the screen"}, size(&Screening::passed)}}},
        {"screen",
         "cycles + 1",
         is_batch,
         {{{"passed", "1", "Grains that passed the screen in the cycle that ends; only of screens"},
           at_end_of_cycle(&measure::OpenSeries::left)},
          {{"passed_mass", "kg", "Their mass"}, at_end_of_cycle(&measure::OpenSeries::left_mass)},
          {{"held", "1", "Grains on the screen at the end of cycle 0 ... n"},
           at_end_of_cycle(&measure::OpenSeries::held)},
          {{"held_mass", "kg", "Their mass"}, at_end_of_cycle(&measure::OpenSeries::held_mass)},
          {{"layer_mass", "kg",
            "Mass of the layer whose speed is measured, mean over the cycle: grains with their centres above "
            "the screen"},
           at_end_of_cycle(&measure::OpenSeries::window_mass)}}},
        {"passed",
         "grains",
         is_batch,
         {{{"cycle", "1", "Cycle in which a grain passed the screen, from 1; only of screens"},
           size(&Screening::passed_cycle)},
          {{"diameter", "m", "Its diameter"}, size(&Screening::passed_diameter)}}},
    };
}

std::vector<PackingTable> fed_screen_tables() {
    using Sizes = measure::SizeTable;
    return {
        {"through",
         "cycles + 1",
         scenario::is_fed_screen,
         {{{"passed", "1",
            "Grains that passed the screen in the cycle that ends; only of screens with a feed"},
           at_end_of_cycle(&measure::OpenSeries::passed)},
          {{"passed_mass", "kg", "Their mass"}, at_end_of_cycle(&measure::OpenSeries::passed_mass)}}},
        {"size_cycles",
         "sizes * (cycles + 1)",
         scenario::is_fed_screen,
         {{{"diameter", "m", "Diameter of the grains of one size; only of screens with a feed"},
           size_in_cycle(&Sizes::diameter)},
          {{"cycle", "1", "Number of the cycle, 0 ... n, of each size"}, size_in_cycle(&Sizes::cycle)},
          {{"fed", "1", "Grains of this size that were fed until its end"}, size_in_cycle(&Sizes::fed)},
          {{"held", "1", "Those that are on the screen then"}, size_in_cycle(&Sizes::held)},
          {{"left", "1", "Those that left over the edge in the cycle"}, size_in_cycle(&Sizes::left)},
          {{"passed", "1", "Those that passed the screen in the cycle"}, size_in_cycle(&Sizes::passed)}}},
    };
}

}  // namespace

std::vector<PackingTable> screen_tables() {
    std::vector<PackingTable> tables = batch_tables();
    for (PackingTable& table : fed_screen_tables()) tables.push_back(std::move(table));
    return tables;
}

std::vector<CaseTable> screen_case_tables() {
    return {partition_table(), screening_table(), partition_cycles_table()};
}

std::vector<Quantity> screen_quantities() {
    std::vector<Quantity> rows;
    add_measured(
        rows, screening(&Screening::efficiency), {"screening_efficiency", "screening_efficiency_half_width"},
        "1",
        "Efficiency of screening: mass of undersize (grains smaller than the opening) that passed the screen "
        "until the end over that at first; with a feed, over all undersize that passed or left over the "
        "edge; "
        "NaN without a screen",
        {.format = "{:.3f}",
         .terminal = terminal_when_known("screening", "efficiency"),
         .report = ReportView{"screening efficiency"}});
    rows.push_back(
        {"screening_efficiency_by_model",
         "1",
         "The same by Gaudin's probability with one attempt in each cycle, see the table partition",
         &efficiency_by_model,
         OverPackings::nothing,
         {{.format = "{:.3f}",
           .terminal = terminal_when_known("by", "model"),
           .report = ReportView{"by model"}}}});
    add_measured(rows, screening(&Screening::passed_share), {"passed_share", "passed_share_half_width"}, "1",
                 "Mass that passed the screen over that at first; with a feed, over all that passed or left",
                 {.format = "{:.3f}", .report = ReportView{"passed"}});
    add_measured(
        rows, screening(&Screening::undersize), {"undersize_share", "undersize_share_half_width"}, "1",
        "Mass share of undersize in what is still on the screen at the end, with a feed in what left over "
        "the "
        "edge; NaN when all have passed",
        {.format = "{:.3f}",
         .terminal = terminal_when_known("undersize", "in oversize"),
         .report = ReportView{"undersize in oversize"}});
    add_measured(
        rows, screening(&Screening::cut_size), {"cut_size", "cut_size_half_width"}, "m",
        "d50 of the partition curve, the size of which half of the grains stay, on straight lines between "
        "the "
        "sizes; NaN when half or more of every size stay, or less than half of the largest",
        {.unit = "mm",
         .factor = 1000,
         .format = "{:.3f}",
         .terminal = terminal_when_known("d50", "mm"),
         .report = ReportView{"d50"}});
    add_measured(
        rows, screening(&Screening::distance), {"screen_distance", "screen_distance_half_width"}, "m",
        "How far the layer on the screen was conveyed: the length of screen that these numbers stand for",
        {.format = "{:.3f}",
         .terminal = terminal_when_known("screen", "m"),
         .report = ReportView{"length of screen"}});
    add_measured(rows, screening(&Screening::underflow), {"underflow", "underflow_half_width"}, "kg/s",
                 "Mass flow through a screen with a feed; outflow is that over its edge",
                 {.unit = "t/h",
                  .factor = tonnes_per_hour,
                  .format = "{:.4g}",
                  .terminal = terminal_when_known("through", "t/h"),
                  .report = ReportView{"through the screen"}});
    for (Quantity& row : rows) row.known_without_mean = true;
    return rows;
}

}  // namespace vibrotrough::store
