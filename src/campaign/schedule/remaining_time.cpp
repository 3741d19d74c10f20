#include "campaign/schedule/remaining_time.hpp"

#include <algorithm>

namespace vibrotrough::campaign {

void RemainingTime::expect(double work) {
    expected_ += work;
}

PackingTime& PackingTime::operator+=(PackingTime const& other) {
    settling += other.settling;
    moving += other.moving;
    settled += other.settled;
    return *this;
}

void RemainingTime::done(double work, PackingTime const& taken) {
    done_ += work;
    taken_ += taken;
}

double RemainingTime::elapsed() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

double RemainingTime::seconds(double under_way, PackingTime const& running, int not_started) const {
    double const finished = done_ + under_way, so_far = elapsed();
    if (finished <= 0 || so_far < 1) return -1;
    double const left = std::max(0.0, expected_ - under_way);
    PackingTime taken = taken_;
    taken += running;
    double const engines = (taken.settling + taken.moving) / so_far;
    if (engines <= 0) return left / finished * so_far;
    double const to_settle = taken.settled > 0 ? not_started * taken.settling / taken.settled : 0;
    return (left / finished * taken.moving + to_settle) / engines;
}

}  // namespace vibrotrough::campaign
