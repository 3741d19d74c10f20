#pragma once

#include "theory/drive.hpp"

namespace vibrotrough::learn {

/// m/s: the rule of Daesung Machinery for horizontal vibrating conveyors, v = 3.81 N S in m/min with N in
/// cycles per minute and S, the amplitude, in m; 70 to 80 % of it are used in practice
/// (dsv.co.kr/vibrating_machinery_vc_06.html; validation/daesung).
inline double rule_of_daesung(theory::Drive const& drive) {
    return 3.81 * (60 * drive.frequency) * drive.amplitude / 60;
}

/// The speed of a material without slip on a level or inclined trough, as guidelines such as VDI 2333
/// compute it: it moves with the trough while it touches it and flies for n cycles:
/// v = g n^2 / (2 f) (cos(alpha) cot(beta) - sin(alpha)), with n from the throw number (at most one cycle).
/// Zero when the material is not thrown. m/s. (vibrationsfoerdertechnik.de, on VDI 2333, says which
/// assumptions are made.)
double speed_without_slip(theory::Drive const& drive);

}  // namespace vibrotrough::learn
