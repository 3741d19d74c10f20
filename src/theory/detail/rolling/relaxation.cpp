#include "theory/detail/rolling/relaxation.hpp"

#include <algorithm>
#include <cmath>

namespace vibrotrough::theory::detail {
namespace {

/// (exp(-a h) - exp(-b h)) / (b - a), which is h exp(-a h) for a = b.
double difference_of_decays(double a, double b, double h) {
    double const slow = std::min(a, b), gap = std::abs(b - a);
    double const x = gap * h;
    if (x < 1e-3) return std::exp(-slow * h) * h * (1 - x / 2 * (1 - x / 3 * (1 - x / 4)));
    return (std::exp(-slow * h) - std::exp(-(slow + gap) * h)) / gap;
}

/// (1 - exp(-a h)) / a
double integral_of_decay(double a, double h) {
    return a * h == 0 ? h : -std::expm1(-a * h) / a;
}

}  // namespace

Relaxation::Relaxation(double rate, ContactForce const& force, double first, Instant const& start)
    : rate_(rate), force_(force) {
    double const size = 1 + rate * rate;
    sine_ = (rate * force.sine + force.cosine) / size;
    cosine_ = (rate * force.cosine - force.sine) / size;
    mean_ = rate > 0 ? force.constant / rate : 0;
    wave_ = std::sqrt(sine_ * sine_ + cosine_ * cosine_);
    free_ = first - mean_ - sine_ * start.sine - cosine_ * start.cosine;
}

double Relaxation::operator()(double t) const {
    double const h = t - force_.start;
    double x = mean_ + sine_ * std::sin(t) + cosine_ * std::cos(t);
    x += rate_ > 0 ? free_ * std::exp(-rate_ * h) : free_ + force_.constant * h;
    for (Decay const& d : force_.decays) {
        if (d.amplitude != 0) x += d.amplitude * difference_of_decays(rate_, d.rate, h);
    }
    return x;
}

Clock Clock::at(double t, ContactForce const& force) {
    Clock c{t - force.start, std::sin(t), std::cos(t), {0, 0}};
    for (std::size_t i = 0; i < force.decays.size(); ++i) {
        if (force.decays[i].amplitude != 0) c.decays[i] = std::exp(-force.decays[i].rate * c.h);
    }
    return c;
}

Relaxation::At Relaxation::at(Clock const& c) const {
    bool const relaxes = rate_ > 0;
    double const decay = relaxes ? std::exp(-rate_ * c.h) : 1;
    double own = relaxes ? free_ * decay : 0;  // of x, apart from the periodic part
    double drive = relaxes ? 0 : force_.constant, first = 0, second = 0, reach = 0;
    for (std::size_t i = 0; i < c.decays.size(); ++i) {
        Decay const& d = force_.decays[i];
        if (d.amplitude == 0) continue;
        double const now = d.amplitude * c.decays[i], size = std::abs(now), gap = d.rate - rate_;
        own += std::abs(gap) * c.h > 1e-3 ? d.amplitude * (decay - c.decays[i]) / gap
                                          : d.amplitude * difference_of_decays(rate_, d.rate, c.h);
        drive += now;
        first += size * d.rate;
        second += size * d.rate * d.rate;
        reach += size / std::max(rate_, d.rate);
    }
    // |own| stays below this bound, and its derivatives follow from own' = -rate own + decays.
    double const most = std::abs(own) + reach;
    double const slope = rate_ * most + std::abs(drive);
    double const bend = rate_ * slope + first;
    return {.value = mean_ + sine_ * c.sine + cosine_ * c.cosine + own +
                     (relaxes ? 0 : force_.constant * c.h + free_),
            .rate = sine_ * c.cosine - cosine_ * c.sine - rate_ * own + drive,
            .bend = wave_ + bend,
            .jerk = wave_ + rate_ * bend + second};
}

std::optional<PhaseSum> Relaxation::sum() const {
    PhaseSum s{.constant = mean_, .slope = 0, .sine = sine_, .cosine = cosine_};
    (rate_ > 0 ? s.decays[0] : s.constant) += free_;
    if (!(rate_ > 0)) s.slope = force_.constant;
    for (std::size_t i = 0; i < force_.decays.size(); ++i) {
        Decay const& d = force_.decays[i];
        if (d.amplitude == 0) continue;
        double const gap = d.rate - rate_;
        if (std::abs(gap) < 1e-3 * d.rate) return std::nullopt;
        s.decays[i + 1] = -d.amplitude / gap;
        (rate_ > 0 ? s.decays[0] : s.constant) += d.amplitude / gap;
    }
    return s;
}

double Relaxation::travel(double t) const {
    double const start = force_.start, h = t - start;
    double x =
        mean_ * h - sine_ * (std::cos(t) - std::cos(start)) + cosine_ * (std::sin(t) - std::sin(start));
    x += rate_ > 0 ? free_ * integral_of_decay(rate_, h) : free_ * h + force_.constant * h * h / 2;
    for (Decay const& d : force_.decays) {
        if (d.amplitude == 0) continue;
        // The integral of a difference of decays, from own' = -rate own + amplitude exp(-d.rate h).
        double const own = difference_of_decays(rate_, d.rate, h), driven = integral_of_decay(d.rate, h);
        x += d.amplitude *
             (rate_ > d.rate ? (driven - own) / rate_ : (integral_of_decay(rate_, h) - own) / d.rate);
    }
    return x;
}

}  // namespace vibrotrough::theory::detail
