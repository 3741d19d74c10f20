#include "theory/detail/phase_notes.hpp"

#include <algorithm>
#include <cmath>

namespace vibrotrough::theory::detail {
namespace {

double whole_cycles(double t) {
    return std::round(t * (1 / two_pi));
}

/// The list of phases, the mode and the flight number of a period, from its pieces.
void describe_period(std::vector<Piece> const& pieces, Motion& motion) {
    double const shift = two_pi * std::floor(pieces.front().start * (1 / two_pi));
    for (Piece const& piece : pieces) {
        motion.phases.push_back({piece.kind, piece.start - shift, piece.end - shift, piece.displacement});
        motion.mode += to_string(piece.kind);
        if (piece.kind == PhaseKind::flight)
            motion.flight_number = std::max(motion.flight_number, (piece.end - piece.start) / two_pi);
    }
}

/// Moves what comes before number `first` to the end.
template <class Item>
void start_at(std::vector<Item>& items, std::size_t first) {
    std::rotate(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(first), items.end());
}

}  // namespace

void PhaseNotes::join_ends() {
    if (notes_.size() < 2 || notes_.front().kind != notes_.back().kind) return;
    Note& first = notes_.front();
    Note const& last = notes_.back();
    double const duration = last.end - last.start;
    first = {first.kind, 0,      first.start - duration,
             first.end,  last.v, first.displacement + last.displacement};
    notes_.pop_back();
}

/// The phase with which the list of phases starts: a take-off from contact, otherwise any flight, otherwise
/// the positive slide, otherwise the negative slide, otherwise the first phase.
std::size_t PhaseNotes::first_phase(NormalOrbit const& orbit) const {
    std::size_t const n = notes_.size();
    auto const find = [&](auto const& wanted) {
        std::size_t best = n;
        double earliest = HUGE_VAL;
        for (std::size_t i = 0; i < n; ++i) {
            if (!wanted(notes_[i], notes_[(i + n - 1) % n])) continue;
            double phase = notes_[i].start - two_pi * std::floor(notes_[i].start * (1 / two_pi));
            if (phase <= 0) phase = two_pi;
            if (orbit.cycles == 1 ? phase < earliest : best == n) {
                best = i;
                earliest = phase;
            }
        }
        return best;
    };
    std::size_t i = find([](Note const& now, Note const& before) {
        return now.kind == PhaseKind::flight && before.kind != PhaseKind::flight;
    });
    for (auto const kind : {PhaseKind::flight, PhaseKind::positive_slide, PhaseKind::negative_slide}) {
        if (i == n) i = find([kind](Note const& now, Note const&) { return now.kind == kind; });
    }
    return i < n ? i : 0;
}

ModeCode PhaseNotes::mode(NormalOrbit const& orbit) const {
    ModeCode code = 0;
    std::size_t const n = notes_.size(), first = first_phase(orbit);
    for (std::size_t i = 0; i < n; ++i)
        code = append_phase(code, notes_[(first + i) % n].kind, static_cast<int>(i));
    return code;
}

void PhaseNotes::describe(Forces const& forces, NormalOrbit const& orbit, ConveyorMotion& motion) const {
    bool const periodic = motion.motion.converged;
    std::size_t const first = periodic ? first_phase(orbit) : 0;
    std::size_t hop = notes_.front().hop, impacts_before = 0;
    double cycles = 0;  // between the time of the hop and that of the first one
    for (std::size_t i = 0; i < notes_.size(); ++i) {
        Note const& note = notes_[i];
        for (; hop < note.hop; ++hop)
            cycles += whole_cycles(orbit.hops[hop].leave.t - orbit.hops[hop + 1].start.t);
        double const shift = two_pi * cycles;
        bool const flies = note.kind == PhaseKind::flight;
        double const rate = flies && hop > 0 ? orbit.hops[hop - 1].rebound : 0;
        motion.pieces.push_back({note.kind, note.start + shift, note.end + shift,
                                 forces.vx()(Instant::at(note.start)) + note.v, 0, rate, note.displacement});
        if (!flies) continue;
        Hop const& flight = orbit.hops[hop];
        Leap const over = leap(forces, flight);
        double const v = note.v * over.decay + over.push;
        motion.impacts.push_back(
            {note.end + shift, flight.approach, flight.rebound, v, landed({v, 0}, over.impulse).v});
        if (i < first) ++impacts_before;
    }
    if (!periodic) {
        // The cycles end where the next flight starts: an impact there is not among what can be sampled.
        if (motion.pieces.back().kind == PhaseKind::flight) motion.impacts.pop_back();
        return;
    }
    double const length = two_pi * orbit.cycles;
    for (std::size_t i = 0; i < first; ++i) motion.pieces[i].start += length, motion.pieces[i].end += length;
    for (std::size_t i = 0; i < impacts_before; ++i) motion.impacts[i].t += length;
    start_at(motion.pieces, first);
    start_at(motion.impacts, impacts_before);
    describe_period(motion.pieces, motion.motion);
}

}  // namespace vibrotrough::theory::detail
