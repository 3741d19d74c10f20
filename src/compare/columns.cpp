#include "compare/columns.hpp"

namespace vibrotrough::compare {
namespace {

using Json = nlohmann::ordered_json;

template <class Value>
Json json(std::optional<Value> const& value) {
    return value ? Json(*value) : Json(nullptr);
}

}  // namespace

std::optional<double> difference(Row const& row) {
    if (!row.efficiency_dem || !row.efficiency_theory) return {};
    return *row.efficiency_dem - *row.efficiency_theory;
}

Json to_object(Row const& row) {
    return {{"case", row.id},
            {"throw_number", row.throw_number},
            {"machine_number", row.machine_number},
            {"vibration_angle_deg", row.vibration_angle_deg},
            {"inclination_deg", row.inclination_deg},
            {"friction", row.friction},
            {"amplitude_m", row.amplitude_m},
            {"frequency_hz", row.frequency_hz},
            {"efficiency_dem", json(row.efficiency_dem)},
            {"efficiency_dem_half_width", json(row.efficiency_dem_half_width)},
            {"speed_dem_m_per_s", json(row.speed_dem_m_per_s)},
            {"efficiency_theory", json(row.efficiency_theory)},
            {"mode_theory", row.mode_theory},
            {"mode_layer", json(row.mode_layer)},
            {"efficiency_normal_force", json(row.efficiency_normal_force)},
            {"landing_friction", json(row.landing_friction)},
            {"friction_layer", json(row.friction_layer)},
            {"friction_layer_low", json(row.friction_layer_low)},
            {"friction_layer_high", json(row.friction_layer_high)},
            {"efficiency_theory_layer", json(row.efficiency_theory_layer)},
            {"mode_theory_layer", json(row.mode_theory_layer)},
            {"packings", json(row.packings)},
            {"cycles_measured", json(row.cycles_measured)},
            {"cycles_discarded", json(row.cycles_discarded)},
            {"wall_s", json(row.wall_s)},
            {"outcome", row.outcome}};
}

namespace {

std::string csv_field(Json const& value) {
    if (value.is_null()) return {};
    return value.is_string() ? value.get<std::string>()
                             : value.dump();  // our texts hold no comma and no quote
}

}  // namespace

std::string to_json(std::vector<Row> const& rows) {
    Json array = Json::array();
    for (Row const& row : rows) array.push_back(to_object(row));
    return array.dump(2) + "\n";
}

std::string to_csv(std::vector<Row> const& rows) {
    std::string text;
    Json const columns = to_object(Row{});
    for (auto const& [name, value] : columns.items()) text += (text.empty() ? "" : ",") + name;
    text += "\n";
    for (Row const& row : rows) {
        std::string line;
        Json const object = to_object(row);
        for (auto const& [name, value] : object.items())
            line += (name == "case" ? "" : ",") + csv_field(value);
        text += line + "\n";
    }
    return text;
}

}  // namespace vibrotrough::compare
