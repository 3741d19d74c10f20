#pragma once

#include "theory/detail/instant.hpp"

#include <cstddef>
#include <vector>

// Periodic functions of the drive and their zeros. Internal to this module.
namespace vibrotrough::theory::detail {

/// sine sin(order t) + cosine cos(order t)
struct Overtone {
    int order;
    double sine, cosine;
};

/// constant + sine sin t + cosine cos t + overtones. Everything follows from the sine and cosine of t: those
/// of its multiples are products of them.
class Wave {
  public:
    double constant = 0, sine = 0, cosine = 0;
    std::vector<Overtone> overtones;  ///< in rising order, above 1

    double operator()(Instant const& i) const {
        double const fundamental = constant + sine * i.sine + cosine * i.cosine;
        return overtones.empty() ? fundamental : fundamental + sum<0>(i);
    }
    /// The derivative.
    double rate(Instant const& i) const {
        double const fundamental = sine * i.cosine - cosine * i.sine;
        return overtones.empty() ? fundamental : fundamental + sum<1>(i);
    }
    /// The second derivative.
    double bend(Instant const& i) const {
        double const fundamental = -sine * i.sine - cosine * i.cosine;
        return overtones.empty() ? fundamental : fundamental + sum<2>(i);
    }
    /// Becomes a f + b g. The waves of one conveyor have the same orders.
    void set_sum(double a, Wave const& f, double b, Wave const& g);
    /// Becomes second f'' + first f'.
    void set_derivative(double second, double first, Wave const& f);
    /// Becomes the bounded solution of u' = -kappa u + (f without its constant); without kappa an
    /// antiderivative.
    void set_response(double kappa, Wave const& f);
    /// An upper bound of what is added to the constant.
    double bound() const;
    /// An upper bound of |second derivative|.
    double bend_bound() const;
    int highest_order() const { return overtones.empty() ? 1 : overtones.back().order; }

  private:
    template <int derivative>
    double sum(Instant const& i) const;
    template <class Factors>
    void set(Wave const& f, Factors const& factors);
};

/// The zeros of a wave, from one to the next.
class Crossings {
  public:
    /// The time from somewhere to the next zero, within which the wave has one sign.
    struct Section {
        bool positive;
        Instant end;       ///< the zero; at infinity when there is none
        std::size_t next;  ///< number of that zero within its cycle
    };

    /// Finds the zeros of one cycle. Those that come in pairs closer than 1e-9 may be left out.
    void find(Wave const& wave);
    bool none() const { return zeros_.empty(); }
    std::size_t count() const { return zeros_.size(); }
    /// The zeros within [0, 2 pi), in order.
    std::vector<Instant> const& zeros() const { return zeros_; }
    /// Whether the wave is positive after zero i.
    bool rises(std::size_t i) const { return (i % 2 == 0) != positive_at_start_; }
    /// The section that t belongs to. A zero that only rounding puts ahead of t has been passed.
    Section at(double t) const;
    void advance(Section& section) const;
    double tolerance(double t) const { return 1e-15 * (1 + std::abs(t)); }

  private:
    struct Node {
        double t, value;
    };
    void find_between(Wave const& wave, double bound, Node a, Node b);
    void find_of_sine(Wave const& wave);

    std::vector<Instant> zeros_;
    bool positive_at_start_ = true;
};

}  // namespace vibrotrough::theory::detail
