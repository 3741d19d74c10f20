#pragma once

#include <optional>
#include <vector>

/// @file
/// The speed with which two bodies met, from two of the overlaps that follow.

namespace vibrotrough::measure {

/// The normal force of a contact.
enum class ContactForce {
    hertz,   ///< K d^(3/2), damped in proportion to d^(1/4)
    spring,  ///< K d, damped in proportion to the speed
};

/// What an impact of two bodies depends on.
struct ImpactingPair {
    double mass;       ///< kg, m* = m1 m2 / (m1 + m2)
    double stiffness;  ///< N/m^(3/2) for hertz, N/m for spring
};

/// An impact of two bodies on which nothing else acts: m* d'' = -K d^p - c d^q d', with (p, q) = (3/2, 1/4)
/// and c = sqrt(5) z sqrt(m* K) for Hertz (Tsuji, Tanaka & Ishida, Powder Technology 71, 1992, 239), (1, 0)
/// and c = 2 z sqrt(m* K) for a spring. z = |ln e| / sqrt(pi^2 + ln^2 e) belongs to the nominal restitution
/// e.
///
/// In units of the length L = (m* v^2 / K)^(1/(p+1)) and the time L / v all impacts with one restitution have
/// the same overlap x(t). It is integrated once, and the speed v is the one for which x passes through two
/// overlaps.
class ImpactLaw {
  public:
    /// @param restitution  nominal, above 0, at most 1
    ImpactLaw(ContactForce force, double restitution);

    /// Energy m* v^2 / 2 of the approach, J.
    /// @param first    m, an overlap soon after the beginning of the contact, above 0
    /// @param second   m, the overlap after the time `between`
    /// @param between  s
    /// @returns none unless the overlap grows between the two, as when a third grain parts them
    std::optional<double> energy(ImpactingPair const& pair, double first, double second,
                                 double between) const;

    /// Energy in the spring, K d^(p+1) / (p+1), J: the impact had at least this much.
    double elastic_energy(ImpactingPair const& pair, double overlap) const;

  private:
    double overlap_at(double time) const;
    double time_at(double overlap) const;

    double power_;               ///< p
    double time_step_ = 1e-3;    ///< between two entries of the table
    std::vector<double> table_;  ///< x, until the bodies part
    std::size_t largest_ = 0;    ///< index of its largest entry
};

}  // namespace vibrotrough::measure
