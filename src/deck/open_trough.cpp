#include "deck/open_trough.hpp"

#include "deck/deck_data.hpp"

#include <cmath>
#include <initializer_list>
#include <utility>

#include <fmt/format.h>

namespace vibrotrough::deck {
namespace {

/// A grain that falls from fill_top and is turned by another one flies up to 2 fill_top far, and down a slope
/// it rolls to the edge. There it leans on the gate, which has no friction then, so that it carries none of
/// the weight.
void describe_gate(core::TemplateData& data, prepare::PreparedCase const& n) {
    scenario::Scenario const& s = n.scenario;
    bool const slopes = n.domain.floor_top > 0;
    if (s.layer.length - n.domain.open->feed_end >= 2 * n.fill_top && !slopes) return;
    data.set("gate", fmt::format("{}", s.layer.length));
    if (slopes) data.set("gate_model", std::string(name_of(s.engine.contact)));
}

}  // namespace

void describe_open(core::TemplateData& data, prepare::PreparedCase const& n, int packing) {
    constexpr double late_cycles = 3, late_grains = 10;  // of the feed, that found no room
    scenario::Scenario const& s = n.scenario;
    data.set("open", n.domain.open.has_value());
    data.set("gate", false);
    for (char const* name : {"open_columns", "open_values", "open_first_values"})
        data.set(name, std::string());
    if (!n.domain.open) return;
    // What came and went, in addition to the other columns of cycles.csv.
    data.set("open_columns", std::string(",fed,fed_mass,left,left_mass,held_mass,window_mass"));
    data.set("open_values",
             std::string(",${fed},${fed_mass},${left},${left_mass},${held_mass},${window_mass}"));
    data.set("open_first_values", std::string(",0,0,0,0,${held_mass},0"));
    prepare::OpenTrough const& open = *n.domain.open;
    describe_gate(data, n);
    double const flow = *s.feed.mass_flow;
    data.set("mass_flow", fmt::format("{}", flow));
    data.set("feeds_per_cycle", std::to_string(prepare::feeds_per_cycle));
    data.set("feed_steps", std::to_string(n.time.steps_per_cycle / prepare::feeds_per_cycle));
    data.set("feed_seed", std::to_string(seed_number(5000 + packing)));
    data.set("feed_distribution_seed", std::to_string(seed_number(6100 + packing)));
    for (auto const& [name, value] :
         std::initializer_list<std::pair<char const*, double>>{{"feed_start", open.feed_start},
                                                               {"feed_end", open.feed_end},
                                                               {"feed_bottom", open.feed_bottom},
                                                               {"feed_top", open.feed_top},
                                                               {"feed_speed", open.feed_speed},
                                                               {"window_start", open.window_start},
                                                               {"window_end", open.window_end},
                                                               {"out_x", open.out_x},
                                                               {"out_near_x", open.out_near_x},
                                                               {"out_z", open.out_z},
                                                               {"along_bin", open.bin}})
        data.set(name, fmt::format("{}", value));
    double const largest =
        n.mass / s.layer.grains * std::pow(n.classes.front().diameter / mean_diameter(s), 3);
    data.set("overfull_mass",
             fmt::format("{:.6g}", late_cycles * flow / s.trough.frequency + late_grains * largest));
}

}  // namespace vibrotrough::deck
