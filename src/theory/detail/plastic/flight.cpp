#include "theory/detail/plastic/flight.hpp"

#include <algorithm>

namespace vibrotrough::theory::detail {
namespace {

constexpr int most_launches = 4000;
constexpr int most_cycles_aloft = 100000;
constexpr double whole_cycle_throw = 3.2969;  // just below sqrt(1 + pi^2), where a flight lasts one cycle
constexpr int longest_orbit = 64;             // take-offs in a period in which the contacts are instantaneous

Instant take_off_at(double inverse_throw) {
    return {std::asin(inverse_throw), inverse_throw, std::sqrt((1 - inverse_throw) * (1 + inverse_throw))};
}

/// d - sin(d) without loss of accuracy.
double sine_defect(double d, double sine) {
    if (std::abs(d) > 0.5) return d - sine;
    double const q = d * d;
    return d * q / 6 * (1 - q / 20 * (1 - q / 42 * (1 - q / 72 * (1 - q / 110 * (1 - q / 156)))));
}

/// d^2/2 - 1 + cos(d) without loss of accuracy.
double cosine_defect(double d, double cosine) {
    double const q = d * d;
    if (std::abs(d) > 0.5) return q / 2 - 1 + cosine;
    return q * q / 24 * (1 - q / 30 * (1 - q / 56 * (1 - q / 90 * (1 - q / 132 * (1 - q / 182)))));
}

/// Height above the trough, and its rate, a time d after a take-off at phase `start` with zero relative
/// normal velocity.
struct Height {
    double inverse_throw, sine, cosine;

    double rate(double d) const {
        return sine * std::sin(d) + cosine * (1 - std::cos(d)) - d * inverse_throw;
    }
    double acceleration(double d) const { return sine * std::cos(d) + cosine * std::sin(d) - inverse_throw; }
    double operator()(double d) const {
        double const half = std::sin(d / 2);
        return 2 * sine * half * half + cosine * sine_defect(d, std::sin(d)) - d * d * inverse_throw / 2;
    }
};

/// The zero of a decreasing function between lo (positive value) and hi (zero or negative value).
template <class Function, class Rate>
double falling_zero(Function const& f, Rate const& rate, double lo, double hi) {
    double x = hi;
    for (int i = 0; i < 400; ++i) {
        double const y = f(x);
        (y > 0 ? lo : hi) = x;
        double const slope = rate(x);
        double next = slope < 0 ? x - y / slope : lo;
        if (!(next > lo && next < hi)) next = lo + (hi - lo) / 2;
        if (std::abs(next - x) <= 2e-16 * x || next == lo || next == hi) return next;
        x = next;
    }
    throw PhaseError("the landing was not found");
}

/// d as a function of q = sqrt(Gamma^2 - 1) for standard flights, with its derivative, at equal steps of q
/// from 0 to pi.
class FlightTable {
  public:
    FlightTable() {
        double lo = 0;
        for (std::size_t i = 0; i < size; ++i) {
            double const q = pi * static_cast<double>(i) / (size - 1);
            auto const f = [&](double d) {
                return q * sine_defect(d, std::sin(d)) - cosine_defect(d, std::cos(d));
            };
            auto const rate = [&](double d) { return q * (1 - std::cos(d)) - sine_defect(d, std::sin(d)); };
            node_[i].d = i == 0 ? 0 : falling_zero(f, rate, lo, two_pi);
            lo = node_[i].d;
            // d(q) from q = C/S: dq/dd = (S C' - C S') / S^2; q = d/4 for small d.
            double const s = sine_defect(lo, std::sin(lo)), c = cosine_defect(lo, std::cos(lo));
            node_[i].rate = i == 0 ? 4 : s * s / (s * s - c * (1 - std::cos(lo)));
        }
    }
    /// Cubic Hermite interpolation; its error is below 1e-6.
    double operator()(double q) const {
        double const x = q * ((size - 1) / pi);
        auto const i = std::min(static_cast<std::size_t>(x), size - 2);
        double const u = x - static_cast<double>(i), w = 1 - u, step = pi / (size - 1);
        Node const &a = node_[i], &b = node_[i + 1];
        return w * w * ((1 + 2 * u) * a.d + u * step * a.rate) +
               u * u * ((1 + 2 * w) * b.d - w * step * b.rate);
    }

