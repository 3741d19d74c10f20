#include "learn/makers_rule.hpp"

namespace vibrotrough::learn {

double rule_of_daesung(theory::Drive const& drive) {
    return 3.81 * (60 * drive.frequency) * drive.amplitude / 60;
}

}  // namespace vibrotrough::learn
