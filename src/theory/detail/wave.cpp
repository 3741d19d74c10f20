#include "theory/detail/wave.hpp"

#include "theory/detail/root.hpp"

#include <algorithm>
#include <utility>

namespace vibrotrough::theory::detail {
namespace {

constexpr double touching = 1e-9;  // rad: zeros closer than this are a contact without crossing
constexpr int nodes_per_period = 6;

/// sin and cos of rising multiples of t.
class Multiples {
  public:
    explicit Multiples(Instant const& i) : one_{i.sine, i.cosine}, now_{i.sine, i.cosine} {}
    double sine() const { return now_.sine; }
    double cosine() const { return now_.cosine; }
    void rise_to(int order) {
        Pair square = one_;
        for (int gap = order - order_; gap > 0; gap /= 2) {
            if (gap % 2 == 1) now_ = turned(now_, square);
            square = turned(square, square);
        }
        order_ = order;
    }

  private:
    struct Pair {
        double sine, cosine;
    };
    static Pair turned(Pair a, Pair b) {
        return {a.sine * b.cosine + a.cosine * b.sine, a.cosine * b.cosine - a.sine * b.sine};
    }
    Pair one_, now_;
    int order_ = 1;
};

/// The zero of a wave between two times at which its signs differ.
Instant zero_between(Wave const& wave, double low, double high, bool rises) {
    double const sign = rises ? -1 : 1;
    Instant here{};
    auto const derivatives = [&](double t) {
        here = Instant::at(t);
        return Derivatives{sign * wave(here), sign * wave.rate(here), sign * wave.bend(here)};
    };
    return instant_at(falling_zero(derivatives, low, high, low + (high - low) / 2), here);
}

}  // namespace

template <int derivative>
double Wave::sum(Instant const& i) const {
    Multiples m(i);
    double total = 0;
    for (Overtone const& o : overtones) {
        m.rise_to(o.order);
        double const k = o.order;
        if constexpr (derivative == 0) total += o.sine * m.sine() + o.cosine * m.cosine();
        if constexpr (derivative == 1) total += k * (o.sine * m.cosine() - o.cosine * m.sine());
        if constexpr (derivative == 2) total -= k * k * (o.sine * m.sine() + o.cosine * m.cosine());
    }
    return total;
}

template double Wave::sum<0>(Instant const&) const;
template double Wave::sum<1>(Instant const&) const;
template double Wave::sum<2>(Instant const&) const;

void Wave::set_sum(double a, Wave const& f, double b, Wave const& g) {
    constant = a * f.constant + b * g.constant;
    sine = a * f.sine + b * g.sine;
    cosine = a * f.cosine + b * g.cosine;
    overtones.resize(f.overtones.size());
    for (std::size_t i = 0; i < overtones.size(); ++i) {
        Overtone const &p = f.overtones[i], &q = g.overtones[i];
        overtones[i] = {p.order, a * p.sine + b * q.sine, a * p.cosine + b * q.cosine};
    }
}

/// @param factors  p and q of p f + q f' for an order k
template <class Factors>
void Wave::set(Wave const& f, Factors const& factors) {
    auto const turned = [&](Overtone const& o) {
        double const k = o.order;
        auto const [p, q] = factors(k);
        return Overtone{o.order, p * o.sine - q * k * o.cosine, p * o.cosine + q * k * o.sine};
    };
    Overtone const fundamental = turned({1, f.sine, f.cosine});
    constant = 0;
    sine = fundamental.sine;
    cosine = fundamental.cosine;
    overtones.resize(f.overtones.size());
    std::transform(f.overtones.begin(), f.overtones.end(), overtones.begin(), turned);
}

void Wave::set_derivative(double second, double first, Wave const& f) {
    set(f, [&](double k) { return std::pair(-second * k * k, first); });
}

void Wave::set_response(double kappa, Wave const& f) {
    set(f, [&](double k) {
        double const size = kappa * kappa + k * k;
        return std::pair(kappa / size, -1 / size);
    });
}

double Wave::bound() const {
    double bound = std::hypot(sine, cosine);
    for (Overtone const& o : overtones) bound += std::hypot(o.sine, o.cosine);
    return bound;
}

double Wave::bend_bound() const {
    double bound = std::hypot(sine, cosine);
    for (Overtone const& o : overtones) bound += std::hypot(o.sine, o.cosine) * o.order * o.order;
    return bound;
}

// constant + A sin(t + phi) = 0 with A cos(phi) = sine, A sin(phi) = cosine.
void Crossings::find_of_sine(Wave const& wave) {
    double const size = std::sqrt(wave.sine * wave.sine + wave.cosine * wave.cosine);
    positive_at_start_ = wave.constant + wave.cosine >= 0;
    if (!(std::abs(wave.constant) < size)) {
        positive_at_start_ = wave.constant >= 0;
        return;
    }
    double const m = -wave.constant / size, r = std::sqrt((1 - m) * (1 + m));
    double const cosine = wave.sine / size, sine = wave.cosine / size;
    double const phase = sine == 0 && cosine > 0 ? 0 : std::atan2(sine, cosine), rise = std::atan2(m, r);
    auto const within_cycle = [](double t) { return t < 0 ? t + two_pi : t < two_pi ? t : t - two_pi; };
    zeros_.push_back({within_cycle(rise - phase), m * cosine - r * sine, r * cosine + m * sine});
    zeros_.push_back({within_cycle(pi - rise - phase), m * cosine + r * sine, m * sine - r * cosine});
    positive_at_start_ = zeros_[1].t < zeros_[0].t;  // the first zero is the one where it falls
    if (positive_at_start_) std::swap(zeros_[0], zeros_[1]);
}

void Crossings::find(Wave const& wave) {
    zeros_.clear();
    if (wave.overtones.empty()) return find_of_sine(wave);
    positive_at_start_ = wave.constant >= 0;
    if (!(wave.bound() > std::abs(wave.constant))) return;  // such as a wave that is zero
    double const bound = wave.bend_bound();
    int const nodes = nodes_per_period * wave.highest_order();
    double const step = two_pi / nodes;
    Instant const turn = Instant::at(step);
    Instant here{0, 0, 1};
    Node last{0, wave(here)};
    positive_at_start_ = last.value >= 0;
    for (int i = 1; i <= nodes; ++i) {
        here = {i * step, here.sine * turn.cosine + here.cosine * turn.sine,
                here.cosine * turn.cosine - here.sine * turn.sine};
        if (i == nodes) here = {two_pi, 0, 1};
        Node const next{here.t, wave(here)};
        find_between(wave, bound, last, next);
        last = next;
    }
}

// |f''| <= bound. Without a change of sign f differs from its chord by at most bound h^2 / 8; where |f'| in
// the middle exceeds bound h / 2, f is monotone.
void Crossings::find_between(Wave const& wave, double bound, Node a, Node b) {
    double const h = b.t - a.t;
    bool const changes = (a.value >= 0) != (b.value >= 0);
    if (!changes && std::min(std::abs(a.value), std::abs(b.value)) > bound * h * h / 8) return;
    Instant const middle = Instant::at(a.t + h / 2);
    bool const monotone = std::abs(wave.rate(middle)) > bound * h / 2;
    if (monotone || h < touching) {
        if (changes) zeros_.push_back(zero_between(wave, a.t, b.t, b.value >= 0));
        return;
    }
    Node const m{middle.t, wave(middle)};
    find_between(wave, bound, a, m);
    find_between(wave, bound, m, b);
}

Crossings::Section Crossings::at(double t) const {
    if (zeros_.empty()) return {positive_at_start_, {HUGE_VAL, 0, 1}, 0};
    double const base = t >= 0 && t < two_pi ? 0 : two_pi * std::floor(t * (1 / two_pi));
    double const passed = t - base + tolerance(t);
    std::size_t i = 0;
    while (i < zeros_.size() && zeros_[i].t <= passed) ++i;
    double shift = base;
    if (i == zeros_.size()) {
        i = 0;
        shift += two_pi;
        while (i + 1 < zeros_.size() && zeros_[i].t + two_pi <= passed) ++i;
    }
    Instant const& zero = zeros_[i];
    return {!rises(i), {zero.t + shift, zero.sine, zero.cosine}, i};
}

void Crossings::advance(Section& section) const {
    section.positive = !section.positive;
    std::size_t const i = section.next + 1 < zeros_.size() ? section.next + 1 : 0;
    double const shift = section.end.t - zeros_[section.next].t + (i == 0 ? two_pi : 0);
    section.end = {zeros_[i].t + shift, zeros_[i].sine, zeros_[i].cosine};
    section.next = i;
}

}  // namespace vibrotrough::theory::detail
