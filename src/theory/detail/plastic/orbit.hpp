#pragma once

#include "theory/conveyor.hpp"
#include "theory/detail/plastic/contact.hpp"
#include "theory/detail/plastic/flight.hpp"

#include <algorithm>
#include <vector>

// Internal to this room.
namespace vibrotrough::theory::detail {

/// The motion of Sloot & Kruyt's point mass with all that it was found from.
struct PlasticOrbit {
    Law law{};              ///< of the problem that was solved: with_noticeable_forces() of the input
    NormalMotion normal{};  ///< one period, or all flights that were followed if no period was found
    double velocity = 0;    ///< slip velocity at the start of the period, in omega r cos(beta)
    Motion motion{};        ///< its phases are those of `normal`, shifted by whole cycles

    /// Without a flight the period may start anywhere.
    bool starts_within_slide() const { return normal.flights.empty() && velocity != 0; }
};

/// Joins the two parts of the slide within which a period starts, and moves the start of the period to the
/// positive slide, or to the negative one if there is no positive one.
/// @param phases  with kind, start and end
/// @param join    adds what else the last one has to the first one
template <class PhaseOrPiece, class Join>
void start_at_first_slide(std::vector<PhaseOrPiece>& phases, Join const& join) {
    if (phases.size() < 2) return;
    phases.front().start = phases.back().start - two_pi;
    join(phases.front(), phases.back());
    phases.pop_back();
    for (auto const kind : {PhaseKind::positive_slide, PhaseKind::negative_slide}) {
        for (std::size_t i = 0; i < phases.size(); ++i) {
            if (phases[i].kind != kind) continue;
            for (std::size_t k = 0; k < i; ++k) phases[k].start += two_pi, phases[k].end += two_pi;
            std::rotate(phases.begin(), phases.begin() + static_cast<std::ptrdiff_t>(i), phases.end());
            return;
        }
    }
}

/// Solves as theory::solve(PointMass); where no period is found only the outcome is set. @throws the same
PlasticOrbit solve_orbit(PointMass const& input);

/// Adds the pieces and impacts of one period of an orbit that is periodic.
void add_pieces(PlasticOrbit const& orbit, ConveyorMotion& answer);

}  // namespace vibrotrough::theory::detail
