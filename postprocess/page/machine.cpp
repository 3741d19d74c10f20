#include "page/machine.hpp"

#include "atlas/tables.hpp"
#include "atlas/value.hpp"
#include "learn/model_errors.hpp"
#include "learn/rules_of_thumb.hpp"
#include "theory/quantities.hpp"
#include "theory/tested_range.hpp"
#include "theory/unusual.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace vibrotrough::page {
namespace {

using theory::Input;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double normal_quantile = 1.959964;  // of 97.5 %: a band of 95 %

/// Which model answers outside of the atlas. validation/rolling_layer: with the largest rolling friction of
/// the atlas' layers, spheres are conveyed as if they could not roll.
Model model_of(double rolling_friction) {
    double const most = atlas::inputs()[atlas::rolling_friction_input].high;
    return rolling_friction <= most ? Model::rolling_layer : Model::point_mass;
}

/// What the atlas is asked of a layer, in the order of atlas::inputs(). The page does not ask for the
/// friction between grains, nor for their restitution.
atlas::KnownNumbers numbers_of(Settings const& settings, double friction) {
    theory::PointMass const point = settings.inputs(friction).point();
    return {point.throw_number,
            point.tan_vibration_angle,
            point.tan_inclination,
            point.friction,
            settings[Setting::stroke_mm] / 2 / settings[Setting::grain_mm],
            settings.depth_in_grains(),
            std::nullopt,
            settings[Setting::rolling_friction],
            std::nullopt};
}

atlas::Place place_of(Settings const& settings, double friction) {
    return atlas::place_of(numbers_of(settings, friction));
}

/// The ends of the friction's band; none when it is known exactly.
std::vector<double> ends_of_friction(Settings const& settings) {
    double const middle = settings[Setting::friction], band = settings[Setting::friction_band];
    if (!(band > 0)) return {};
    return {std::max(middle - band, 0.0), middle + band};
}

std::optional<double> known_depth(Settings const& settings) {
    double const depth = settings.depth_in_grains();
    return std::isfinite(depth) ? std::optional(depth) : std::nullopt;
}

/// What a model misses at such a point, in velocity efficiency; NaN where no layer says it.
double missed(theory::PointMass const& point, std::optional<double> depth, bool rolling) {
    auto const errors = rolling ? learn::rolling_layer_errors() : learn::point_mass_errors();
    return learn::known_error(errors, point.throw_number, point.tan_inclination, depth).value_or(unknown);
}

/// t/h of the whole trough for each m/s.
double flow_of_speed(Settings const& settings) {
    return 3.6 * settings.mass_per_length();
}

/// From a speed to the mass that the whole trough conveys in an hour.
void add_flow(Speed& speed, Settings const& settings) {
    double const factor = flow_of_speed(settings);
    speed.flow = factor * speed.speed;
    speed.flow_low = factor * speed.low;
    speed.flow_high = factor * speed.high;
}

Trust trust_in(Answer const& answer, theory::PointMass const& point, std::optional<double> depth) {
    if (std::isnan(answer.best.low)) return Trust::unknown;
    bool const outside =
        answer.model == Model::rolling_layer && theory::outside_tested_range(point, depth).has_value();
    return outside ? Trust::reaching : Trust::tested;
}

/// The maker gives the rule for level conveyors.
double rule_speed(Settings const& settings) {
    theory::Inputs const inputs = settings.inputs();
    if (settings[Setting::inclination_deg] != 0) return unknown;
    return learn::rule_of_daesung({.frequency = settings[Setting::rpm] / 60,
                                   .amplitude = inputs.amplitude().value(),
                                   .vibration_angle = std::atan(inputs.point().tan_vibration_angle),
                                   .inclination = 0});
}

theory::Machine machine_of(Settings const& settings) {
    return {.amplitude = settings.inputs().amplitude().value()};
}

}  // namespace

std::array<char const*, setting_count> const& setting_names() {
    static constexpr std::array<char const*, setting_count> names{
        "stroke_mm", "rpm",           "vibration_angle_deg", "inclination_deg",
        "friction",  "friction_band", "rolling_friction",    "grain_mm",
        "depth_mm",  "width_mm",      "bulk_density"};
    return names;
}

Settings Settings::with(Setting setting, double other) const {
    Settings changed = *this;
    changed.value[static_cast<std::size_t>(setting)] = other;
    return changed;
}

