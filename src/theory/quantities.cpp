#include "theory/quantities.hpp"

#include "theory/detail/common/input_check.hpp"
#include "theory/detail/common/instant.hpp"
#include "theory/detail/conveyor/model.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/tools/minima.hpp>

namespace vibrotrough::theory {
namespace {

using detail::two_pi;

/// A piece of a motion with its velocities as functions of time.
class PieceMotion {
  public:
    PieceMotion(ConveyorModel const& model, Piece const& piece)
        : model_(model), piece_(piece), x_(velocity_x()), y_(velocity_y()) {}

    bool flies() const { return piece_.kind == PhaseKind::flight; }
    bool rests() const { return piece_.kind == PhaseKind::rest; }
    double vx(double t) const { return rests() ? model_.trough_vx(t) : x_(t); }
    double vy(double t) const { return flies() ? y_(t) : model_.trough_vy(t); }
    double slip(double t) const { return vx(t) - model_.trough_vx(t); }
    double moved(double t) const {
        return rests() ? 0 : x_.travel(t) - (model_.trough_x(t) - model_.trough_x(piece_.start));
    }
    double gap(double t) const {
        if (!flies()) return 0;
        return piece_.gap + y_.travel(t) - (model_.trough_y(t) - model_.trough_y(piece_.start));
    }
    double normal_force(double t) const { return flies() ? 0 : std::max(model_.normal_force(t), 0.0); }
    double tangential_force(double t) const {
        if (flies()) return 0;
        return rests() ? model_.needed_friction(t) : -sign() * model_.kinetic_tangent() * normal_force(t);
    }

  private:
    double sign() const {
        bool const forward = piece_.kind == PhaseKind::positive_slide ||
                             piece_.kind == PhaseKind::positive_slide_after_landing;
        return forward ? 1 : -1;
    }
    DrivenVelocity velocity_x() const {
        double const u = piece_.along_velocity;
        if (flies()) return model_.flight_velocity_x(piece_.start, u);
        return model_.slide_velocity(sign(), piece_.start, u);
    }
    DrivenVelocity velocity_y() const {
        return model_.flight_velocity_y(piece_.start, model_.trough_vy(piece_.start) + piece_.gap_rate);
    }

