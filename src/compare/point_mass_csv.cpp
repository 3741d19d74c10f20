#include "compare/point_mass_csv.hpp"

#include "theory/quantities.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

namespace vibrotrough::compare {

std::optional<PointMassMotion> point_mass_motion(prepare::PreparedCase const& prepared) {
    scenario::Trough const& trough = prepared.scenario.trough;
    theory::Conveyor const& conveyor = prepared.point_mass.conveyor;
    theory::ConveyorMotion motion = theory::solve(conveyor);
    if (!prepared.stages.empty()) return {};
    if (motion.motion.outcome != theory::Outcome::periodic) return {};
    double const length_x = length_scale(trough);
    return PointMassMotion{.motion = std::move(motion),
                           .scale = {.length_x = length_x,
                                     .length_z = length_x * conveyor.point.tan_vibration_angle,
                                     .angular_frequency = prepared.angular_frequency,
                                     .phase_at_start = prepared.point_mass.start_phase}};
}

std::string point_mass_csv(PointMassMotion const& point_mass) {
    auto const& [motion, scale] = point_mass;
    auto const& [along, normal, omega, phase_at_start] = scale;
    constexpr int per_cycle = 360;
    std::string text =
        "cycles,phase,gap_m,relative_displacement_m,velocity_x_m_per_s,velocity_z_m_per_s,"
        "relative_velocity_x_m_per_s,relative_velocity_z_m_per_s,"
        "normal_force_n_per_kg,tangential_force_n_per_kg\n";
    double const start = theory::sample(motion, phase_at_start).displacement;
    for (int i = 0; i <= per_cycle * motion.motion.period_cycles; ++i) {
        double const cycles = static_cast<double>(i) / per_cycle;
        theory::TraceSample const s =
            theory::sample(motion, phase_at_start + 2.0 * std::numbers::pi * cycles);
        text +=
            fmt::format("{:.6g},{},{:.7g},{:.7g},{:.7g},{:.7g},{:.7g},{:.7g},{:.7g},{:.7g}\n", cycles,
                        theory::to_string(s.kind), normal * s.gap, along * (s.displacement - start),
                        omega * along * s.mass_vx, omega * normal * s.mass_vy,
                        omega * along * (s.mass_vx - s.trough_vx), omega * normal * (s.mass_vy - s.trough_vy),
                        omega * omega * normal * s.normal_force, omega * omega * along * s.tangential_force);
    }
    return text;
}

}  // namespace vibrotrough::compare