theory::Inputs Settings::inputs() const {
    return inputs((*this)[Setting::friction]);
}

theory::Inputs Settings::inputs(double friction) const {
    theory::Inputs inputs;
    inputs.set(Input::frequency_hz, (*this)[Setting::rpm] / 60);
    inputs.set(Input::stroke_mm, (*this)[Setting::stroke_mm]);
    inputs.set(Input::vibration_angle_deg, (*this)[Setting::vibration_angle_deg]);
    inputs.set(Input::inclination_deg, (*this)[Setting::inclination_deg]);
    inputs.set(Input::friction, friction);
    return inputs;
}

double Settings::depth_in_grains() const {
    return (*this)[Setting::depth_mm] / (*this)[Setting::grain_mm];
}

double Settings::mass_per_length() const {
    return 1e-6 * (*this)[Setting::depth_mm] * (*this)[Setting::width_mm] * (*this)[Setting::bulk_density];
}

theory::Efficiency Machines::efficiency(theory::PointMass const& point,
                                        std::optional<double> rolling_friction) {
    if (!rolling_friction) return mass_(point);
    if (!layer_ || layer_->first != *rolling_friction)
        layer_.emplace(*rolling_friction, theory::law_of_grains(*rolling_friction));
    theory::Motion const motion = layer_->second(point).motion;
    return {motion.velocity_efficiency, theory::mode_code(motion), motion.period_cycles, motion.outcome};
}

/// Ends and middle of the friction's band; the speed hardly bends between them.
Speed Machines::speed(Settings const& settings, bool rolling) {
    double const scale = settings.inputs().velocity_scale().value();
    auto const grains = rolling ? std::optional(settings[Setting::rolling_friction]) : std::nullopt;
    Speed speed{};
    theory::Efficiency const at_middle = efficiency(settings.inputs().point(), grains);
    speed.efficiency = at_middle.velocity_efficiency;
    speed.mode = at_middle.mode;
    double low = speed.efficiency, high = speed.efficiency;
    for (double const friction : ends_of_friction(settings)) {
        double const eta = efficiency(settings.inputs(friction).point(), grains).velocity_efficiency;
        low = std::min(low, eta);
        high = std::max(high, eta);
    }
    double const error = normal_quantile * missed(settings.inputs().point(), known_depth(settings), rolling);
    bool const runs_away = !std::isfinite(low) || !std::isfinite(high);
    speed.speed = std::isfinite(speed.efficiency) ? scale * speed.efficiency : unknown;
    speed.low = runs_away ? unknown : scale * (low - error);
    speed.high = runs_away ? unknown : scale * (high + error);
    add_flow(speed, settings);
    return speed;
}

Speed Machines::atlas_speed(Settings const& settings) {
    Speed speed{unknown, unknown, unknown, unknown, unknown, unknown, unknown, 0};
    if (!layers_ || !outside_atlas(settings).empty()) return speed;
    auto const value = atlas::value_of(numbers_of(settings, settings[Setting::friction]));
    if (!value) return speed;
    double low = value->efficiency, high = low;
    for (double const friction : ends_of_friction(settings)) {
        auto const eta = atlas::efficiency_at(place_of(settings, friction));
        if (!eta) return speed;
        low = std::min(low, *eta);
        high = std::max(high, *eta);
    }
    double const scale = settings.inputs().velocity_scale().value();
    speed.efficiency = value->efficiency;
    speed.speed = scale * speed.efficiency;
    speed.low = scale * (low - value->half_width);
    speed.high = scale * (high + value->half_width);
    add_flow(speed, settings);
    return speed;
}

void Machines::prepare_atlas() {
    last_.reset();
    layers_ = atlas::simulated_layers();
}

Answer Machines::operator()(Settings const& settings) {
    if (!last_ || last_->first != settings) last_.emplace(settings, answered(settings));
    return last_->second;
}

