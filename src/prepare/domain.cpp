#include "prepare/domain.hpp"

#include "scenario/model/surface_repair.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

namespace vibrotrough::prepare {

namespace {

/// A surface whose triangles all have angles of half a degree, the engine's soft limit, stays as it is.
std::vector<scenario::Triangle> without_needles_if_any(std::vector<scenario::Triangle> surface, double edge) {
    constexpr double needle = 0.5 / 180 * std::numbers::pi;
    bool const has_any = std::ranges::any_of(
        surface, [](scenario::Triangle const& t) { return scenario::smallest_angle(t) < needle; });
    return has_any ? scenario::without_needles(surface, edge) : surface;
}

}  // namespace

Domain domain_of(scenario::Scenario const& s) {
    bool const has_walls = s.trough.side_wall_friction.has_value();
    if (!s.trough.mesh) return {.is_closed = has_walls};
    scenario::TroughMesh const& mesh = *s.trough.mesh;
    double const unit = metres_in(s.trough.mesh_unit);
    Domain domain{.is_closed = has_walls || mesh.has_upright_sides,
                  .floor_top = unit * mesh.floor_top,
                  .top = unit * mesh.extent[2]};
    std::array<double, 2> const ends{s.layer.length, s.layer.width};
    for (std::string& part : own_parts(s)) domain.parts.push_back({std::move(part), {}});
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        scenario::Triangle triangle = mesh.triangles[i];
        for (scenario::Point& corner : triangle) {
            for (std::size_t k = 0; k < 3; ++k) {
                bool const is_at_end = k < 2 && corner[k] == mesh.extent[k];
                corner[k] = is_at_end ? ends[k] : unit * corner[k];
            }
        }
        auto const part = std::ranges::find(domain.parts, mesh.parts[mesh.part_of[i]], &TroughPart::name);
        (part != domain.parts.end() ? part->surface : domain.surface).push_back(triangle);
    }
    double const edge = 3 * mean_diameter(s);
    domain.surface = without_needles_if_any(std::move(domain.surface), edge);
    for (TroughPart& part : domain.parts)
        part.surface = without_needles_if_any(std::move(part.surface), edge);
    return domain;
}

}  // namespace vibrotrough::prepare
