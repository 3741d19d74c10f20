#include "campaign/schedule/time_to_go.hpp"

#include "deck/deck.hpp"

#include <algorithm>

namespace vibrotrough::campaign {

void TimeToGo::expect(scenario::Scenario const& scenario) {
    expected_ += work(scenario, 1);
}

void TimeToGo::drop(scenario::Scenario const& scenario) {
    expected_ -= work(scenario, 1);
}

void TimeToGo::done(scenario::Scenario const& scenario, int cycles) {
    drop(scenario);
    done_ += work(scenario, cycles);
    cycles_ += cycles;
    ++packings_;
}

double TimeToGo::work(scenario::Scenario const& scenario, double cycles) const {
    // A clump costs what its spheres cost.
    double const spheres =
        is_clump(scenario.grains) ? static_cast<double>(shape_spheres(scenario.grains).size()) : 1;
    return scenario.layer.grains * spheres *
           static_cast<double>(deck::choose_time_step(scenario).steps_per_cycle) * cycles;
}

double TimeToGo::elapsed() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

double TimeToGo::mean_cycles() const {
    constexpr double first_guess = 30;  // typical at a half-width of 0.02
    return packings_ > 0 ? cycles_ / packings_ : first_guess;
}

double TimeToGo::seconds(double under_way) const {
    double const finished = done_ + under_way;
    if (finished <= 0 || elapsed() < 1) return -1;
    double const left = std::max(0.0, expected_ * mean_cycles() - under_way);
    return left / (finished / elapsed());
}

}  // namespace vibrotrough::campaign
