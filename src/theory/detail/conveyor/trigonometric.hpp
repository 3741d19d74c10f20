#pragma once

#include <cmath>
#include <vector>

// Internal to this room.
namespace vibrotrough::theory::detail {

/// amplitude sin(order t + phase)
struct Term {
    double order, amplitude, phase;
};

/// A sum of such terms, each evaluated at t in rad.
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
    /// An upper bound of |value|.
    double bound() const { return derivative_bound(0); }
    /// An upper bound of |n-th derivative|.
    double derivative_bound(int n) const {
        double sum = 0;
        for (Term const& term : terms_) sum += std::abs(term.amplitude) * std::pow(term.order, n);
        return sum;
    }
    /// The linear combination second (d/dt)^2 + first d/dt applied to the sum.
    Trigonometric differentiated(double second, double first) const;
    /// The bounded solution u of u' = -kappa u + (this sum).
    Trigonometric driven(double kappa) const;
    /// An antiderivative.
    Trigonometric integrated() const;
    Trigonometric operator*(double factor) const;
    Trigonometric operator+(Trigonometric const& other) const;

  private:
    std::vector<Term> terms_;
};

}  // namespace vibrotrough::theory::detail
