#include "deck/open_trough.hpp"

#include "deck/deck_data.hpp"
#include "deck/estimates.hpp"
#include "scenario/model/stage_motion.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

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

/// The feed of a part of a staged drive, or of several that are alike.
struct StagedFeed {
    double mass_flow;   ///< kg/s
    double cycle_time;  ///< s
    int first, last;    ///< number of cycles before it, and with it
};

std::vector<StagedFeed> staged_feeds(prepare::PreparedCase const& n) {
    constexpr double rounding = 1e-9;
    std::vector<StagedFeed> feeds;
    for (scenario::DrivePart const& part : drive_parts(n.stages)) {
        double const flow = n.stages[static_cast<std::size_t>(part.stage)].mass_flow;
        int const last = part.first_cycle + part.cycles;
        bool const goes_on = !feeds.empty() && feeds.back().mass_flow == flow &&
                             std::abs(feeds.back().cycle_time / part.cycle_time() - 1) < rounding;
        if (goes_on)
            feeds.back().last = last;
        else
            feeds.push_back({flow, part.cycle_time(), part.first_cycle, last});
    }
    return feeds;
}

bool is_mixture(prepare::PreparedCase const& n) {
    return n.materials.size() > 1;
}

/// kg, of a grain of the feed as the deck gives its classes to the engine.
double mean_mass(prepare::PreparedCase const& n) {
    double mass = 0, number = 0;
    for (prepare::ClassCount const& size : n.classes) {
        double const density = n.materials[static_cast<std::size_t>(size.material)].grains.density;
        mass += size.share * density * std::numbers::pi / 6 * std::pow(size.diameter, 3);
        number += size.share;
    }
    return mass / number;
}

/// How many of the cycles of a part have ended, as a formula of the engine: v_ended are those of all.
std::string ended_of(StagedFeed const& feed) {
    return fmt::format("((v_ended>{0})*(v_ended-{0})-(v_ended>{1})*(v_ended-{1}))", feed.first, feed.last);
}

/// The engine works out how many grains a feed drops at a time when the first cycle after its making begins,
/// with the time step of that cycle: hence the ratio of the cycle times.
void describe_staged_feed(core::TemplateData& data, prepare::PreparedCase const& n, int packing) {
    constexpr int most_seeds = 1700;  // of the primes that seed_number() knows
    std::vector<core::TemplateData> list;
    std::string number = "0", mass = "0", time = "0", due = "0", now = "0";
    double before = 0;
    for (StagedFeed const& feed : staged_feeds(n)) {
        int const index = static_cast<int>(list.size()) + 1;
        double const in_cycle = feed.mass_flow * feed.cycle_time / mean_mass(n);
        long const count = std::lround(in_cycle * (feed.last - feed.first));
        time += fmt::format("+{}*{}", feed.cycle_time, ended_of(feed));
        now += fmt::format("+({})*(${{done}}>={})", feed.cycle_time - before, feed.first);
        before = feed.cycle_time;
        if (count < 1) continue;
        due += fmt::format("+{}*{}", in_cycle, ended_of(feed));
        number += fmt::format("+f_feed_{}[1]", index);
        mass += fmt::format("+f_feed_{}[2]", index);
        core::TemplateData entry;
        entry.set("number", std::to_string(index));
        entry.set("flow_times", fmt::format("{}", feed.mass_flow * feed.cycle_time));
        entry.set("seed", std::to_string(seed_number(7000 + (32 * (packing - 1) + index) % most_seeds)));
        entry.set("count", std::to_string(count));
        entry.set("first_step", std::to_string(static_cast<long>(feed.first) * n.time.steps_per_cycle + 1));
        list.push_back(std::move(entry));
    }
    data.set("feeds", std::move(list));
    data.set("fed_number", number);
    data.set("fed_in_all", mass);
    data.set("time_formula", time);
    data.set("cycle_time_now", now);
    data.set("due_formula", due);
}

/// When a feed is late by so much, its grains found no room for some cycles. Numbers are compared where
/// masses would change with the sizes that happen to be drawn; the engine rounds the number of each drop at
/// random.
void describe_overfull(core::TemplateData& data, prepare::PreparedCase const& n) {
    constexpr double late_cycles = 3, late_grains = 10;  // of the feed, that found no room
    scenario::Scenario const& s = n.scenario;
    double const in_cycle = *s.feed.mass_flow * n.domain.open->longest_cycle;
    bool const by_number = is_mixture(n) || !n.stages.empty();
    data.set("by_number", by_number);
    data.set("fed_grain", fmt::format("{}", mean_mass(n)));
    double const largest =
        n.mass / s.layer.grains * std::pow(n.classes.front().diameter / mean_diameter(s), 3);
    double const drops = prepare::feeds_per_cycle * s.measure.max_cycles;
    double const scatter = 4 * std::sqrt(drops) / 2;
    data.set("overfull_mass",
             fmt::format("{:.6g}", by_number ? late_cycles * in_cycle / mean_mass(n) + late_grains + scatter
                                             : late_cycles * in_cycle + late_grains * largest));
}

}  // namespace

void describe_open(core::TemplateData& data, prepare::PreparedCase const& n, int packing) {
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
    double const beside = (s.layer.width - feed_width(s)) / 2;
    data.set("feed_left", fmt::format("{}", beside));
    data.set("feed_right", fmt::format("{}", s.layer.width - beside));
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
    describe_overfull(data, n);
    data.set("fed_number", std::string("f_feed[1]"));
    data.set("fed_in_all", std::string("f_feed[2]"));
    if (!n.stages.empty()) describe_staged_feed(data, n, packing);
}

void check_filling(std::vector<Finding>& findings, prepare::PreparedCase const& c) {
    scenario::Scenario const& s = c.scenario;
    double const cycles = 1.25 * s.layer.length / expected_speed(s) * s.trough.frequency;
    findings.push_back(
        most(filling_item, "measure.min_cycles", cycles / expected_cycles(s), 0.5, never,
             fmt::format("raise it to {:.0f} or more, and max_cycles with it, so that the trough is full for "
                         "half of the cycles",
                         std::ceil(2 * cycles))));
    // A narrow stream may make a heap.
    double const needed = layer_under_feed(s) * s.layer.width / feed_width(s) + 2 * largest_diameter(s);
    findings.push_back(
        most("expected layer and two grains / height of the feed", "feed.height", needed / feed_height(s), 1,
             never,
             fmt::format("the case may end as overfull: raise it to {:.3g} mm or more, or feed less; the "
                         "expected layer is known within a factor of two",
                         1e3 * needed)));
}

}  // namespace vibrotrough::deck