  private:
    static constexpr std::size_t size = 257;
    struct Node {
        double d, rate;
    };
    std::array<Node, size> node_{};
};

/// The first landing. Between the zeros of the relative acceleration the height is concave or convex. A
/// concave section from positive to negative has one zero; a convex one may become negative and positive
/// again.
double landing_after(Height const& height, double take_off, double start) {
    auto const rate = [&](double d) { return height.rate(d); };
    double const window =
        pi -
        2 * take_off;  // length of the interval in which the trough accelerates downwards faster than gravity
    double into = std::fmod(start - take_off, two_pi);
    if (into < 0) into += two_pi;
    if (into > (two_pi + window) / 2)
        into = 0;  // rounding: a take-off just before the window counts as being at its beginning
    double lo = std::max(window - into, 0.0);
    // It cannot land while the ballistic parabola is above the highest point of the trough.
    double const root = height.cosine * height.cosine - 2 * height.inverse_throw * (1 - height.sine);
    double const clear = root > 0 ? (height.cosine + std::sqrt(root)) / height.inverse_throw : 0;
    if (clear > lo + two_pi) lo += two_pi * std::floor((clear - lo) / two_pi);
    for (int i = 0; i < most_cycles_aloft; ++i) {
        double const concave_end = lo + two_pi - window;
        if (height(concave_end) <= 0) return falling_zero(height, rate, lo, concave_end);
        lo = concave_end + window;
        if (rate(concave_end) >= 0) continue;
        double lowest = lo;
        if (rate(lo) > 0) {
            auto const fall = [&](double d) { return -height.rate(d); };
            auto const steepness = [&](double d) { return -height.acceleration(d); };
            lowest = falling_zero(fall, steepness, concave_end, lo);
        }
        if (height(lowest) <= 0) return falling_zero(height, rate, concave_end, lowest);
    }
    throw PhaseError("the flight does not end");
}

/// The number of take-offs after which the phase of take-off repeats; 0 if it does not.
int orbit(std::vector<Flight> const& flights) {
    auto const mismatch = [&](int k) {
        Instant const earlier = flights[flights.size() - static_cast<std::size_t>(k)].start;
        double const turns = (flights.back().end.t - earlier.t) / two_pi;
        return std::abs(turns - std::round(turns)) / (1 + turns);
    };
    int const most = std::min(longest_orbit, static_cast<int>(flights.size()));
    for (int k = 1; k <= most; ++k) {
        if (mismatch(k) > 1e-15) continue;
        for (int shorter = 1; shorter < k;
             ++shorter) {  // an alternating approach meets the tolerance for 2 before it does for 1
            if (k % shorter == 0 && mismatch(shorter) < 1e-12) return shorter;
        }
        return k;
    }
    return 0;
}

int cycles_between(Instant a, Instant b) {
    return static_cast<int>(std::lround((b.t - a.t) / two_pi));
}

}  // namespace

Flight standard_flight(double throw_number) {
    static FlightTable const table;
    double const inverse_throw = 1 / throw_number;
    double const q = std::sqrt((throw_number - 1) * (throw_number + 1));
    Instant const start{std::atan2(1, q), inverse_throw, q * inverse_throw};
    double d = table(q);
    for (int i = 0; i < 60; ++i) {
        double const sine = std::sin(d), cosine = std::cos(d);
        double const s = sine_defect(d, sine), rate = q * (1 - cosine) - s;
        double const newton = (cosine_defect(d, cosine) - q * s) / rate;
        double const step = newton / (1 + newton * (q * sine - (1 - cosine)) / rate / 2);  // Halley
        d += step;
        if (std::abs(step) > 3e-6 * d) continue;
        double const half = step * step / 2;
        double const sine_d = sine * (1 - half) + cosine * step, cosine_d = cosine * (1 - half) - sine * step;
        Instant const end{start.t + d, start.sine * cosine_d + start.cosine * sine_d,
                          start.cosine * cosine_d - start.sine * sine_d};
        double const approach = (sine_defect(d, sine_d) - q * (1 - cosine_d)) * inverse_throw;
        return {start, end, std::max(approach, 0.0)};
    }
    throw PhaseError("the landing was not found");
}

Flight plastic_flight(double inverse_throw, Instant start) {
    double const take_off = std::asin(inverse_throw);
    Height const height{inverse_throw, start.sine, start.cosine};
    double const d = landing_after(height, take_off, start.t);
    return {start, Instant::at(start.t + d), std::max(-height.rate(d), 0.0)};
}

void find_normal_motion(double throw_number, NormalMotion& motion) {
    double const inverse_throw = 1 / throw_number;
    auto& flights = motion.flights;
    flights.clear();
    flights.push_back(throw_number <= whole_cycle_throw
                          ? standard_flight(throw_number)
                          : plastic_flight(inverse_throw, take_off_at(inverse_throw)));
    motion.start = flights[0].start;
    double const take_off = motion.start.t;
    for (int i = 0; i < most_launches; ++i) {
        Instant const landing = flights.back().end;
        double const phase = landing.t - two_pi * std::floor(landing.t * (1 / two_pi));
        if (!(phase > take_off && phase < pi - take_off)) {  // the mass stays in contact
            motion.end = motion.start;
            motion.end.t = landing.t - phase + take_off + (phase > take_off ? two_pi : 0);
            motion.cycles = cycles_between(motion.start, motion.end);
            return;
        }
        int const k = orbit(flights);
        if (k > 0) {
            flights.erase(flights.begin(), flights.end() - k);
            motion.start = flights.front().start;
            motion.end = flights.back().end;
            motion.cycles = cycles_between(motion.start, motion.end);
            return;
        }
        flights.push_back(plastic_flight(inverse_throw, landing));
    }
    motion.start = flights.front().start;
    motion.end = flights.back().end;
    motion.cycles = 0;
}

}  // namespace vibrotrough::theory::detail
