#include "deck/impacts.hpp"

#include "deck/estimates.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace vibrotrough::deck {
namespace {

constexpr int most_watched = 2;
constexpr double share_of_impact = 0.2;

/// Contacts of a sphere and bytes of one in a list. Layers that are thrown high have fewer.
constexpr double contacts_per_sphere = 1.6, bytes_per_contact = 22;

}  // namespace

WatchedCycles watched_cycles(scenario::Scenario const& scenario) {
    int const last = first_round_cycles(scenario);
    return {std::max(0, last - most_watched), last};
}

int steps_between_lists(prepare::TimeGrid const& time) {
    int steps = std::max(1, static_cast<int>(share_of_impact / time.contact_fraction));
    while (time.steps_per_cycle % steps != 0) --steps;
    return steps;
}

std::string grain_contacts_file(int done) {
    return fmt::format("grain_contacts.{}.dump", done);
}

std::string floor_contacts_file(int done) {
    return fmt::format("floor_contacts.{}.dump", done);
}

std::string masses_file(int done) {
    return fmt::format("masses.{}.dump", done);
}

void describe_impacts(core::TemplateData& data, prepare::PreparedCase const& prepared) {
    data.set("impacts", prepared.scenario.measure.impacts);
    auto const [from, to] = watched_cycles(prepared.scenario);
    data.set("watch_from", std::to_string(from));
    data.set("watch_to", std::to_string(to));
    data.set("watch_steps", std::to_string(steps_between_lists(prepared.time)));
}

double watched_bytes(prepare::PreparedCase const& prepared, double spheres) {
    auto const [from, to] = watched_cycles(prepared.scenario);
    double const lists =
        static_cast<double>(prepared.time.steps_per_cycle) / steps_between_lists(prepared.time);
    return (to - from) * lists * (130 + bytes_per_contact * contacts_per_sphere * spheres);
}

}  // namespace vibrotrough::deck
