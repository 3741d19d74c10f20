#pragma once

#include "prepare/prepared_case.hpp"
#include "store/case_record.hpp"

#include <optional>
#include <string>
#include <vector>

namespace vibrotrough::compare {

/// One case: what was measured beside what the point-mass theory predicts. What has no value is not known.
/// What its members mean is said in the table of columns, columns.cpp.
struct Row {
    std::string id;
    double throw_number;
    double machine_number;
    double vibration_angle_deg;
    double inclination_deg;
    double friction;  ///< grain on trough
    double amplitude_m;
    double frequency_hz;
    std::optional<double> efficiency_dem;             ///< none when the layer never became steady
    std::optional<double> efficiency_dem_half_width;  ///< of the interval at the campaign's confidence
    std::optional<double> speed_dem_m_per_s;          ///< efficiency_dem * omega r cos(beta)
    std::optional<double> efficiency_theory;          ///< none when the point mass has no mean speed
    std::optional<std::string> mode_theory;
    std::optional<std::string> mode_layer;             ///< the bulk's mode in the theory's letters
    std::optional<double> efficiency_by_normal_force;  ///< of a point mass under the layer's own normal force
    std::optional<double> landing_friction;  ///< tangential over normal impulse of the layer's landing
    std::optional<double> friction_layer;    ///< of the layer as a whole, from a friction test
    std::optional<double> friction_layer_low, friction_layer_high;  ///< its interval
    std::optional<double> efficiency_theory_layer;                  ///< theory at the layer's friction
    std::optional<std::string> mode_theory_layer;
    std::optional<int> packings;          ///< that the interval rests on
    std::optional<int> cycles_measured;   ///< all packings together
    std::optional<int> cycles_discarded;  ///< start-up, all packings together
    std::optional<double> wall_s;         ///< of the engine, all packings together
    std::string outcome;
};

/// The friction of a layer with its interval.
struct MeasuredFriction {
    double friction, low, high;
};

/// Compares one case.
/// @param record    the case's result, when it has one
/// @param outcome   what to say of a case without a result, e.g. "lost-grains" or "open"
/// @param friction  of the layer, when a friction test has measured it
Row compare(std::string const& id, prepare::PreparedCase const& prepared,
            std::optional<store::CaseRecord> const& record, std::string const& outcome,
            std::optional<MeasuredFriction> const& friction = {});

/// The theory's velocity efficiency over a fine grid of throw numbers, for every vibration angle, inclination
/// and friction among the rows, from a little below their smallest throw number to a little above their
/// largest: CSV with the columns throw_number, vibration_angle_deg, inclination_deg, friction,
/// velocity_efficiency. Throw numbers without a mean speed are left out.
std::string theory_curves_csv(std::vector<Row> const& rows);

}  // namespace vibrotrough::compare
