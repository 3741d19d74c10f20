#include "store/wear_quantities.hpp"

namespace vibrotrough::store {
namespace {

using Case = CaseRecord const&;
using enum OverPackings;

Field<PackingRecord, std::optional<double>> rate() {
    return packing_field([](auto& packing) -> auto& { return packing.wear.rate; });
}

Field<PackingRecord, std::optional<double>> per_conveyed() {
    return packing_field([](auto& packing) -> auto& { return packing.wear.per_conveyed; });
}

std::optional<double> rate_half_width(Case record) {
    return half_width_over_packings(record, rate());
}

std::optional<double> per_conveyed_half_width(Case record) {
    return half_width_over_packings(record, per_conveyed());
}

template <std::vector<double> measure::Wear::*member>
PackingTable column(std::string_view name, std::string_view units, std::string_view meaning) {
    return {"wear", {name, units, meaning}, packing_field([](auto& p) -> auto& { return p.wear.*member; })};
}

}  // namespace

std::vector<PackingTable> const& wear_tables() {
    using measure::Wear;
    static std::vector<PackingTable> const tables{
        column<&Wear::x>("x", "m", "Centre of a triangle of the trough, along it; only with measure.wear"),
        column<&Wear::y>("y", "m", "The same, across the trough"),
        column<&Wear::z>("z", "m", "The same, normal to it"),
        column<&Wear::area>("area", "m2", "Area of the triangle"),
        column<&Wear::triangle_rates>("rate", "W/m2",
                                      "Its wear per time, over the cycles kept; see wear_rate"),
    };
    return tables;
}

std::vector<Quantity> wear_quantities() {
    constexpr std::string_view half_width =
        "Half-width of the interval of the number before it, Student's t over the packings";
    std::vector<Quantity> rows{
        {"wear_rate",
         "W/m2",
         "Wear of the trough per area and time by Finnie's law of erosion; times Finnie's constant of the "
         "materials, "
         "1/Pa, it is a depth per time; NaN without measure.wear",
         rate(),
         mean,
         {{.place = 993, .format = "{:.3g}", .position = 171, .report = ReportView{"wear rate"}}}},
        {"wear_rate_half_width",
         "W/m2",
         half_width,
         &rate_half_width,
         nothing,
         {{.place = 994, .format = "{:.2g}", .position = 172, .report = ReportView{"\u00b1"}}}},
        {"specific_wear",
         "J/(kg m)",
         "The same wear of the whole surface per mass conveyed and metre of its way; times Finnie's constant "
         "it is a "
         "volume per mass and metre",
         per_conveyed(),
         mean,
         {{.place = 996,
           .unit = "J/t/m",
           .factor = 1000,
           .format = "{:.4g}",
           .position = 173,
           .terminal =
               TerminalView{.heading = "wear", .subheading = "J/t/m", .priority = 4, .only_when_known = true},
           .report = ReportView{"wear per tonne and metre"}}}},
        {"specific_wear_half_width",
         "J/(kg m)",
         half_width,
         &per_conveyed_half_width,
         nothing,
         {{.place = 998,
           .unit = "J/t/m",
           .factor = 1000,
           .format = "{:.2g}",
           .position = 174,
           .terminal = TerminalView{.heading = "+-", .priority = 4, .only_when_known = true},
           .report = ReportView{"\u00b1"}}}},
    };
    for (Quantity& row : rows) row.may_be_missing = row.known_without_mean = true;
    return rows;
}

}  // namespace vibrotrough::store
