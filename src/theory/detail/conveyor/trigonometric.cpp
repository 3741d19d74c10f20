#include "theory/detail/conveyor/trigonometric.hpp"

#include <numbers>
#include <utility>

namespace vibrotrough::theory::detail {
namespace {

constexpr double quarter = std::numbers::pi / 2;

/// p sin(x) + q cos(x) as one sine.
Term combined(double order, double p, double q, double phase) {
    if (q == 0) return {order, p, phase};
    return {order, std::hypot(p, q), phase + std::atan2(q, p)};
}

}  // namespace

Trigonometric Trigonometric::differentiated(double second, double first) const {
    std::vector<Term> terms;
    for (Term const& t : terms_) {
        terms.push_back(combined(t.order, -second * t.order * t.order * t.amplitude,
                                 first * t.order * t.amplitude, t.phase));
    }
    return Trigonometric(std::move(terms));
}

Trigonometric Trigonometric::driven(double kappa) const {
    std::vector<Term> terms;
    for (Term const& t : terms_) {
        double const size = kappa * kappa + t.order * t.order;
        terms.push_back(
            combined(t.order, kappa * t.amplitude / size, -t.order * t.amplitude / size, t.phase));
    }
    return Trigonometric(std::move(terms));
}

Trigonometric Trigonometric::integrated() const {
    std::vector<Term> terms;
    for (Term const& t : terms_) terms.push_back({t.order, t.amplitude / t.order, t.phase - quarter});
    return Trigonometric(std::move(terms));
}

Trigonometric Trigonometric::operator*(double factor) const {
    std::vector<Term> terms = terms_;
    for (Term& t : terms) t.amplitude *= factor;
    return Trigonometric(std::move(terms));
}

Trigonometric Trigonometric::operator+(Trigonometric const& other) const {
    std::vector<Term> terms = terms_;
    terms.insert(terms.end(), other.terms_.begin(), other.terms_.end());
    return Trigonometric(std::move(terms));
}

}  // namespace vibrotrough::theory::detail
