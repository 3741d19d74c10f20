#include "campaign/schedule/remaining_time.hpp"

#include <algorithm>

namespace vibrotrough::campaign {

void RemainingTime::expect(double work) {
    expected_ += work;
}

void RemainingTime::done(double work) {
    done_ += work;
}

double RemainingTime::elapsed() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

double RemainingTime::seconds(double under_way) const {
    double const finished = done_ + under_way;
    if (finished <= 0 || elapsed() < 1) return -1;
    double const left = std::max(0.0, expected_ - under_way);
    return left / (finished / elapsed());
}

}  // namespace vibrotrough::campaign
