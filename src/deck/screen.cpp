#include "deck/screen.hpp"

#include "deck/trough_mesh.hpp"

#include <fmt/format.h>

namespace vibrotrough::deck {

std::string settling_floor(scenario::Scenario const& scenario) {
    return has_holes(scenario) ? "plate" : "trough";
}

std::string screen_mesh(prepare::PreparedCase const& n) {
    scenario::Layer const& layer = n.scenario.layer;
    return screen_stl(layer.length, layer.width, *n.scenario.screen.opening, n.domain.screen->along,
                      n.domain.screen->across);
}

void describe_screen(core::TemplateData& data, prepare::PreparedCase const& n) {
    scenario::Scenario const& s = n.scenario;
    data.set("screen", is_screen(s));
    data.set("plate", has_holes(s));
    data.set("holes", false);
    data.set("loses_grains", n.domain.loses_grains());
    if (!is_screen(s)) return;
    data.set("opening", fmt::format("{}", *s.screen.opening));
    data.set("wire", fmt::format("{}", *s.screen.wire));
    data.set("out_z", fmt::format("{}", n.domain.screen->out_z));
    data.set("catch_z", fmt::format("{}", n.domain.screen->catch_z));
    // The columns of an open trough into which nothing is fed, with the layer above the screen as the window.
    data.set("open_columns", std::string(",fed,fed_mass,left,left_mass,held_mass,window_mass"));
    data.set("open_values", std::string(",0,0,${left},${left_mass},${held_mass},${window_mass}"));
    data.set("open_first_values", std::string(",0,0,0,0,${held_mass},0"));
}

void describe_moving_floor(core::TemplateData& data, prepare::PreparedCase const& n) {
    data.set("plate", false);
    data.set("holes", has_holes(n.scenario));
}

}  // namespace vibrotrough::deck
