#pragma once

#include <cmath>
#include <vector>

// Internal to the room.
namespace vibrotrough::theory::detail {

/// amplitude sin(order t + phase)
struct Term {
    double order, amplitude, phase;
};

/// A sum of such terms.
class Trigonometric {
  public:
    Trigonometric() = default;
    explicit Trigonometric(std::vector<Term> terms) : terms_(std::move(terms)) {}

    double operator()(double t) const {
        double sum = 0;
        for (Term const& term : terms_) sum += term.amplitude * std::sin(term.order * t + term.phase);
        return sum;
    }
    double rate(double t) const {
        double sum = 0;
        for (Term const& term : terms_)
            sum += term.amplitude * term.order * std::cos(term.order * t + term.phase);
        return sum;
    }
    /// No |value| exceeds it.
    double bound() const { return derivative_bound(0); }
    /// No |n-th derivative| exceeds it.
    double derivative_bound(int n) const {
        double sum = 0;
        for (Term const& term : terms_) sum += std::abs(term.amplitude) * std::pow(term.order, n);
        return sum;
    }
    /// Linear operations term by term: a (d/dt)^2 + b d/dt of the sum.
    Trigonometric differentiated(double second, double first) const;
    /// The bounded solution u of u' = -kappa u + this.
    Trigonometric driven(double kappa) const;
    /// An antiderivative.
    Trigonometric integrated() const;
    Trigonometric operator*(double factor) const;
    Trigonometric operator+(Trigonometric const& other) const;

  private:
    std::vector<Term> terms_;
};

}  // namespace vibrotrough::theory::detail
