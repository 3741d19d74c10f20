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
                      n.domain.screen->across, n.domain.screen->plate);
}

int triangles_of_screen(prepare::PreparedCase const& n) {
    if (!has_holes(n.scenario)) return 0;
    scenario::Layer const& layer = n.scenario.layer;
    return screen_triangles(layer.length, layer.width, *n.scenario.screen.opening, n.domain.screen->along,
                            n.domain.screen->across, n.domain.screen->plate);
}

void add_end_wall(std::map<std::string, std::string>& files, prepare::PreparedCase const& n) {
    auto const [top, bottom] = *n.domain.open->end_wall;
    scenario::Layer const& layer = n.scenario.layer;
    files["end.stl"] = cross_wall_stl(layer.width, bottom, top, layer.length, 12 * mean_diameter(n.scenario));
}

namespace {

/// The columns of cycles.csv that a fed screen has behind those of an open trough: what passed, and how many
/// grains of each size there are before those that left and passed are taken out.
void describe_fed_screen(core::TemplateData& data, prepare::PreparedCase const& n) {
    std::string columns = ",passed,passed_mass", values = ",${passed},${passed_mass}", first = ",0,0", sizes;
    std::vector<core::TemplateData> list;
    for (std::size_t i = 1; i <= n.classes.size(); ++i) {
        constexpr double margin = 1e-4;
        double const radius = n.classes[i - 1].diameter / 2;
        core::TemplateData entry;
        entry.set("number", std::to_string(i));
        entry.set("least", fmt::format("{}", radius * (1 - margin)));
        entry.set("most", fmt::format("{}", radius * (1 + margin)));
        entry.set("count", n.classes.size() == 1 ? "c_of_sizes" : fmt::format("c_of_sizes[{}]", i));
        list.push_back(std::move(entry));
        columns += fmt::format(",size_{}", i);
        values += fmt::format(",${{size_{}}}", i);
        first += ",1";
        sizes += fmt::format(" v_is_size_{}", i);
    }
    data.set("screen_sizes", std::move(list));
    data.set("size_variables", sizes);
    data.set("edge", fmt::format("{}", n.scenario.layer.length));
    data.set("layer_bottom", fmt::format("{}", -n.largest_excursion));
    data.set("size_columns", columns);
    data.set("size_values", values);
    data.set("size_first_values", first);
}

}  // namespace

void describe_screen(core::TemplateData& data, prepare::PreparedCase const& n) {
    scenario::Scenario const& s = n.scenario;
    data.set("screen", is_batch(s));
    data.set("fed_screen", is_fed_screen(s));
    data.set("plate", has_holes(s));
    data.set("holes", false);
    data.set("loses_grains", n.domain.loses_grains());
    for (char const* name : {"size_columns", "size_values", "size_first_values"})
        data.set(name, std::string());
    if (!is_screen(s)) return;
    data.set("opening", fmt::format("{}", *s.screen.opening));
    data.set("wire", fmt::format("{}", *s.screen.wire));
    data.set(is_batch(s) ? "out_z" : "passed_z", fmt::format("{}", n.domain.screen->out_z));
    if (is_fed_screen(s)) return describe_fed_screen(data, n);
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
