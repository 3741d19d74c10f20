#include "store/impact_quantities.hpp"

#include "measure/stage_means.hpp"
#include "store/measured_quantity.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace vibrotrough::store {
namespace {

using measure::Impacts;

template <std::optional<double> Impacts::*member>
MeasuredNumber impact_number() {
    return packing_field([](auto& packing) -> auto& { return packing.impacts.*member; });
}

template <std::vector<double> Impacts::*member>
PackingTable impact_column(std::string_view name, std::string_view units, std::string_view meaning) {
    return {
        "impacts", {name, units, meaning}, packing_field([](auto& p) -> auto& { return p.impacts.*member; })};
}

/// The energy classes of all packings, whose ends are the same powers of ten.
struct EnergyClasses {
    std::vector<double> from, to;
};

EnergyClasses classes_of(CaseRecord const& record) {
    EnergyClasses classes;
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (PackingRecord const& packing : record.packings) {
        if (packing.impacts.from.empty()) continue;
        least = std::min(least, packing.impacts.from.front());
        most = std::max(most, packing.impacts.to.back());
    }
    constexpr double within = 1e-6;
    for (double k = std::round(measure::classes_per_decade * std::log10(least));
         std::pow(10, k / measure::classes_per_decade) < most * (1 - within); ++k) {
        classes.from.push_back(std::pow(10, k / measure::classes_per_decade));
        classes.to.push_back(std::pow(10, (k + 1) / measure::classes_per_decade));
    }
    return classes;
}

/// The rate of a packing in the class that begins with this energy; 0 where it had no impacts.
double rate_from(Impacts const& impacts, std::vector<double> const& rates, double energy) {
    constexpr double within = 1e-6;
    for (std::size_t i = 0; i < rates.size(); ++i)
        if (std::abs(impacts.from[i] - energy) < within * energy) return rates[i];
    return 0;
}

constexpr std::string_view impact_interval =
    "Half-width of its interval at measure.confidence, Student's t over the packings; "
    "NaN with one packing";

}  // namespace

std::vector<PackingTable> const& impact_tables() {
    static std::vector<PackingTable> const tables{
        impact_column<&Impacts::from>("energy_from", "J",
                                      "Lower end of a class of energy; only with measure.impacts"),
        impact_column<&Impacts::to>("energy_to", "J", "Its upper end"),
        impact_column<&Impacts::rate>("rate", "kg-1 s-1",
                                      "Impacts between two grains per mass of the layer and time"),
        impact_column<&Impacts::trough_rate>("trough_rate", "kg-1 s-1", "The same of grains with the trough"),
    };
    return tables;
}

std::vector<Entry> const& impact_spectrum_entries() {
    static std::vector<Entry> const entries{
        {"energy_from", "J", "Lower end of a class of energy; only with measure.impacts"},
        {"energy_to", "J", "Its upper end"},
        {"rate", "kg-1 s-1",
         "Impacts between two grains per mass of the layer and time, mean over the packings"},
        {"rate_half_width", "kg-1 s-1", impact_interval},
        {"trough_rate", "kg-1 s-1", "The same of grains with the trough"},
        {"trough_rate_half_width", "kg-1 s-1", impact_interval},
    };
    return entries;
}

std::vector<CaseValues> impact_spectrum_table(CaseRecord const& record) {
    if (!record.scenario.measure.impacts) return {};
    EnergyClasses const classes = classes_of(record);
    std::vector<CaseValues> columns{classes.from, classes.to};
    for (auto const rates : {&Impacts::rate, &Impacts::trough_rate}) {
        std::vector<double> means, half_widths;
        for (double const energy : classes.from) {
            measure::EnsembleNumber rate;
            for (PackingRecord const& packing : record.packings)
                rate.values.push_back(rate_from(packing.impacts, packing.impacts.*rates, energy));
            means.push_back(rate.mean());
            half_widths.push_back(rate.half_width(record.scenario.measure.confidence));
        }
        columns.emplace_back(means);
        columns.emplace_back(half_widths);
    }
    return columns;
}

std::vector<Quantity> impact_quantities() {
    std::vector<Quantity> rows;
    auto const add = [&]<MeasuredNumber (*number)()>(std::string_view name, std::string_view half_width,
                                                     std::string_view units, std::string_view meaning,
                                                     View const& view) {
        add_measured<number>(rows, name, half_width, units, meaning, view);
    };
    add.operator()<&impact_number<&Impacts::power>>(
        "impact_power", "impact_power_half_width", "W/kg",
        "Energy of the impacts between two grains per time and mass of the layer. The energy of an impact is "
        "m* v^2 / 2 with the speed v along the normal at the first touch; NaN without measure.impacts",
        {.place = 1200,
         .format = "{:.3g}",
         .position = 181,
         .terminal = terminal_when_known("impacts", "W/kg"),
         .report = ReportView{"impacts of grains"}});
    add.operator()<&impact_number<&Impacts::energy>>(
        "impact_energy", "impact_energy_half_width", "J",
        "Half of impact_power is in impacts with more energy than this; NaN without impacts",
        {.place = 1204,
         .unit = "uJ",
         .factor = 1e6,
         .format = "{:.3g}",
         .position = 183,
         .terminal = terminal_when_known("impact", "uJ"),
         .report = ReportView{"energy of impacts"}});
    add.operator()<&impact_number<&Impacts::trough_power>>(
        "trough_impact_power", "trough_impact_power_half_width", "W/kg",
        "Energy of the impacts of grains with the trough per time and mass of the layer, with the speed "
        "relative to the trough; a grain that touches the trough already does not hit it again",
        {.place = 1208,
         .format = "{:.3g}",
         .position = 185,
         .report = ReportView{"impacts with the trough"}});
    add.operator()<&impact_number<&Impacts::trough_energy>>(
        "trough_impact_energy", "trough_impact_energy_half_width", "J",
        "Half of trough_impact_power is in impacts with more energy than this; NaN without impacts",
        {.place = 1212,
         .unit = "uJ",
         .factor = 1e6,
         .format = "{:.3g}",
         .position = 187,
         .report = ReportView{"energy of impacts with the trough"}});
    rows.push_back(
        {"brief_impacts", "1",
         "Share of the impacts that a third body parts within a fifth of the duration of the fastest; "
         "their energies are too small, and as many may have been missed",
         impact_number<&Impacts::brief_share>(), OverPackings::mean});
    rows.push_back({"impacts_seen", "1", "Number of impacts that were seen",
                    impact_number<&Impacts::number>(), OverPackings::sum});
    for (Quantity& row : rows) row.may_be_missing = row.known_without_mean = true;
    return rows;
}

}  // namespace vibrotrough::store
