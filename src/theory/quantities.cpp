#include "theory/quantities.hpp"

#include "theory/detail/instant.hpp"
#include "theory/detail/phases.hpp"
#include "theory/detail/ranges.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/tools/minima.hpp>

namespace vibrotrough::theory {
namespace {

using detail::Forces;
using detail::Instant;
using detail::two_pi;

/// A piece of a motion as a function of time.
class PieceMotion {
  public:
    PieceMotion(Forces const& forces, Piece const& piece)
        : forces_(forces),
          piece_(piece),
          from_(Instant::at(piece.start)),
          v0_(piece.along_velocity - forces.vx()(from_)),
          sign_(slides_forwards(piece.kind) ? 1 : -1),
          slide_(forces.slide(sign_), forces.drag(), sign_ * v0_, from_),
          flight_(forces, from_, piece.gap, piece.gap_rate) {}

    bool flies() const { return piece_.kind == PhaseKind::flight; }
    bool rests() const { return piece_.kind == PhaseKind::rest; }
    double vx(Instant const& at) const { return forces_.vx()(at) + slip(at); }
    double vy(Instant const& at) const {
        return forces_.vy()(at) + (flies() ? flight_.rate(at, flight_.decayed(at.t)) : 0);
    }
    double slip(Instant const& at) const {
        if (rests()) return 0;
        if (!flies()) return sign_ * slide_.speed(at, slide_.decayed(at.t));
        detail::Leap const leap = leap_to(at);
        return v0_ * leap.decay + leap.push;
    }
    double moved(Instant const& at) const {
        if (rests()) return 0;
        if (!flies()) return sign_ * slide_.moved(at, slide_.decayed(at.t));
        detail::Leap const leap = leap_to(at);
        return v0_ * leap.reach + leap.drift;
    }
    double gap(Instant const& at) const {
        return flies() ? std::max(flight_.gap(at, flight_.decayed(at.t)), 0.0) : 0;
    }
    double normal_force(Instant const& at) const {
        return flies() ? 0 : std::max(forces_.normal_force()(at), 0.0);
    }
    double tangential_force(Instant const& at) const {
        if (flies()) return 0;
        return rests() ? forces_.needed_friction()(at)
                       : -sign_ * forces_.kinetic_tangent() * normal_force(at);
    }

  private:
    static bool slides_forwards(PhaseKind kind) {
        return kind == PhaseKind::positive_slide || kind == PhaseKind::positive_slide_after_landing;
    }
    detail::Leap leap_to(Instant const& at) const {
        return detail::leap(forces_, from_, at, flight_.decayed(at.t));
    }

