#include "store/measured_quantity.hpp"
#include "store/screen_quantities.hpp"

namespace vibrotrough::store {
namespace {

using measure::Screening;

/// A column of a table with one value for the end of each cycle.
template <std::vector<double> measure::OpenSeries::*member>
PackingTable of_cycles(std::string_view group, std::string_view name, std::string_view units,
                       std::string_view meaning) {
    return {
        group, {name, units, meaning}, packing_field([](auto& p) -> auto& { return p.series.open.*member; })};
}

template <std::vector<double> Screening::*member>
PackingTable of_screening(std::string_view group, std::string_view name, std::string_view units,
                          std::string_view meaning) {
    return {
        group, {name, units, meaning}, packing_field([](auto& p) -> auto& { return p.screening.*member; })};
}

template <std::vector<double> measure::SizeTable::*member>
PackingTable of_size_cycles(std::string_view name, std::string_view units, std::string_view meaning) {
    return {"size_cycles", {name, units, meaning}, packing_field([](auto& p) -> auto& {
                return p.screening.by_size.*member;
            })};
}

}  // namespace

std::vector<PackingTable> const& size_tables() {
    static std::vector<PackingTable> const tables{
        of_screening<&Screening::diameter>("sizes", "diameter", "m",
                                           "Diameter of the grains of one size, from the smallest; only of "
                                           "screens"),
        of_screening<&Screening::number>("sizes", "number", "1",
                                         "Grains of this size at first; with a feed, that passed the screen "
                                         "or left over its edge in the cycles that count"),
        of_screening<&Screening::mass>("sizes", "mass", "kg", "Mass of one of them"),
        of_screening<&Screening::passed>("sizes", "passed", "1", "How many of them passed the screen"),
    };
    return tables;
}

std::vector<PackingTable> const& batch_tables() {
    using Series = measure::OpenSeries;
    static std::vector<PackingTable> const tables{
        of_cycles<&Series::left>("screen", "passed", "1",
                                 "Grains that passed the screen in the cycle that ends; only of screens"),
        of_cycles<&Series::left_mass>("screen", "passed_mass", "kg", "Their mass"),
        of_cycles<&Series::held>("screen", "held", "1", "Grains on the screen at the end of cycle 0 ... n"),
        of_cycles<&Series::held_mass>("screen", "held_mass", "kg", "Their mass"),
        of_cycles<&Series::window_mass>(
            "screen", "layer_mass", "kg",
            "Mass of the layer whose speed is measured, mean over the cycle: grains "
            "with their centres above the screen"),
        of_screening<&Screening::passed_cycle>(
            "passed", "cycle", "1", "Cycle in which a grain passed the screen, from 1; only of screens"),
        of_screening<&Screening::passed_diameter>("passed", "diameter", "m", "Its diameter"),
    };
    return tables;
}

std::vector<PackingTable> const& fed_screen_tables() {
    using Series = measure::OpenSeries;
    using Sizes = measure::SizeTable;
    static std::vector<PackingTable> const tables{
        of_cycles<&Series::passed>(
            "through", "passed", "1",
            "Grains that passed the screen in the cycle that ends; only of screens with a feed"),
        of_cycles<&Series::passed_mass>("through", "passed_mass", "kg", "Their mass"),
        of_size_cycles<&Sizes::diameter>("diameter", "m",
                                         "Diameter of the grains of one size; only of screens with a feed"),
        of_size_cycles<&Sizes::cycle>("cycle", "1", "Number of the cycle, 0 ... n, of each size"),
        of_size_cycles<&Sizes::fed>("fed", "1", "Grains of this size that were fed until its end"),
        of_size_cycles<&Sizes::held>("held", "1", "Those that are on the screen then"),
        of_size_cycles<&Sizes::left>("left", "1", "Those that left over the edge in the cycle"),
        of_size_cycles<&Sizes::passed>("passed", "1", "Those that passed the screen in the cycle"),
    };
    return tables;
}

}  // namespace vibrotrough::store