Answer Machines::answered(Settings const& settings) {
    theory::Inputs const inputs = settings.inputs();
    theory::PointMass const point = inputs.point();
    Answer answer{};
    answer.throw_number = point.throw_number;
    answer.machine_number = theory::machine_number(point);
    answer.trough_speed = inputs.velocity_scale().value();
    answer.depth_in_grains = settings.depth_in_grains();
    answer.rule_speed = rule_speed(settings);
    answer.rule_flow = flow_of_speed(settings) * answer.rule_speed;
    answer.mass = speed(settings, false);
    answer.layer = speed(settings, true);
    answer.atlas = atlas_speed(settings);
    answer.model =
        std::isnan(answer.atlas.speed) ? model_of(settings[Setting::rolling_friction]) : Model::atlas;
    answer.best = answer.model == Model::atlas           ? answer.atlas
                  : answer.model == Model::rolling_layer ? answer.layer
                                                         : answer.mass;
    answer.trust = trust_in(answer, point, known_depth(settings));
    return answer;
}

theory::RollingLayer layer_of(Settings const& settings) {
    return {settings.inputs().point(), theory::law_of_grains(settings[Setting::rolling_friction])};
}

Landing landing(Settings const& settings) {
    auto const motion = theory::solve(theory::Conveyor{.point = settings.inputs().point()});
    auto const found = theory::impact_and_power(motion, machine_of(settings));
    double const mass_per_area = 1e-3 * settings[Setting::depth_mm] * settings[Setting::bulk_density];
    return {found.impact_speed, found.mean_power * mass_per_area};
}

std::vector<Frame> frames(Settings const& settings, bool rolling, int count) {
    theory::PointMass const point = settings.inputs().point();
    theory::Machine const machine = machine_of(settings);
    double const omega = theory::angular_frequency(point, machine),
                 beta = std::atan(point.tan_vibration_angle);
    double const along = machine.amplitude * std::cos(beta), normal = machine.amplitude * std::sin(beta);
    std::vector<Frame> list;
    auto const add = [&](double t, theory::PhaseKind kind, double travel, double gap, double push,
                         double drag) {
        list.push_back({t / omega, static_cast<double>(kind), along * std::sin(t), normal * std::sin(t),
                        travel * along, gap * normal, push * omega * omega * normal,
                        drag * omega * omega * along});
    };
    if (rolling) {
        double travel = 0;
        auto const samples = theory::trace(theory::solve(layer_of(settings)), count);
        for (std::size_t i = 0; i < samples.size(); ++i) {
            theory::RollingSample const& s = samples[i];
            // The trapezoidal rule: the sum is only drawn.
            if (i > 0) travel += (s.t - samples[i - 1].t) * (s.velocity + samples[i - 1].velocity) / 2;
            add(s.t, s.kind, travel, s.gap, s.normal_force, s.tangential_force);
        }
    } else {
        auto const motion = theory::solve(settings.inputs().conveyor());
        if (motion.motion.outcome != theory::Outcome::periodic)
            throw std::invalid_argument(theory::to_string(motion.motion.outcome));
        auto const samples = theory::trace(motion, count);
        // The solver may have followed many cycles before it found the period.
        double const cycles = std::floor(samples.front().t / (2 * std::numbers::pi));
        for (theory::TraceSample const& s : samples) {
            add(s.t - 2 * std::numbers::pi * cycles, s.kind, s.displacement, s.gap, s.normal_force,
                s.tangential_force);
        }
    }
    return list;
}

std::optional<std::string> untested(Settings const& settings, Answer const& answer) {
    if (answer.trust == Trust::tested) return {};
    if (std::isnan(answer.best.speed)) return "the material runs away";
    if (answer.model == Model::rolling_layer) {
        if (auto why = theory::outside_tested_range(settings.inputs().point(), known_depth(settings)))
            return why;
    }
    return "no simulated layer tells what the model misses here";
}

std::vector<atlas::Outside> outside_atlas(Settings const& settings) {
    auto outside = atlas::outside_ranges(place_of(settings, settings[Setting::friction]));
    if (!outside.empty()) return outside;
    // Of the ends of the friction's band it is enough that they are near: the interval is that of the middle.
    for (double const friction : ends_of_friction(settings)) {
        atlas::Place const end = place_of(settings, friction);
        if (atlas::is_far_outside(end)) return atlas::outside_ranges(end);
    }
    return {};
}

std::vector<std::string> unusual(Settings const& settings, Answer const& answer) {
    return theory::unusual_numbers({settings[Setting::rpm] / 60, settings[Setting::stroke_mm] / 2000,
                                    answer.machine_number, settings[Setting::friction]});
}

}  // namespace vibrotrough::page
