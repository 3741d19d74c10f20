#pragma once

#include "example_campaign.hpp"
#include "scenario/model/trough_mesh.hpp"

#include <string>
#include <vector>

// Open troughs of 200 mm by 18 mm with a mesh, in millimetres.
namespace vibrotrough::open_mesh {

/// A floor over the whole width from x = `from` to x = `to`, whose height changes from `start` to `end`.
inline void add_floor(std::vector<scenario::Triangle>& mesh, double from, double to, double start,
                      double end) {
    scenario::Point const a{from, 0, start}, b{to, 0, end}, c{to, 18, end}, d{from, 18, start};
    mesh.push_back({a, b, c});
    mesh.push_back({a, c, d});
}

/// A floor whose height changes over the length.
inline std::vector<scenario::Triangle> slope(double start, double end) {
    std::vector<scenario::Triangle> mesh;
    add_floor(mesh, 0, 200, start, end);
    return mesh;
}

/// A V whose sides are 9 mm high.
inline std::vector<scenario::Triangle> vee() {
    std::vector<scenario::Triangle> mesh;
    for (double const y : {0.0, 18.0}) {
        scenario::Point const a{0, y, 9}, b{200, y, 9}, c{200, 9, 0}, d{0, 9, 0};
        mesh.push_back({a, b, c});
        mesh.push_back({a, c, d});
    }
    return mesh;
}

/// The upright walls of a channel.
inline void add_walls(std::vector<scenario::Triangle>& mesh, double height) {
    for (double const y : {0.0, 18.0}) {
        scenario::Point const a{0, y, 0}, b{200, y, 0}, c{200, y, height}, d{0, y, height};
        mesh.push_back({a, b, c});
        mesh.push_back({a, c, d});
    }
}

/// The example's grains, fed into a trough with the mesh "own.stl".
inline std::string campaign(std::string const& trough = "side_wall_friction = 0\n",
                            std::string const& feed = "mass_flow = \"0.1 t/h\"\n") {
    std::string const text = with("height = \"12 mm\"\n", "", with("36 mm", "200 mm"));
    return with("[grains]\n", "mesh = \"own.stl\"\n" + trough + "[grains]\n", text) + "[feed]\n" + feed;
}

/// The case of a campaign file that names "own.stl".
inline scenario::Scenario scenario_on(std::vector<scenario::Triangle> const& mesh,
                                      std::string const& text = campaign()) {
    return scenario::parse_campaign(text, "test.toml", {{}, {{"own.stl", scenario::stl_text("own", mesh)}}})
        .cases.front();
}

}  // namespace vibrotrough::open_mesh
