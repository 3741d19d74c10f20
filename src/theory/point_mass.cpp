#include "theory/point_mass.hpp"

#include "theory/conveyor.hpp"

#include <cmath>
#include <stdexcept>

namespace vibrotrough::theory {

std::string to_string(PhaseKind kind) {
    switch (kind) {
        case PhaseKind::positive_slide:
            return "P";
        case PhaseKind::negative_slide:
            return "N";
        case PhaseKind::rest:
            return "R";
        case PhaseKind::flight:
            return "F";
        case PhaseKind::positive_slide_after_landing:
            return "P'";
        case PhaseKind::negative_slide_after_landing:
            return "N'";
    }
    throw std::invalid_argument("this is not a phase");
}

std::string to_string(Outcome outcome) {
    switch (outcome) {
        case Outcome::periodic:
            return "the motion is periodic";
        case Outcome::runs_away:
            return "the mass runs away downhill: gravity is stronger than friction, so there is no steady "
                   "speed";
        case Outcome::indifferent:
            return "without friction on a level trough no force drives the mass: it keeps its initial speed";
        case Outcome::unsettled:
            return "no period was found: the efficiency is a mean over the simulated cycles";
    }
    throw std::invalid_argument("this is not an outcome");
}

double machine_number(PointMass const& input) {
    double const b = input.tan_vibration_angle, a = input.tan_inclination;
    return input.throw_number * std::sqrt(1 + b * b) / b / std::sqrt(1 + a * a);  // cos(alpha) / sin(beta)
}

Motion solve(PointMass const& input) {
    Conveyor conveyor{};
    conveyor.point = input;
    return solve(conveyor).motion;
}

}  // namespace vibrotrough::theory
