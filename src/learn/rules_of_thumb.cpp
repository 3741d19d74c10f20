#include "learn/rules_of_thumb.hpp"

#include "theory/limits.hpp"

#include <cmath>

namespace vibrotrough::learn {

double speed_without_slip(theory::Drive const& drive) {
    double const throw_number = drive.throw_number();
    if (throw_number <= 1) return 0;
    double low = 0, high = 1;  // cycles of flight
    for (int i = 0; i < 60; ++i) {
        double const middle = (low + high) / 2;
        (theory::throw_number_of_flight(middle) < throw_number ? low : high) = middle;
    }
    double const slope =
        std::cos(drive.inclination) / std::tan(drive.vibration_angle) - std::sin(drive.inclination);
    return 9.81 * low * low / (2 * drive.frequency) * slope;
}

}  // namespace vibrotrough::learn
