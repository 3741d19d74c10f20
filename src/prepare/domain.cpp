#include "prepare/domain.hpp"

#include <algorithm>

namespace vibrotrough::prepare {

Domain domain_of(scenario::Scenario const& s) {
    if (!s.trough.mesh) return {.is_closed = s.trough.side_wall_friction.has_value()};
    scenario::TroughMesh const& mesh = *s.trough.mesh;
    double const unit = metres_in(s.trough.mesh_unit);
    Domain domain{.is_closed = mesh.has_upright_sides,
                  .surface = mesh.triangles,
                  .floor_top = unit * mesh.floor_top,
                  .top = unit * mesh.extent[2]};
    std::array<double, 2> const ends{s.layer.length, s.layer.width};
    for (scenario::Triangle& triangle : domain.surface) {
        for (scenario::Point& corner : triangle) {
            for (std::size_t k = 0; k < 3; ++k) {
                bool const is_at_end = k < 2 && corner[k] == mesh.extent[k];
                corner[k] = is_at_end ? ends[k] : unit * corner[k];
            }
        }
    }
    return domain;
}

}  // namespace vibrotrough::prepare
