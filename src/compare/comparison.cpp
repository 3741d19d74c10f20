#include "compare/comparison.hpp"

#include "atlas/atlas.hpp"
#include "prepare/numerical_errors.hpp"
#include "theory/point_mass.hpp"
#include "theory/rolling_layer.hpp"
#include "theory/tested_range.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <stdexcept>
#include <tuple>

#include <fmt/format.h>

namespace vibrotrough::compare {
namespace {

/// The mode; none when the motion has none, for example when the mass runs away.
std::optional<std::string> known_mode(std::string const& mode) {
    if (mode.empty()) return {};
    return mode;
}

void add_theory(Row& row, prepare::PointMassInputs const& point_mass) {
    prepare::PointMassTheory const theory = point_mass_theory(point_mass);
    row.efficiency_theory = theory.efficiency;
    row.mode_theory = known_mode(theory.mode);
    row.efficiency_theory_restitution = theory.efficiency_restitution;
    row.efficiency_theory_restitution_half_width = theory.half_width_restitution;
    row.mode_theory_restitution = known_mode(theory.mode_restitution);
}

/// The efficiency of the rolling-layer law where it has been tested, else nothing.
std::optional<double> rolling_efficiency(theory::PointMass const& point, theory::RollingLaw const& law,
                                         std::optional<double> depth = {}) {
    if (theory::outside_tested_range(point, depth)) return {};
    theory::Motion const motion = theory::solve(theory::RollingLayer{point, law}).motion;
    if (!motion.converged) return {};
    return motion.velocity_efficiency;
}

/// Adds the rolling-layer law for a layer of spheres that may rotate, with the contacts with which the law
/// has been tested: of one material on a flat floor.
void add_rolling_layer(Row& row, prepare::PreparedCase const& prepared) {
    scenario::Grains const& grains = prepared.scenario.grains;
    bool const spheres = grains.shape == "sphere" && prepared.scenario.layer.block == scenario::Block::none;
    if (!not_covered(prepared.scenario.engine).empty() || prepared.domain.has_mesh()) return;
    if (prepared.materials.size() > 1) return;
    if (!prepared.point_mass.is_plain || !spheres || grains.rotation == scenario::Rotation::blocked) return;
    bool const against_friction = grains.rotation == scenario::Rotation::rolling;
    theory::RollingLaw const law = theory::law_of_grains(against_friction ? grains.rolling_friction : 0);
    double const depth = prepared.layer_height / mean_diameter(prepared.scenario);
    row.efficiency_rolling_layer = rolling_efficiency(prepared.point_mass.conveyor.point, law, depth);
}

/// Adds what the atlas says of a layer that lies inside of it.
void add_atlas(Row& row, prepare::PreparedCase const& prepared) {
    if (prepared.domain.open) return;  // how deep a feed makes its layer was not held against simulations
    atlas::Answer const answer = atlas::predict(prepared);
    if (!answer.is_inside()) return;
    row.efficiency_atlas = answer.efficiency;
    row.efficiency_atlas_half_width = answer.half_width;
    row.atlas_place = answer.place;
}

/// Adds the theory at the friction of the layer as a whole. The effect of side walls is already included in
/// it.
void add_layer_theory(Row& row, prepare::PointMassInputs const& point_mass,
                      MeasuredFriction const& measured) {
    row.friction_layer = measured.friction;
    row.friction_layer_low = measured.low;
    row.friction_layer_high = measured.high;
    theory::Motion const motion = solve(prepare::with_friction(point_mass, measured.friction));
    row.mode_theory_layer = known_mode(motion.mode);
    if (motion.converged) row.efficiency_theory_layer = motion.velocity_efficiency;
}

/// A value of a quantity; none for a number or a word that does not exist.
std::optional<Value> known_value(store::CaseNumber const& value) {
    if (auto const* const whole = std::get_if<int>(&value)) return *whole;
    if (auto const* const word = std::get_if<std::string>(&value))
        return word->empty() ? std::nullopt : std::optional<Value>(*word);
    return value_of(std::get<std::optional<double>>(value));
}

void add_measurement(Row& row, store::CaseRecord const& record) {
    if (!record.layer_mode.empty()) row.layer_mode = record.layer_mode;
    bool const mean = has_mean(record.outcome);  // no mean is reported unless the case is steady
    auto const& all = measured_quantities();
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (!mean && !all[i]->known_without_mean) continue;
        if (auto const known = known_value(all[i]->of_case(record))) row.measured.set(i, known);
    }
}

std::size_t place_of(std::string_view quantity) {
    auto const& all = measured_quantities();
    auto const found = std::ranges::find_if(all, [&](auto const* one) { return one->name == quantity; });
    if (found == all.end()) throw std::out_of_range("no column shows " + std::string(quantity));
    return static_cast<std::size_t>(found - all.begin());
}

constexpr double degrees = 180 / std::numbers::pi;

/// The inputs that are the same along a line of the figure.
using Line = std::tuple<double, double, double>;  // vibration angle and inclination, deg; friction

/// What is drawn along a line.
struct LineModels {
    bool with_law = false;  ///< whether the law of rolling layers speaks of any case on it
    /// The places of its cases in the atlas, by throw number.
    std::map<double, atlas::Place> places = {};
    bool has_twins = false;  ///< whether two of them differ in something else than the throw number

