#include "theory/flight.hpp"

namespace vibrotrough::theory::detail {
namespace {

constexpr int most_launches = 4000;
constexpr int longest_orbit = 64;  // launches in a period that never touches for longer than an instant

/// Height above the trough, and its rate, a time d after a launch at phase `start` without normal velocity.
struct Height {
    double inverse_throw, sine, cosine;

    double rate(double d) const {
        return sine * std::sin(d) + cosine * (1 - std::cos(d)) - d * inverse_throw;
    }
    double acceleration(double d) const { return sine * std::cos(d) + cosine * std::sin(d) - inverse_throw; }
    double operator()(double d) const {
        double const half = std::sin(d / 2);
        return 2 * sine * half * half + cosine * d_minus_sin(d) - d * d * inverse_throw / 2;
    }
    static double d_minus_sin(double d) {
        if (std::abs(d) > 0.5) return d - std::sin(d);
        double const q = d * d;  // Taylor: the difference would lose digits
        return d * q / 6 * (1 - q / 20 * (1 - q / 42 * (1 - q / 72 * (1 - q / 110 * (1 - q / 156)))));
    }
};

/// The zero of a falling function between lo (above zero) and hi (zero or below).
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

/// The first landing. Between the zeros of its acceleration the height is concave or convex: a concave
/// stretch from above to below zero has one zero; a convex one may dip below zero and come up again.
double landing_after(Height const& height, double take_off, double start) {
    auto const rate = [&](double d) { return height.rate(d); };
    double const window = pi - 2 * take_off;  // where the trough accelerates away faster than gravity
    double into = std::fmod(start - take_off, two_pi);
    if (into < 0) into += two_pi;
    if (into > (two_pi + window) / 2) into = 0;  // rounding: a launch just before the window is at its begin
    double lo = std::max(window - into, 0.0);
    // It cannot land while the ballistic parabola is above the trough's highest point.
    double const root = height.cosine * height.cosine - 2 * height.inverse_throw * (1 - height.sine);
    double const clear = root > 0 ? (height.cosine + std::sqrt(root)) / height.inverse_throw : 0;
    if (clear > lo + two_pi) lo += two_pi * std::floor((clear - lo) / two_pi);
    for (int i = 0; i < 100000; ++i) {
        double const concave_end = lo + two_pi - window;
        if (height(concave_end) <= 0) return falling_zero(height, rate, lo, concave_end);
        lo = concave_end + window;
        if (rate(concave_end) >= 0) continue;
        double const dip_end = lo;
        double lowest = dip_end;
        if (rate(dip_end) > 0) {
            auto const fall = [&](double d) { return -height.rate(d); };
            auto const steepness = [&](double d) { return -height.acceleration(d); };
            lowest = falling_zero(fall, steepness, concave_end, dip_end);
        }
        if (height(lowest) <= 0) return falling_zero(height, rate, concave_end, lowest);
    }
    throw PhaseError("the flight does not end");
}

/// After how many launches the launch phase repeats; 0 while it does not.
int orbit(std::vector<Flight> const& flights) {
    auto const mismatch = [&](int k) {
        double const turns =
            (flights.back().end - flights[flights.size() - static_cast<std::size_t>(k)].start) / two_pi;
        return std::abs(turns - std::round(turns)) / (1 + turns);
    };
    int const most = std::min(longest_orbit, static_cast<int>(flights.size()));
    for (int k = 1; k <= most; ++k) {
        if (mismatch(k) > 1e-15) continue;
        for (int shorter = 1; shorter < k; ++shorter) {  // an alternating approach closes in on 2 before 1
            if (k % shorter == 0 && mismatch(shorter) < 1e-12) return shorter;
        }
        return k;
    }
    return 0;
}

}  // namespace

Flight plastic_flight(double inverse_throw, double start) {
    double const take_off = std::asin(inverse_throw);
    Height const height{inverse_throw, std::sin(start), std::cos(start)};
    double const d = landing_after(height, take_off, start);
    return {start, start + d, std::max(-height.rate(d), 0.0)};
}

NormalMotion normal_motion(double throw_number) {
    NormalMotion motion;
    if (throw_number <= 1) {
        motion.end = two_pi;
        return motion;
    }
    double const inverse_throw = 1 / throw_number;
    double const take_off = std::asin(inverse_throw);
    double start = take_off;
    auto& flights = motion.flights;
    for (int i = 0; i < most_launches; ++i) {
        flights.push_back(plastic_flight(inverse_throw, start));
        double const phase = std::fmod(flights.back().end, two_pi);
        double const base = flights.back().end - phase;
        bool const relaunch = phase > take_off && phase < pi - take_off;
        if (!relaunch) {
            motion.start = take_off;
            motion.end = base + take_off + (phase > take_off ? two_pi : 0);
            motion.cycles = static_cast<int>(std::lround((motion.end - take_off) / two_pi));
            return motion;
        }
        int const k = orbit(flights);
        if (k > 0) {
            flights.erase(flights.begin(), flights.end() - k);
            motion.start = flights.front().start;
            motion.end = flights.back().end;
            motion.cycles = static_cast<int>(std::lround((motion.end - motion.start) / two_pi));
            return motion;
        }
        start = flights.back().end;
    }
    motion.start = flights.front().start;
    motion.end = flights.back().end;
    motion.cycles = 0;
    return motion;
}

}  // namespace vibrotrough::theory::detail