    Forces const& forces_;
    Piece const& piece_;
    Instant from_;
    double v0_, sign_;  // slip velocity at the start, and its direction in a slide
    detail::SlideMotion slide_;
    detail::Ballistic flight_;
};

/// The integral over a piece by Gauss quadrature on intervals of at most `stretch`.
template <class Function>
double integral(Piece const& piece, double stretch, Function const& f) {
    int const parts = std::max(1, static_cast<int>(std::ceil((piece.end - piece.start) / stretch)));
    double const length = (piece.end - piece.start) / parts;
    double sum = 0;
    for (int i = 0; i < parts; ++i) {
        double const from = piece.start + length * i;
        sum += boost::math::quadrature::gauss<double, 15>::integrate(
            [&](double t) { return f(Instant::at(t)); }, from, from + length);
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

/// The largest forces in contact, per mass.
struct LargestForces {
    double normal = 0, tangential = 0;
};

/// The maximum of f over a piece: the largest of equal steps, and then the highest point beside it.
template <class Function>
double largest(Piece const& piece, double step, Function const& f) {
    auto const at = [&](double t) { return f(Instant::at(t)); };
    int const parts = std::max(1, static_cast<int>(std::ceil((piece.end - piece.start) / step)));
    double const width = (piece.end - piece.start) / parts;
    double best = piece.start, most = at(best);
    for (int i = 1; i <= parts; ++i) {
        double const t = piece.start + width * i, value = at(t);
        if (value > most) best = t, most = value;
    }
    auto const found = boost::math::tools::brent_find_minima([&](double t) { return -at(t); },
                                                             std::max(best - width, piece.start),
                                                             std::min(best + width, piece.end), 26);
    return std::max(most, -found.second);
}

/// Every piece is looked at, because the contacts may be a small part of a period.
LargestForces largest_forces(ConveyorMotion const& motion) {
    double const step = shortest_stretch(motion.forces->conveyor()) / 20;
    LargestForces most;
    for (Piece const& piece : motion.pieces) {
        PieceMotion const m(*motion.forces, piece);
        if (m.flies()) continue;
        auto const normal = [&](Instant const& at) { return m.normal_force(at); };
        auto const tangential = [&](Instant const& at) { return std::abs(m.tangential_force(at)); };
        most.normal = std::max(most.normal, largest(piece, step, normal));
        most.tangential = std::max(most.tangential, largest(piece, step, tangential));
    }
    return most;
}

/// The energies of a motion but for the work of the trough, not per cycle.
EnergyBalance losses_of(ConveyorMotion const& motion) {
    require_pieces(motion);
    Forces const& forces = *motion.forces;
    Weights const weight = weights(forces.conveyor());
    double const along = weight.along, normal = weight.normal;
    double const stretch = shortest_stretch(forces.conveyor()), drag = forces.drag();
    EnergyBalance sum{};
    for (Piece const& piece : motion.pieces) {
        PieceMotion const m(forces, piece);
        auto const friction = [&](Instant const& at) { return -m.tangential_force(at) * m.slip(at); };
        auto const drawn = [&](Instant const& at) {
            double const vx = m.vx(at), vy = m.vy(at);
            return along * vx * vx + normal * vy * vy;
        };
        if (!m.flies() && !m.rests()) sum.friction_loss += along * integral(piece, stretch, friction);
        // In flight the velocity changes by the drag only, within 1 / kappa; a flight may last many cycles.
        if (drag > 0) sum.drag_loss += drag * integral(piece, m.flies() ? 2 / drag : stretch, drawn);
        sum.lift += along * forces.gravity() * piece.displacement;
    }
    for (Impact const& i : motion.impacts) {
        sum.impact_loss += normal * (i.approach * i.approach - i.rebound * i.rebound) / 2 +
                           along * (i.along_before * i.along_before - i.along_after * i.along_after) / 2;
    }
    return sum;
}

TraceSample sample_of(Forces const& forces, Piece const& piece, double t, double before) {
    PieceMotion const m(forces, piece);
    Instant const at = Instant::at(t);
    return {t,
            piece.kind,
            forces.vx()(at),
            forces.vy()(at),
            m.vx(at),
            m.vy(at),
            forces.vx().rate(at),
            forces.vy().rate(at),
            before + m.moved(at),
            m.gap(at),
            m.normal_force(at),
            m.tangential_force(at)};
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
        samples.push_back(sample_of(*motion.forces, motion.pieces[p], t, before));
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
    TraceSample found = sample_of(*motion.forces, *current, within, periods * travel + before);
    found.t = t;
    return found;
}

EnergyBalance energy_balance(ConveyorMotion const& motion) {
    EnergyBalance sum = losses_of(motion);
    Forces const& forces = *motion.forces;
    Weights const weight = weights(forces.conveyor());
    double const along = weight.along, normal = weight.normal;
    for (Piece const& piece : motion.pieces) {
        PieceMotion const m(forces, piece);
        if (m.flies()) continue;
        auto const work = [&](Instant const& at) {
            return along * m.tangential_force(at) * forces.vx()(at) +
                   normal * m.normal_force(at) * forces.vy()(at);
        };
        sum.trough_work += integral(piece, shortest_stretch(forces.conveyor()), work);
    }
    for (Impact const& i : motion.impacts) {
        Instant const at = Instant::at(i.t);
        sum.trough_work += normal * (i.approach + i.rebound) * forces.vy()(at) +
                           along * (i.along_after - i.along_before) * forces.vx()(at);
    }
    double const cycles = duration(motion) / two_pi;
    return {sum.trough_work / cycles, sum.friction_loss / cycles, sum.impact_loss / cycles,
            sum.drag_loss / cycles, sum.lift / cycles};
}

ImpactAndPower impact_and_power(ConveyorMotion const& motion, Machine const& machine) {
    EnergyBalance const lost = losses_of(motion);
    PointMass const& point = motion.forces->conveyor().point;
    double const omega = angular_frequency(point, machine), speed = omega * machine.amplitude;
    Weights const weight = weights(motion.forces->conveyor());
    double hardest = 0;  // squared, in (omega r)^2
    for (Impact const& i : motion.impacts)
        hardest = std::max(hardest, weight.normal * i.approach * i.approach +
                                        weight.along * i.along_before * i.along_before);
    double const work = lost.friction_loss + lost.impact_loss + lost.drag_loss + lost.lift;
    return {std::sqrt(hardest) * speed, work * speed * speed * omega / duration(motion)};
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
    Conveyor const& conveyor = motion.forces->conveyor();
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