    void add(Row const& row) {
        with_law = with_law || row.efficiency_rolling_layer.has_value();
        if (!row.atlas_place) return;
        auto const [at, is_new] = places.emplace(row.throw_number, *row.atlas_place);
        has_twins = has_twins || (!is_new && at->second != *row.atlas_place);
    }
};

/// What the atlas says of a layer between two cases; nothing beyond the outermost ones.
std::optional<atlas::SurfaceValue> between_cases(LineModels const& models, double throw_number) {
    auto const above = models.places.lower_bound(throw_number);
    if (models.has_twins || above == models.places.end() || above == models.places.begin()) return {};
    auto const below = std::prev(above);
    double const share = (throw_number - below->first) / (above->first - below->first);
    atlas::Place place = below->second;
    for (std::size_t k = 0; k < place.size(); ++k) place[k] += share * (above->second[k] - place[k]);
    return atlas::value_at(place);
}

std::string curve(Line const& line, LineModels const& models, double from, double to) {
    constexpr int points = 400;       // finer than a print shows
    constexpr int each_of_atlas = 8;  // whose lines are smooth
    auto const [angle, inclination, friction] = line;
    std::string text;
    for (int i = 0; i <= points; ++i) {
        double const gamma = from + (to - from) * i / points;
        theory::PointMass const point{.throw_number = gamma,
                                      .tan_vibration_angle = std::tan(angle / degrees),
                                      .tan_inclination = std::tan(inclination / degrees),
                                      .friction = friction};
        theory::Motion const motion = theory::solve(point);
        if (!motion.converged) continue;
        auto const rolling = models.with_law ? rolling_efficiency(point, {}) : std::nullopt;
        auto const layer = i % each_of_atlas == 0 ? between_cases(models, gamma) : std::nullopt;
        text += fmt::format("{:.6g},{},{},{},{},{},{}\n", gamma, angle, inclination, friction,
                            motion.velocity_efficiency, rolling ? fmt::format("{}", *rolling) : "",
                            layer ? fmt::format("{},{}", layer->efficiency, layer->half_width) : ",");
    }
    return text;
}

}  // namespace

std::optional<Value> value_of(std::optional<double> const& number) {
    return number && std::isfinite(*number) ? std::optional<Value>(*number) : std::nullopt;
}

std::string theory_curves_csv(std::vector<Row> const& rows) {
    std::string text =
        "throw_number,vibration_angle_deg,inclination_deg,friction,velocity_efficiency,rolling_layer_"
        "efficiency,atlas_efficiency,atlas_half_width\n";
    std::map<Line, LineModels> lines;
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (Row const& row : rows) {
        bool const moves_along_and_normal = row.vibration_angle_deg > 0 && row.vibration_angle_deg < 90;
        if (row.is_staged || !moves_along_and_normal) continue;
        lines[{row.vibration_angle_deg, row.inclination_deg, row.friction}].add(row);
        least = std::min(least, row.throw_number);
        most = std::max(most, row.throw_number);
    }
    for (auto const& [line, models] : lines) text += curve(line, models, 0.9 * least, 1.1 * most);
    return text;
}

