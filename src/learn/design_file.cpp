#include "learn/design_file.hpp"

#include "core/note.hpp"
#include "learn/uncertain.hpp"

#include <cmath>
#include <optional>
#include <string>
#include <string_view>

namespace vibrotrough::learn {
namespace {

namespace note = core::note;
using note::Json;

/// Half of the central 95 % over half of the central 99.7 % of a normal distribution.
constexpr double share_of_ends = 1.96 / 3;

/// What the page shows where the design knows nothing of the grains.
constexpr double usual_diameter_mm = 3;

/// A number; null where it is not known.
Json if_known(Json const& from, char const* key) {
    auto const value = note::known_number(from, key);
    return value ? Json(*value) : Json(nullptr);
}

double rounded(double value) {
    constexpr double steps = 1e6;
    return std::round(value * steps) / steps;
}

/// The settings of the page for a machine of the design. @param drive  has what belongs to this machine
Json settings_of(Json const& design, Json const& drive) {
    Json const& task = note::object(design, "task");
    double const low = note::number(design, "friction_low"), high = note::number(design, "friction_high");
    Json settings;
    for (char const* const name : {"stroke_mm", "rpm", "vibration_angle_deg", "inclination_deg"})
        settings[name] = rounded(note::number(drive, name));
    settings["depth_mm"] = rounded(note::number(drive, "layer_depth_mm", 0));
    settings["friction"] = rounded(note::number(design, "friction_median", 0));
    settings["friction_band"] = rounded(share_of_ends * (high - low) / 2);
    settings["width_mm"] = rounded(1e3 * note::number(task, "width_m", 0));
    settings["bulk_density"] = rounded(note::number(task, "bulk_density_kg_per_m3", 0));
    settings["grain_mm"] =
        rounded(note::known_number(task, "grain_diameter_mm", 0).value_or(usual_diameter_mm));
    settings["rolling_friction"] =
        rounded(note::known_number(task, "rolling_friction", 0).value_or(unknown_rolling_friction().mean));
    return settings;
}

/// What the models say that decide, and those beside them.
Json models_of(Json const& design) {
    Json models = Json::array();
    for (char const* const key : {"models", "models_beside"}) {
        bool const is_beside = key == std::string_view("models_beside");
        for (Json const& one : note::list(design, key))
            models.push_back({{"model", note::text(one, "model")},
                              {"is_beside", is_beside},
                              {"speed", note::number(one, "median_speed_m_per_s")},
                              {"flow", note::number(one, "mass_flow_t_per_h")},
                              {"flow_low", if_known(one, "mass_flow_low_t_per_h")},
                              {"flow_high", if_known(one, "mass_flow_high_t_per_h")},
                              {"probability", if_known(one, "probability")}});
    }
    return models;
}

Json machine_of(Json const& design, Json const& drive, Json const& models) {
    return {{"settings", settings_of(design, drive)},
            {"probability", if_known(drive, "probability")},
            {"models", models}};
}

}  // namespace

Json proposed_machines(std::string_view text) {
    Json const design = note::parse(text);
    Json machines = Json::array({machine_of(design, design, models_of(design))});
    for (Json const& speed : note::list(design, "speeds_compared"))
        if (speed.contains("rank") && note::count(speed, "rank", 0) == 2)
            machines.push_back(machine_of(design, speed, Json::array()));
    Json const& task = note::object(design, "task");
    Json assumed = Json::array();
    if (!note::known_number(task, "grain_diameter_mm")) assumed.push_back("grain_mm");
    if (!note::known_number(task, "rolling_friction")) assumed.push_back("rolling_friction");
    return {{"wanted_t_per_h", note::number(design, "mass_flow_wanted_t_per_h", 0)},
            {"confidence", note::number(design, "confidence", 0)},
            {"untested", !note::known_number(design, "probability")},
            {"machines", machines},
            {"assumed", assumed}};
}

}  // namespace vibrotrough::learn
