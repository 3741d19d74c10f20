#pragma once

#include "core/template.hpp"
#include "deck/clump.hpp"
#include "deck/time_grid.hpp"
#include "scenario/model/scenario.hpp"

#include <optional>
#include <vector>

namespace vibrotrough::deck {

struct ClassCount {
    double diameter;  ///< m
    int count;
};

/// All numbers that the templates show come from this.
struct DeckNumbers {
    std::vector<ClassCount> classes;  ///< largest first, so that the big ones find room
    std::optional<Clump> clump;       ///< of every grain; none for spheres
    double mass;                      ///< kg, of all grains
    double largest_extent;            ///< m, largest diameter of the spheres around the grains
    double fill_bottom, fill_top;     ///< m, between which grains are poured in
    double settle_time_step;          ///< s
    double box_top, box_bottom;       ///< m
    double wall_height;               ///< m, of side walls
    TimeGrid time;
};

DeckNumbers make_numbers(scenario::Scenario const& scenario);

/// The engine's seeds are primes above 10000.
int seed_number(int index);

/// What both decks show.
core::TemplateData describe(scenario::Scenario const& scenario, DeckNumbers const& numbers, int packing);

}  // namespace vibrotrough::deck
