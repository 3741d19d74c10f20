#include "campaign/schedule/remaining_time.hpp"

#include <algorithm>

namespace vibrotrough::campaign {

void RemainingTime::expect(prepare::PreparedCase const& prepared) {
    expected_ += prepared.grain_steps(1);
}

void RemainingTime::drop(prepare::PreparedCase const& prepared) {
    expected_ -= prepared.grain_steps(1);
}

void RemainingTime::done(prepare::PreparedCase const& prepared, int cycles) {
    drop(prepared);
    done_ += prepared.grain_steps(cycles);
    cycles_ += cycles;
    ++packings_;
}

double RemainingTime::elapsed() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

double RemainingTime::mean_cycles() const {
    constexpr double first_guess = 30;  // typical at a half-width of 0.02
    return packings_ > 0 ? cycles_ / packings_ : first_guess;
}

double RemainingTime::seconds(double under_way) const {
    double const finished = done_ + under_way;
    if (finished <= 0 || elapsed() < 1) return -1;
    double const left = std::max(0.0, expected_ * mean_cycles() - under_way);
    return left / (finished / elapsed());
}

}  // namespace vibrotrough::campaign