    ConveyorModel const& model_;
    Piece piece_;
    DrivenVelocity x_, y_;
};

/// The integral over a piece by Gauss quadrature on intervals of at most a quarter period of the highest
/// harmonic.
double integral(Piece const& piece, double stretch, std::function<double(double)> const& f) {
    int const parts = std::max(1, static_cast<int>(std::ceil((piece.end - piece.start) / stretch)));
    double sum = 0;
    for (int i = 0; i < parts; ++i) {
        double const a = piece.start + (piece.end - piece.start) * i / parts;
        double const b = piece.start + (piece.end - piece.start) * (i + 1) / parts;
        sum += boost::math::quadrature::gauss<double, 15>::integrate(f, a, b);
    }
    return sum;
}

void require_pieces(ConveyorMotion const& motion) {
    if (motion.pieces.empty()) {
        throw std::invalid_argument("this motion does not have a cycle that can be evaluated: " +
                                    to_string(motion.motion.outcome));
    }
}

double duration(ConveyorMotion const& motion) {
    return motion.pieces.back().end - motion.pieces.front().start;
}

double shortest_stretch(Conveyor const& conveyor) {
    int order = 1;
    for (Harmonic const& h : conveyor.along) order = std::max(order, h.order);
    for (Harmonic const& h : conveyor.normal) order = std::max(order, h.order);
    return two_pi / 4 / order;
}

/// cos^2 and sin^2 of the vibration angle: the weights of the two directions in the energy.
struct Weights {
    double along, normal;
};
Weights weights(Conveyor const& conveyor) {
    double const b = conveyor.point.tan_vibration_angle;
    return {1 / (1 + b * b), b * b / (1 + b * b)};
}

struct Forces {
    double normal, tangential;
};

/// The maximum of f over a piece: the largest of equal steps, and then the highest point beside it.
double largest(Piece const& piece, double step, std::function<double(double)> const& f) {
    int const parts = std::max(1, static_cast<int>(std::ceil((piece.end - piece.start) / step)));
    double const width = (piece.end - piece.start) / parts;
    double best = piece.start, most = f(best);
    for (int i = 1; i <= parts; ++i) {
        double const t = piece.start + width * i, value = f(t);
        if (value > most) best = t, most = value;
    }
    auto const found = boost::math::tools::brent_find_minima([&](double t) { return -f(t); },
                                                             std::max(best - width, piece.start),
                                                             std::min(best + width, piece.end), 26);
    return std::max(most, -found.second);
}

/// The largest forces in contact. Every piece is looked at, because the contacts may be a small part of a
/// period.
Forces largest_forces(ConveyorMotion const& motion) {
    double const step = shortest_stretch(motion.model->conveyor()) / 20;
    Forces most{};
    for (Piece const& piece : motion.pieces) {
        PieceMotion const m(*motion.model, piece);
        if (m.flies()) continue;
        auto const most_of = [&](auto const& force) { return largest(piece, step, force); };
        most.normal = std::max(most.normal, most_of([&](double t) { return m.normal_force(t); }));
        most.tangential =
            std::max(most.tangential, most_of([&](double t) { return std::abs(m.tangential_force(t)); }));
    }
    return most;
}

TraceSample sample_of(ConveyorModel const& model, Piece const& piece, double t, double before) {
    PieceMotion const m(model, piece);
    return {t,
            piece.kind,
            model.trough_vx(t),
            model.trough_vy(t),
            m.vx(t),
            m.vy(t),
            model.trough_ax(t),
            model.trough_ay(t),
            before + m.moved(t),
            std::max(m.gap(t), 0.0),
            m.normal_force(t),
            m.tangential_force(t)};
}

}  // namespace

std::vector<TraceSample> trace(ConveyorMotion const& motion, int count) {
    require_pieces(motion);
    detail::require_range(count >= 2 && count <= 10'000'000, "samples", count, "[2, 1e7]");
    std::vector<TraceSample> samples;
    double const start = motion.pieces.front().start, step = duration(motion) / (count - 1);
    double before = 0;
    std::size_t p = 0;
    for (int i = 0; i < count; ++i) {
        double const t = start + i * step;
        while (p + 1 < motion.pieces.size() && t >= motion.pieces[p].end)
            before += motion.pieces[p++].displacement;
        samples.push_back(sample_of(*motion.model, motion.pieces[p], t, before));
    }
    return samples;
}

TraceSample sample(ConveyorMotion const& motion, double t) {
    require_pieces(motion);
    double const start = motion.pieces.front().start;
    double const periods = std::floor((t - start) / duration(motion));
    double const within = std::clamp(t - periods * duration(motion), start, motion.pieces.back().end);
    double travel = 0, before = 0;
    Piece const* current = nullptr;
    for (Piece const& piece : motion.pieces) {
        if (current == nullptr && (within < piece.end || &piece == &motion.pieces.back())) {
            current = &piece;
            before = travel;
        }
        travel += piece.displacement;
    }
    TraceSample found = sample_of(*motion.model, *current, within, periods * travel + before);
    found.t = t;
    return found;
}

EnergyBalance energy_balance(ConveyorMotion const& motion) {
    require_pieces(motion);
    ConveyorModel const& model = *motion.model;
    Weights const weight = weights(model.conveyor());
    double const along = weight.along, normal = weight.normal;
    double const stretch = shortest_stretch(model.conveyor());
    EnergyBalance sum{};
    for (Piece const& piece : motion.pieces) {
        PieceMotion const m(model, piece);
        // In flight the velocity changes by the drag only, within 1 / kappa; a flight may last many cycles.
        double const step = m.flies() ? 2 / model.drag() : stretch;
        auto const over = [&](auto const& f) { return integral(piece, step, f); };
        if (!m.flies()) {
            sum.trough_work += over([&](double t) {
                return along * m.tangential_force(t) * model.trough_vx(t) +
                       normal * m.normal_force(t) * model.trough_vy(t);
            });
            sum.friction_loss += over([&](double t) { return -along * m.tangential_force(t) * m.slip(t); });
        }
        if (model.drag() > 0) {
            sum.drag_loss += model.drag() * over([&](double t) {
                                 return along * m.vx(t) * m.vx(t) + normal * m.vy(t) * m.vy(t);
                             });
        }
        sum.lift += along * model.gravity() * piece.displacement;
    }
    for (Impact const& impact : motion.impacts) {
        double const pushed = impact.approach + impact.rebound,
                     dragged = impact.along_after - impact.along_before;
        sum.trough_work +=
            normal * pushed * model.trough_vy(impact.t) + along * dragged * model.trough_vx(impact.t);
        sum.impact_loss +=
            normal * (impact.approach * impact.approach - impact.rebound * impact.rebound) / 2 +
            along * (impact.along_before * impact.along_before - impact.along_after * impact.along_after) / 2;
    }
    double const cycles = duration(motion) / two_pi;
    return {sum.trough_work / cycles, sum.friction_loss / cycles, sum.impact_loss / cycles,
            sum.drag_loss / cycles, sum.lift / cycles};
}

double angular_frequency(PointMass const& point, Machine const& machine) {
    detail::require_range(machine.amplitude >= 1e-12 && machine.amplitude <= 10, "amplitude",
                          machine.amplitude, "[1e-12, 10] m");
    detail::require_range(machine.gravity >= 1e-6 && machine.gravity <= 1e3, "gravity", machine.gravity,
                          "[1e-6, 1000] m/s2");
    return std::sqrt(machine_number(point) * machine.gravity / machine.amplitude);
}

EngineerQuantities engineer_quantities(ConveyorMotion const& motion, Machine const& machine) {
    require_pieces(motion);
    Conveyor const& conveyor = motion.model->conveyor();
    EngineerQuantities q{};
    q.angular_frequency = angular_frequency(conveyor.point, machine);
    q.frequency = q.angular_frequency / two_pi;
    double const speed = q.angular_frequency * machine.amplitude;  // omega r
    // Not from the squares: that of the smallest vibration angles is zero.
    double const tangent = conveyor.point.tan_vibration_angle, cosine = 1 / std::hypot(1, tangent);
    double const vx = speed * cosine, vy = speed * cosine * tangent;
    q.conveying_speed = motion.motion.velocity_efficiency * vx;
    q.stroke = 2 * machine.amplitude;
    double const mass_per_area = machine.bulk_density * machine.layer_height;
    if (mass_per_area > 0 && machine.layer_width > 0)
        q.mass_flow = mass_per_area * machine.layer_width * q.conveying_speed;
    for (Impact const& impact : motion.impacts) {
        double const down = impact.approach * vy;
        q.normal_impact_speed = std::max(q.normal_impact_speed, down);
        q.impact_speed = std::max(q.impact_speed, std::hypot(down, impact.along_before * vx));
        q.largest_impulse = std::max(q.largest_impulse, (impact.approach + impact.rebound) * vy);
    }
    q.impacts_per_cycle = static_cast<double>(motion.impacts.size()) * two_pi / duration(motion);
    EnergyBalance const energy = energy_balance(motion);
    q.friction_energy = energy.friction_loss * speed * speed;
    q.impact_energy = energy.impact_loss * speed * speed;
    q.trough_work = energy.trough_work * speed * speed;
    q.mean_power = q.trough_work * q.frequency;
    if (mass_per_area > 0) q.power_per_area = q.mean_power * mass_per_area;
    auto const [push, drag] = largest_forces(motion);
    // The smallest vibration angles have the largest of these numbers, and the product with the frequency
    // would be too large.
    q.largest_normal_force = push * vy * q.angular_frequency;
    q.largest_tangential_force = drag * q.angular_frequency * vx;
    return q;
}

std::vector<TraceColumn> const& trace_columns() {
    using S = TraceSample;
    static std::vector<TraceColumn> const columns{
        {"time_rad", "time_s", &S::t},
        {"trough_velocity_x", "trough_velocity_x_m_per_s", &S::trough_vx},
        {"mass_velocity_x", "mass_velocity_x_m_per_s", &S::mass_vx},
        {"trough_velocity_y", "trough_velocity_y_m_per_s", &S::trough_vy},
        {"mass_velocity_y", "mass_velocity_y_m_per_s", &S::mass_vy},
        {"trough_acceleration_x", "trough_acceleration_x_m_per_s2", &S::trough_ax},
        {"trough_acceleration_y", "trough_acceleration_y_m_per_s2", &S::trough_ay},
        {"relative_displacement", "relative_displacement_m", &S::displacement},
        {"gap", "gap_m", &S::gap},
        {"normal_force", "normal_force_n_per_kg", &S::normal_force},
        {"tangential_force", "tangential_force_n_per_kg", &S::tangential_force}};
    return columns;
}

std::vector<TraceSample> in_si_units(std::vector<TraceSample> samples, PointMass const& point,
                                     Machine const& machine) {
    double const omega = angular_frequency(point, machine), time = 1 / omega;
    double const tangent = point.tan_vibration_angle, cosine = 1 / std::hypot(1, tangent);
    double const length_x = machine.amplitude * cosine, length_y = machine.amplitude * cosine * tangent;
    double const speed_x = omega * length_x, speed_y = omega * length_y;
    double const acceleration_x = omega * speed_x, acceleration_y = omega * speed_y;
    for (TraceSample& s : samples) {
        s.t *= time;
        for (double* const value : {&s.trough_vx, &s.mass_vx}) *value *= speed_x;
        for (double* const value : {&s.trough_vy, &s.mass_vy}) *value *= speed_y;
        for (double* const value : {&s.trough_ax, &s.tangential_force}) *value *= acceleration_x;
        for (double* const value : {&s.trough_ay, &s.normal_force}) *value *= acceleration_y;
        s.displacement *= length_x;
        s.gap *= length_y;
    }
    return samples;
}

std::vector<NamedQuantity> listed(EngineerQuantities const& q) {
    std::vector<NamedQuantity> list{{"frequency", "Hz", q.frequency},
                                    {"turns_per_minute", "1/min", 60 * q.frequency},
                                    {"stroke", "mm", 1e3 * q.stroke},
                                    {"conveying_speed", "m/s", q.conveying_speed}};
    if (q.mass_flow) {
        list.push_back({"mass_flow", "kg/s", *q.mass_flow});
        list.push_back({"mass_flow_per_hour", "t/h", 3.6 * *q.mass_flow});
    }
    std::vector<NamedQuantity> const rest{{"impact_speed", "m/s", q.impact_speed},
                                          {"normal_impact_speed", "m/s", q.normal_impact_speed},
                                          {"impacts_per_cycle", "1", q.impacts_per_cycle},
                                          {"friction_energy", "J/kg per cycle", q.friction_energy},
                                          {"impact_energy", "J/kg per cycle", q.impact_energy},
                                          {"trough_work", "J/kg per cycle", q.trough_work},
                                          {"mean_power", "W/kg", q.mean_power}};
    list.insert(list.end(), rest.begin(), rest.end());
    if (q.power_per_area) list.push_back({"power_per_area", "W/m2", *q.power_per_area});
    list.push_back({"largest_normal_force", "N/kg", q.largest_normal_force});
    list.push_back({"largest_tangential_force", "N/kg", q.largest_tangential_force});
    list.push_back({"largest_impulse", "N s/kg", q.largest_impulse});
    return list;
}

}  // namespace vibrotrough::theory