std::vector<store::Quantity const*> const& measured_quantities() {
    static std::vector<store::Quantity const*> const shown = [] {
        std::vector<store::Quantity const*> found;
        for (store::Quantity const& one : store::quantities())
            if (!one.views.empty()) found.push_back(&one);
        return found;
    }();
    return shown;
}

std::optional<Value> MeasuredValues::at(std::size_t place) const {
    if (auto const word = words_.find(place); word != words_.end()) return word->second;
    auto const number = std::ranges::lower_bound(numbers_, place, {}, &Number::place);
    if (number == numbers_.end() || number->place != place) return {};
    return number->is_whole ? Value(static_cast<int>(number->value)) : Value(number->value);
}

void MeasuredValues::set(std::size_t place, std::optional<Value> const& value) {
    words_.erase(place);
    auto number = std::ranges::lower_bound(numbers_, place, {}, &Number::place);
    if (number != numbers_.end() && number->place == place) number = numbers_.erase(number);
    if (!value) return;
    if (auto const* const word = std::get_if<std::string>(&*value)) {
        words_.emplace(place, *word);
        return;
    }
    auto const* const whole = std::get_if<int>(&*value);
    double const known = whole != nullptr ? *whole : std::get<double>(*value);
    numbers_.insert(number, {static_cast<std::uint16_t>(place), whole != nullptr, known});
}

std::optional<Value> Row::of(std::string_view quantity) const {
    return measured.at(place_of(quantity));
}

std::optional<double> Row::number(std::string_view quantity) const {
    auto const value = of(quantity);
    if (!value) return {};
    auto const* const whole = std::get_if<int>(&*value);
    return whole != nullptr ? *whole : std::get<double>(*value);
}

void Row::set(std::string_view quantity, std::optional<Value> const& value) {
    measured.set(place_of(quantity), value);
}

bool is_expected(Row const& row) {
    return row.of("numerics_source") == Value(std::string("expected"));
}

bool disagrees_with_atlas(Row const& row) {
    auto const simulated = row.number("efficiency"), width = row.number("efficiency_half_width");
    if (!simulated || !width || !row.efficiency_atlas) return false;
    return std::abs(*simulated - *row.efficiency_atlas) > *width + *row.efficiency_atlas_half_width;
}

bool is_without_restitution(Row const& row) {
    return row.efficiency_theory && !row.efficiency_theory_restitution;
}

std::optional<std::string> larger_error(Row const& row) {
    auto const statistical = row.number("efficiency_half_width_statistics"),
               numerical = row.number("efficiency_numerics");
    if (!statistical || !numerical) return {};
    return *numerical > *statistical ? "numerical" : "statistical";
}

Row drive_row(std::string const& id, prepare::PreparedCase const& prepared) {
    scenario::Trough const& trough = prepared.scenario.trough;
    Row row{};
    row.id = id;
    if (std::string const open = not_covered(prepared.scenario.engine); !open.empty()) row.not_covered = open;
    if (prepare::is_soft(prepared.scenario)) row.soft = "soft";
    row.throw_number = prepared.throw_number;
    row.machine_number = prepared.machine_number;
    row.vibration_angle_deg = scenario::in_degrees(trough.vibration_angle);
    row.inclination_deg = scenario::in_degrees(trough.inclination);
    row.friction = trough.friction;
    row.amplitude_m = trough.amplitude;
    row.frequency_hz = trough.frequency;
    row.is_staged = !prepared.stages.empty();
    return row;
}

Row compare(std::string const& id, prepare::PreparedCase const& prepared,
            std::optional<store::CaseRecord> const& record, std::string const& outcome,
            std::optional<MeasuredFriction> const& friction) {
    Row row = drive_row(id, prepared);
    row.outcome = record ? std::string(name_of(record->outcome)) : outcome;
    // The theories are for one drive without end.
    if (!row.is_staged) add_theory(row, prepared.point_mass);
    if (!row.is_staged) add_rolling_layer(row, prepared);
    add_atlas(row, prepared);
    if (friction && !row.is_staged) add_layer_theory(row, prepared.point_mass, *friction);
    if (record) add_measurement(row, *record);
    return row;
}

}  // namespace vibrotrough::compare
