#include "deck/moving_meshes.hpp"

#include "deck/atom_types.hpp"
#include "deck/trough_mesh.hpp"

#include <string>
#include <utility>
#include <vector>

namespace vibrotrough::deck {

void describe_moving_meshes(core::TemplateData& data, prepare::PreparedCase const& n) {
    std::vector<core::TemplateData> parts, walls;
    auto const add = [](std::vector<core::TemplateData>& list, std::string const& mesh,
                        std::string const& file, int type) {
        core::TemplateData one;
        one.set("mesh", mesh);
        one.set("part_file", file);
        one.set("type", std::to_string(type));
        list.push_back(std::move(one));
    };
    for (std::size_t i = 0; i < n.domain.parts.size(); ++i)
        add(parts, part_mesh(i), part_file(i), atom_type_of_part(n, i));
    // A back wall without side walls stands between the upright sides of the trough's own mesh.
    bool const has_side_walls = n.scenario.trough.side_wall_friction.has_value();
    std::vector<std::string> names;
    if (has_side_walls) names = {"left", "right"};
    if (n.domain.open) names.emplace_back("back");
    for (std::string const& name : names) add(walls, name, name + ".stl", has_side_walls ? 3 : 2);
    std::size_t const count = 1 + parts.size() + walls.size() + (is_fed_screen(n.scenario) ? 1 : 0);
    data.set("several_meshes", count > 1);
    data.set("mesh_count", count > 1 ? std::to_string(count) : std::string());
    data.set("mesh_parts", std::move(parts));
    data.set("wall_meshes", std::move(walls));
}

}  // namespace vibrotrough::deck
