#pragma once

#include "atlas/surface.hpp"
#include "prepare/prepared_case.hpp"
#include "store/quantity.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace vibrotrough::compare {

/// A known value of a column.
using Value = std::variant<double, int, std::string>;

/// A number as the value of a column; none where it is not known or not finite.
std::optional<Value> value_of(std::optional<double> const& number);

/// Those values of measured_quantities() that are known, by their places there and in their units. Most are
/// numbers, which are kept in few bytes: a campaign may have 100,000 rows.
class MeasuredValues {
  public:
    /// Nothing where it is not known.
    std::optional<Value> at(std::size_t place) const;
    /// Sets a value, or makes it unknown. @param place  below 65,536
    void set(std::size_t place, std::optional<Value> const& value);

  private:
    struct Number {
        std::uint16_t place;
        bool is_whole;  ///< an int
        double value;
    };
    std::vector<Number> numbers_;  ///< in the order of their places
    std::map<std::size_t, std::string> words_;
};

/// One case: what was measured beside what the point-mass theory predicts. Members without a value are not
/// known. The table of columns, columns.cpp, explains the members.
struct Row {
    std::string id;                                  ///< of the case
    double throw_number;                             ///< Gamma = omega^2 r sin(beta) / (g cos(alpha))
    double machine_number;                           ///< K = omega^2 r / g
    double vibration_angle_deg;                      ///< beta, degrees
    double inclination_deg;                          ///< alpha, degrees, positive when it conveys uphill
    double friction;                                 ///< coefficient, grain on trough
    double amplitude_m;                              ///< r in the direction of vibration, half the stroke, m
    double frequency_hz;                             ///< Hz
    std::optional<double> efficiency_theory;         ///< plastic; none when the point mass has no mean speed
    std::optional<double> efficiency_rolling_layer;  ///< none outside the tested range of that law
    std::optional<double> efficiency_atlas;          ///< none outside the atlas of simulated layers
    std::optional<double> efficiency_atlas_half_width;  ///< of its 95 % interval
    std::optional<atlas::Place> atlas_place;            ///< where in the atlas it lies
    std::optional<std::string> mode_theory;             ///< phases of the plastic point mass in order
    std::optional<std::string> layer_mode;              ///< phases of the layer as a whole in order
    std::optional<double> friction_layer;               ///< of the layer as a whole, from a friction test
    std::optional<double> friction_layer_low;           ///< lower end of its interval
    std::optional<double> friction_layer_high;          ///< upper end of its interval
    std::optional<double> efficiency_theory_layer;      ///< theory at the layer's friction
    std::optional<std::string> mode_theory_layer;       ///< mode at the layer's friction
    std::string outcome;                                ///< how the case ended, or what it waits for
    /// Values of the campaign's swept keys in their order (columns_with_swept); angles in degrees.
    std::vector<std::optional<Value>> swept = {};
    /// Of a row of stage_rows() or contrast_rows(): the values that only these have; empty in other rows.
    std::vector<std::optional<Value>> own = {};
    /// Of each number among the campaign's observables, in their order, the mean and the half-width.
    std::vector<std::optional<Value>> observed = {};
    MeasuredValues measured = {};  ///< of the result; empty without one
    std::optional<double> efficiency_theory_restitution =
        {};  ///< with the case's; none where it has no answer
    std::optional<double> efficiency_theory_restitution_half_width = {};  ///< none where it is exact
    std::optional<std::string> mode_theory_restitution = {};              ///< phases of that point mass
    bool is_staged = false;  ///< whether its drive comes in stages, beside which no theory is shown
    std::optional<std::string> not_covered = {};  ///< by the engine's certificate; none when all is covered
    std::optional<std::string> soft = {};         ///< "soft" when the grains are too soft for the layer

    /// The value of one of measured_quantities(); none when it is not known.
    /// @throws std::out_of_range when no quantity has this name
    std::optional<Value> of(std::string_view quantity) const;
    /// The same of a quantity with numbers.
    std::optional<double> number(std::string_view quantity) const;
    /// Sets it, or makes it unknown.
    void set(std::string_view quantity, std::optional<Value> const& value);
};

/// The quantities of a result that have columns, in the order of store::quantities().
std::vector<store::Quantity const*> const& measured_quantities();

/// Whether the numerical error of a row is what is known beforehand, and not what a study found.
bool is_expected(Row const& row);

/// Whether the atlas and the simulation of a row are apart by more than both intervals.
bool disagrees_with_atlas(Row const& row);

/// Whether the theory with restitution has no answer for a row, although the plastic one has.
bool is_without_restitution(Row const& row);

/// "statistical" or "numerical": the larger of the half-width of the efficiency and its numerical error. None
/// unless both are known.
std::optional<std::string> larger_error(Row const& row);

/// The friction coefficient of a layer as a whole, from a friction test.
struct MeasuredFriction {
    double friction;  ///< the estimate
    double low;       ///< lower end of its confidence interval
    double high;      ///< upper end of its confidence interval
};

/// The row of a case with its drive only, without theory and measurement.
Row drive_row(std::string const& id, prepare::PreparedCase const& prepared);

/// Compares one case with the theory.
/// @param id        of the case
/// @param prepared  its drive and the inputs of the theory
/// @param record    the case's result, when it has one, with the study of its numerical error
/// @param outcome   the state of a case without a result, e.g. "lost-grains" or "open"
/// @param friction  of the layer, when a friction test has measured it
Row compare(std::string const& id, prepare::PreparedCase const& prepared,
            std::optional<store::CaseRecord> const& record, std::string const& outcome,
            std::optional<MeasuredFriction> const& friction = {});

/// The velocity efficiency of the theory over a fine grid of throw numbers, for every combination of
/// vibration angle, inclination and friction among the rows without stages. The grid reaches from 0.9 times
/// their smallest throw number to 1.1 times their largest. CSV with the columns throw_number,
/// vibration_angle_deg, inclination_deg, friction, velocity_efficiency, rolling_layer_efficiency (of free
/// spheres; empty where that law has not been tested), atlas_efficiency and atlas_half_width. The atlas is
/// given at every eighth throw number between the cases that lie inside of it, for a layer between them; not
/// where cases differ in something else. Throw numbers without a mean speed are left out.
std::string theory_curves_csv(std::vector<Row> const& rows);

}  // namespace vibrotrough::compare
