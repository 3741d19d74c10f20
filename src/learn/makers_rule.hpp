#pragma once

#include "theory/drive.hpp"

namespace vibrotrough::learn {

/// m/s: the rule of Daesung Machinery for horizontal vibrating conveyors, v = 3.81 N S in m/min with N in
/// cycles per minute and S, the amplitude, in m; 70 to 80 % of it are used in practice
/// (dsv.co.kr/vibrating_machinery_vc_06.html; validation/daesung).
double rule_of_daesung(theory::Drive const& drive);

}  // namespace vibrotrough::learn
