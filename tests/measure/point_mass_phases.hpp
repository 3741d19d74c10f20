#pragma once

#include "measure/layer_motion.hpp"
#include "theory/quantities.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vibrotrough::measure {

/// phases.csv as the engine would write it for a layer that moves exactly like the theory's point mass: the
/// mean forces follow from the changes of momentum, including impacts.
class PointMassPhases {
  public:
    static constexpr double amplitude = 0.006;  // m
    static constexpr double mass = 0.01;        // kg
    static constexpr double gravity = 9.81;     // m/s^2

    explicit PointMassPhases(theory::PointMass const& point, double restitution = 0)
        : theory(theory::solve(conveyor_of(point, restitution))), point_(point) {
        int const period = std::max(theory.motion.period_cycles, 1);
        fine_ = theory::trace(theory, samples * period + 1);
        double const cosine = 1 / std::hypot(1, point_.tan_vibration_angle);
        length_x = amplitude * cosine;
        length_z = amplitude * cosine * point_.tan_vibration_angle;
        omega = theory::angular_frequency(point_, {.amplitude = amplitude});
        double const fall = 1 / std::hypot(1, point_.tan_inclination);
        facts = {mass, -gravity * fall * point_.tan_inclination, -gravity * fall, omega / (2 * pi), 2, 2};
    }

    /// The lines of `cycles` cycles.
    PhaseSeries series(int cycles) {
        facts.used = cycles;
        PhaseSeries s;
        double const interval = 2 * pi / (PhaseSeries::per_cycle * omega);
        for (int i = 0; i < cycles * PhaseSeries::per_cycle; ++i) {
            State const before = at(i), now = at(i + 1);
            s.x.push_back(now.x);
            s.z.push_back(now.z);
            s.vx.push_back(now.vx);
            s.vz.push_back(now.vz);
            s.trough_x.push_back(now.trough_x);
            s.trough_z.push_back(now.trough_z);
            s.normal_force.push_back(mass * ((now.vz - before.vz) / interval - facts.gravity_z));
            s.tangential_force.push_back(-mass * ((now.vx - before.vx) / interval - facts.gravity_x));
            // Rounding errors of a free fall must not appear as a force.
            if (std::abs(s.normal_force.back()) < 1e-9 * mass * gravity) s.normal_force.back() = 0;
            s.floor_force.push_back(s.normal_force.back());
            s.touching.push_back(now.touches ? 1 : 0);
            s.touching_vx.push_back(now.touches ? now.vx : 0);
            s.touching_spin.push_back(0);
            s.clearance.push_back(now.z - now.trough_z);
            s.energy_translation.push_back(mass * (now.vx * now.vx + now.vz * now.vz) / 2);
            s.energy_rotation.push_back(0);
            s.overlap.push_back(0);
        }
        return s;
    }

    theory::ConveyorMotion theory;
    LayerFacts facts{};
    double length_x = 0, length_z = 0, omega = 0;

  private:
    static constexpr double pi = std::numbers::pi;
    static constexpr int samples = 20000;  // number of samples of the theory per cycle

    static theory::Conveyor conveyor_of(theory::PointMass const& point, double restitution) {
        theory::Conveyor conveyor;
        conveyor.point = point;
        conveyor.restitution = restitution;
        return conveyor;
    }

    struct State {
        double x, z, vx, vz, trough_x, trough_z;
        bool touches;
    };

    /// The sample at the end of interval i - 1.
    State at(int i) const {
        double const t = 2 * pi * i / PhaseSeries::per_cycle, start = fine_.front().t;
        double const period = fine_.back().t - start;
        double const turns = std::floor((t - start) / period);
        double const place = (t - start - turns * period) / period * static_cast<double>(fine_.size() - 1);
        auto const k = std::min(static_cast<std::size_t>(place), fine_.size() - 2);
        double const part = place - static_cast<double>(k);
        auto const value = [&](auto theory::TraceSample::*field) {
            return (1 - part) * fine_[k].*field + part * fine_[k + 1].*field;
        };
        double const moved = turns * fine_.back().displacement + value(&theory::TraceSample::displacement);
        double const speed_x = omega * length_x, speed_z = omega * length_z;
        return {length_x * (std::sin(t) + moved),
                length_z * (std::sin(t) + value(&theory::TraceSample::gap)),
                speed_x * value(&theory::TraceSample::mass_vx),
                speed_z * value(&theory::TraceSample::mass_vy),
                length_x * std::sin(t),
                length_z * std::sin(t),
                fine_[k].kind != theory::PhaseKind::flight};
    }

    theory::PointMass point_;
    std::vector<theory::TraceSample> fine_;
};

/// The same without the first lines: where a cycle begins is a choice.
inline PhaseSeries without_first(PhaseSeries series, int lines) {
    using S = PhaseSeries;
    for (auto const column :
         {&S::x, &S::z, &S::vx, &S::vz, &S::trough_x, &S::trough_z, &S::normal_force, &S::tangential_force,
          &S::floor_force, &S::touching, &S::touching_vx, &S::touching_spin, &S::clearance,
          &S::energy_translation, &S::energy_rotation, &S::overlap})
        (series.*column).erase((series.*column).begin(), (series.*column).begin() + lines);
    return series;
}

}  // namespace vibrotrough::measure
