#include "theory/detail/plastic/orbit.hpp"

#include "theory/detail/plastic/steady_motion.hpp"

#include <algorithm>
#include <cmath>

namespace vibrotrough::theory::detail {
namespace {

/// Takes the phases of a period in order and knows the slip velocity at the start of each.
class PieceRecorder {
  public:
    PieceRecorder(PlasticOrbit const& orbit, ConveyorMotion& answer)
        : orbit_(orbit), answer_(answer), v_(orbit.velocity) {}

    void operator()(PhaseKind kind, Instant from, Instant to, double displacement, double) {
        if (kind == PhaseKind::rest) v_ = 0;
        if (to.t - from.t > shortest_phase)
            answer_.pieces.push_back({kind, from.t, to.t, v_ + from.cosine, 0, 0, displacement});
        if (kind == PhaseKind::flight) {
            fly(from, to);
        } else if (kind != PhaseKind::rest) {
            slide(kind, from, to);
        }
    }

  private:
    /// Eqs. 16 to 18.
    void fly(Instant from, Instant to) {
        double const approach = orbit_.normal.flights[flight_++].approach;
        double const before = v_ - orbit_.law.gravity * (to.t - from.t) - (to.cosine - from.cosine);
        v_ = landed({before, 0}, orbit_.law.friction_tangent * approach).v;
        answer_.impacts.push_back({to.t, approach, 0, before, v_});
    }
    void slide(PhaseKind kind, Instant from, Instant to) {
        bool const forward =
            kind == PhaseKind::positive_slide || kind == PhaseKind::positive_slide_after_landing;
        Slide const& slide = forward ? orbit_.law.positive : orbit_.law.negative;
        v_ = slide.sign() * std::max(slide.speed(std::abs(v_), from, to.t, to.cosine), 0.0);
    }

    PlasticOrbit const& orbit_;
    ConveyorMotion& answer_;
    double v_;
    std::size_t flight_ = 0;
};

}  // namespace

void add_pieces(PlasticOrbit const& orbit, ConveyorMotion& answer) {
    if (orbit.motion.mode == "R") {
        answer.pieces = {{PhaseKind::rest, 0, two_pi, 1, 0, 0, 0}};
        return;
    }
    Hints hints;
    PieceRecorder record(orbit, answer);
    follow_period(orbit.law, orbit.normal, orbit.velocity, hints, record);
    if (orbit.starts_within_slide()) {
        start_at_first_slide(answer.pieces, [](Piece& first, Piece const& last) {
            first.along_velocity = last.along_velocity;
            first.displacement += last.displacement;
        });
    }
}

}  // namespace vibrotrough::theory::detail
