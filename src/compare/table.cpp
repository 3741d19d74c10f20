#include "compare/comparison.hpp"

#include <algorithm>
#include <array>
#include <functional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::compare {
namespace {

using Json = nlohmann::ordered_json;

template <class Value>
Json json(std::optional<Value> const& value) {
    return value ? Json(*value) : Json(nullptr);
}

/// The columns of JSON and CSV: a contract with scripts.
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

std::string csv_field(Json const& value) {
    if (value.is_null()) return {};
    return value.is_string() ? value.get<std::string>()
                             : value.dump();  // our texts hold no comma and no quote
}

std::string shown(std::optional<double> const& value, char const* format) {
    return value ? fmt::format(fmt::runtime(format), *value) : "-";
}

using Cells = std::vector<std::string>;

Cells cells(Row const& row) {
    std::optional<double> difference;
    if (row.efficiency_dem && row.efficiency_theory)
        difference = *row.efficiency_dem - *row.efficiency_theory;
    return {row.id,
            fmt::format("{:.3f}", row.throw_number),
            fmt::format("{:.2f}", row.vibration_angle_deg),
            fmt::format("{:.2f}", row.inclination_deg),
            fmt::format("{:.3g}", row.friction),
            fmt::format("{:.2f}", row.frequency_hz),
            shown(row.efficiency_dem, "{:.3f}") + " +- " + shown(row.efficiency_dem_half_width, "{:.3f}"),
            shown(row.efficiency_theory, "{:.3f}"),
            shown(row.friction_layer, "{:.3f}"),
            shown(row.efficiency_theory_layer, "{:.3f}"),
            shown(difference, "{:+.3f}"),
            row.mode_theory.empty() ? "-" : row.mode_theory,
            row.mode_layer.value_or("-"),
            shown(row.speed_dem_m_per_s, "{:.3f}"),
            row.cycles_measured ? fmt::format("{}+{}", *row.cycles_discarded, *row.cycles_measured) : "-",
            row.outcome};
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

std::string to_table(std::vector<Row> const& rows) {
    std::vector<Cells> table{
        {"case", "Gamma", "beta", "alpha", "mu", "f", "eta DEM", "eta theory", "mu layer", "eta theory",
         "difference", "mode", "mode", "speed", "cycles", "outcome"},
        {"", "", "deg", "deg", "", "Hz", "", "at mu", "", "at mu layer", "", "theory", "layer", "m/s",
         "cut+kept", ""}};
    for (Row const& row : rows) table.push_back(cells(row));
    std::vector<std::size_t> widths(table.front().size(), 0);
    for (Cells const& line : table) {
        for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
    }
    std::string text;
    for (Cells const& line : table) {
        std::string shown_line;
        for (std::size_t i = 0; i < line.size(); ++i) {
            bool const is_text = i == 0 || i + 1 == line.size();
            shown_line += is_text ? fmt::format("{:<{}}  ", line[i], widths[i])
                                  : fmt::format("{:>{}}  ", line[i], widths[i]);
        }
        text += shown_line.substr(0, shown_line.find_last_not_of(' ') + 1) + "\n";
    }
    return text;
}

}  // namespace vibrotrough::compare
