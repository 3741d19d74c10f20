#include "measure/layer_motion.hpp"

#include "measure/constants.hpp"
#include "measure/layer_mode.hpp"
#include "measure/reaction.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

namespace vibrotrough::measure {
namespace {

using Values = std::vector<double>;
constexpr std::size_t per_cycle = PhaseSeries::per_cycle;

/// The lines that are looked at, cut into whole periods.
struct Window {
    std::size_t begin, end;  ///< lines
    std::size_t period;      ///< lines
    std::size_t periods() const { return (end - begin) / period; }
};

/// Differences need a line before the first one, so that the very first cycle is never used.
std::optional<Window> window_of(LayerFacts const& facts, int period_cycles) {
    int const first = std::max(facts.discarded, 1);
    int const periods = (facts.used - first) / period_cycles;
    if (facts.used <= first || periods < 1) return {};
    std::size_t const end = static_cast<std::size_t>(facts.used) * per_cycle;
    std::size_t const period = static_cast<std::size_t>(period_cycles) * per_cycle;
    return Window{end - static_cast<std::size_t>(periods) * period, end, period};
}

struct Curve {
    Values mean, deviation;
};

/// Mean and standard deviation over the periods of a value of each line.
template <class Value>
Curve fold(Window const& window, Value const& value) {
    double const count = static_cast<double>(window.periods());
    Curve curve{Values(window.period), Values(window.period)};
    for (std::size_t j = 0; j < window.period; ++j) {
        double sum = 0, squares = 0;
        for (std::size_t i = window.begin + j; i < window.end; i += window.period) sum += value(i);
        double const mean = sum / count;
        for (std::size_t i = window.begin + j; i < window.end; i += window.period)
            squares += (value(i) - mean) * (value(i) - mean);
        curve.mean[j] = mean;
        curve.deviation[j] = count > 1 ? std::sqrt(squares / (count - 1)) : 0;
    }
    return curve;
}

/// One cycle of the trough's mean places.
Values mean_cycle(Window const& window, Values const& places) {
    Window const cycles{window.begin, window.end, per_cycle};
    return fold(cycles, [&](std::size_t i) { return places[i]; }).mean;
}

double largest_in(Window const& window, Values const& values) {
    double largest = 0;
    for (std::size_t i = window.begin; i < window.end; ++i) largest = std::max(largest, values[i]);
    return largest;
}

/// The analysis of one packing's lines.
class Analysis {
  public:
    Analysis(PhaseSeries const& series, LayerFacts const& facts, Window const& window)
        : s_(series),
          facts_(facts),
          window_(window),
          trough_vx_(periodic_velocity(mean_cycle(window, series.trough_x), facts.frequency)),
          trough_vz_(periodic_velocity(mean_cycle(window, series.trough_z), facts.frequency)) {}

    PhaseCurves curves() const;
    std::vector<ModePhase> phases(PhaseCurves const& curves) const;
    std::optional<double> restitution() const;
    double dissipation() const;
    std::optional<double> friction_ratio(PhaseCurves const& curves,
                                         std::vector<ModePhase> const& phases) const;

  private:
    double weight() const { return -facts_.mass * facts_.gravity_z; }
    double trough_vx(std::size_t i) const { return trough_vx_[i % per_cycle]; }
    double trough_vz(std::size_t i) const { return trough_vz_[i % per_cycle]; }
    bool flies(std::size_t i) const { return s_.floor_force[i] < flight_force * weight(); }
    double rising(std::size_t i) const { return s_.vz[i] - trough_vz(i); }
    std::size_t flight_from(std::size_t i) const;
    void add_means(PhaseCurves& curves) const;
    void add_floor(PhaseCurves& curves) const;

    PhaseSeries const& s_;
    LayerFacts const& facts_;
    Window window_;
    Values trough_vx_, trough_vz_;
};

void Analysis::add_means(PhaseCurves& c) const {
    auto const of = [&](Values const& values, Values& mean, Values* deviation = nullptr) {
        Curve curve = fold(window_, [&](std::size_t i) { return values[i]; });
        mean = std::move(curve.mean);
        if (deviation) *deviation = std::move(curve.deviation);
    };
    of(s_.vx, c.velocity_x, &c.velocity_x_deviation);
    of(s_.vz, c.velocity_z, &c.velocity_z_deviation);
    of(s_.normal_force, c.normal_force, &c.normal_force_deviation);
    of(s_.floor_force, c.floor_force);
    of(s_.tangential_force, c.tangential_force, &c.tangential_force_deviation);
    of(s_.touching, c.touching, &c.touching_deviation);
    of(s_.clearance, c.clearance);
    of(s_.energy_translation, c.energy_translation);
    of(s_.energy_rotation, c.energy_rotation);
    c.airborne = fold(window_, [&](std::size_t i) {
                     return s_.touching[i] == 0 && s_.floor_force[i] == 0 ? 1.0 : 0.0;
                 }).mean;
}

void Analysis::add_floor(PhaseCurves& c) const {
    for (std::size_t j = 0; j < window_.period; ++j) {
        double touching = 0, vx = 0, spin = 0, overlap = 0;
        for (std::size_t i = window_.begin + j; i < window_.end; i += window_.period) {
            touching += s_.touching[i];
            vx += s_.touching_vx[i];
            spin += s_.touching_spin[i];
            overlap = std::max(overlap, s_.overlap[i]);
        }
        double const trough = trough_vx(j);
        c.sliding.push_back(touching > 0 ? vx / touching - trough : gap);
        c.slip.push_back(touching > 0 ? (vx - spin) / touching - trough : gap);
        c.overlap.push_back(overlap);
    }
}

PhaseCurves Analysis::curves() const {
    PhaseCurves c;
    for (std::size_t j = 0; j < window_.period; ++j) {
        c.phase.push_back(two_pi * static_cast<double>(j + 1) / per_cycle);
        c.trough_velocity_x.push_back(trough_vx(j));
        c.trough_velocity_z.push_back(trough_vz(j));
    }
    auto const relative = [&](std::size_t i) { return s_.x[i] - s_.trough_x[i]; };
    Curve displacement = fold(window_, [&](std::size_t i) {
        return relative(i) - relative(i - (i - window_.begin) % window_.period - 1);
    });
    Curve height = fold(window_, [&](std::size_t i) { return s_.z[i] - s_.trough_z[i]; });
    c.displacement = std::move(displacement.mean);
    c.displacement_deviation = std::move(displacement.deviation);
    c.height = std::move(height.mean);
    c.height_deviation = std::move(height.deviation);
    add_means(c);
    add_floor(c);
    return c;
}

std::vector<ModePhase> Analysis::phases(PhaseCurves const& c) const {
    double const scale = std::ranges::max(c.trough_velocity_x, {}, [](double v) { return std::abs(v); });
    Values slip, force;
    for (std::size_t j = 0; j < window_.period; ++j) {
        slip.push_back((c.velocity_x[j] - c.trough_velocity_x[j]) / std::abs(scale));
        force.push_back(c.floor_force[j] / weight());
    }
    return mode_phases({slip, force, two_pi / per_cycle});
}

/// The first line from i on that begins a flight of a tenth of a cycle.
std::size_t Analysis::flight_from(std::size_t i) const {
    std::size_t length = 0;
    for (; i < window_.end; ++i) {
        length = flies(i) ? length + 1 : 0;
        if (length == per_cycle / 10) return i + 1 - length;
    }
    return window_.end;
}

std::optional<double> Analysis::restitution() const {
    double sum = 0;
    int landings = 0;
    for (std::size_t flight = flight_from(window_.begin); flight < window_.end;) {
        std::size_t landing = flight;
        while (landing < window_.end && flies(landing)) ++landing;
        std::size_t const next = flight_from(landing);
        if (landing >= window_.end || next >= window_.end) break;  // its end is not to be seen
        double const falling = -rising(landing - 1);
        double rebound = 0;
        for (std::size_t i = landing; i < next; ++i) rebound = std::max(rebound, rising(i));
        // A take-off at once from a trough that falls away is not a landing with a rebound.
        if (falling > 0) {
            sum += rebound / falling;
            ++landings;
        }
        flight = next;
    }
    // Above 1 the trough has thrown the layer before the next flight, which is not restitution.
    if (landings == 0 || sum > landings) return {};
    return sum / landings;
}

double Analysis::dissipation() const {
    double work = 0;
    for (std::size_t i = window_.begin; i < window_.end; ++i) {
        work += s_.normal_force[i] * (s_.trough_z[i] - s_.trough_z[i - 1]) -
                s_.tangential_force[i] * (s_.trough_x[i] - s_.trough_x[i - 1]);
    }
    auto const gain = [&](Values const& values) {
        return values[window_.end - 1] - values[window_.begin - 1];
    };
    double const by_gravity = facts_.mass * (facts_.gravity_x * gain(s_.x) + facts_.gravity_z * gain(s_.z));
    double const kinetic = gain(s_.energy_translation) + gain(s_.energy_rotation);
    double const cycles = static_cast<double>(window_.end - window_.begin) / per_cycle;
    return (work + by_gravity - kinetic) / cycles;
}

std::optional<double> Analysis::friction_ratio(PhaseCurves const& c,
                                               std::vector<ModePhase> const& phases) const {
    double along = 0, normal = 0;
    for (ModePhase const& phase : phases) {
        if (phase.letter[0] != 'P' && phase.letter[0] != 'N') continue;
        for (int k = 1; k + 1 < phase.length; ++k) {
            std::size_t const j = static_cast<std::size_t>(phase.first + k) % window_.period;
            along += std::abs(c.tangential_force[j]);
            normal += c.normal_force[j];
        }
    }
    if (!(normal > 0)) return {};
    return along / normal;
}

/// Mean speed of slip over all touching grains and phases.
std::optional<double> mean_slip(PhaseCurves const& c) {
    double sum = 0, touching = 0;
    for (std::size_t j = 0; j < c.slip.size(); ++j) {
        if (c.touching[j] == 0) continue;
        sum += c.touching[j] * std::abs(c.slip[j]);
        touching += c.touching[j];
    }
    if (!(touching > 0)) return {};
    return sum / touching;
}

/// Where the falling force of the trough reaches zero, in intervals: on the line through its last two means
/// above the threshold, at most two intervals later.
double take_off(Values const& force, int first, double least) {
    int const n = static_cast<int>(force.size());
    double const last = force[static_cast<std::size_t>((first + n - 1) % n)];
    double const before = force[static_cast<std::size_t>((first + n - 2) % n)];
    if (last < least || before <= last) return first;
    return std::min(first - 0.5 + last / (before - last), first + 2.0);
}

void add_flight(LayerMotion& motion, std::vector<ModePhase> const& phases, double weight) {
    if (phases.front().letter != "F") return;
    int const first = phases.front().first, length = phases.front().length;
    bool const lands = length < static_cast<int>(motion.curves.phase.size());
    double const start = take_off(motion.curves.floor_force, first, flight_force * weight);
    // It hits within the first interval with force: in its middle, on average.
    double const end = first + length + (lands ? 0.5 : 0);
    motion.flight_number = (end - start) / per_cycle;
    // The period may have several cycles, and the flight may begin half a line before it.
    motion.take_off_phase = within_turn(two_pi * (start / per_cycle));
    motion.landing_phase = *motion.take_off_phase + two_pi * motion.flight_number;
    motion.landing_line = static_cast<std::size_t>(first + length) % motion.curves.phase.size();
}

}  // namespace

int period_of(PhaseSeries const& series, int discarded, int used) {
    auto const height = [&](std::size_t i) { return series.z[i] - series.trough_z[i]; };
    std::size_t const begin = static_cast<std::size_t>(discarded) * per_cycle;
    std::size_t const end = static_cast<std::size_t>(used) * per_cycle;
    auto const change = [&](std::size_t cycles) {
        double sum = 0;
        std::size_t const distance = cycles * per_cycle;
        for (std::size_t i = begin; i + distance < end; ++i)
            sum += (height(i + distance) - height(i)) * (height(i + distance) - height(i));
        return sum / static_cast<double>(end - begin - distance);
    };
    if (used - discarded < 4) return 1;
    auto const [least, most] = std::minmax_element(series.trough_z.begin(), series.trough_z.end());
    double const noise = 1e-3 * (*most - *least);
    double const by_cycle = change(1);
    if (noise == 0 || by_cycle <= noise * noise) return 1;
    for (int cycles = 2; cycles <= std::min(8, (used - discarded) / 2); ++cycles) {
        if (change(static_cast<std::size_t>(cycles)) < by_cycle / 4) return cycles;
    }
    return 1;
}

double within_turn(double angle) {
    double const rest = angle - two_pi * std::floor(angle / two_pi);
    return rest >= 0 && rest < two_pi ? rest : 0;  // else it is a turn but for rounding
}

// For N even and t_j = j T / N: d_jk = (-1)^(j-k) cot((j-k) pi / N) / 2 in units of 2 pi / T
// (Trefethen, Spectral Methods in MATLAB, 2000, chapter 3).
std::vector<double> periodic_velocity(std::vector<double> const& places, double frequency) {
    std::size_t const n = places.size();
    Values weight(n, 0.0);  // of j - k
    for (std::size_t d = 1; d < n; ++d) {
        double const sign = d % 2 == 0 ? 1 : -1;
        weight[d] = sign / (2 * std::tan(static_cast<double>(d) * std::numbers::pi / static_cast<double>(n)));
    }
    Values velocity(n, 0.0);
    for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t k = 0; k < j; ++k) velocity[j] += weight[j - k] * places[k];
        for (std::size_t k = j + 1; k < n; ++k) velocity[j] -= weight[k - j] * places[k];
        velocity[j] *= two_pi * frequency;
    }
    return velocity;
}

LayerMotion layer_motion(PhaseSeries const& series, LayerFacts const& facts) {
    LayerMotion motion;
    motion.period_cycles = period_of(series, facts.discarded, facts.used);
    auto const window = window_of(facts, motion.period_cycles);
    if (!window) return motion;
    Analysis const analysis(series, facts, *window);
    motion.curves = analysis.curves();
    auto const phases = analysis.phases(motion.curves);
    motion.mode = mode_name(phases);
    add_flight(motion, phases, -facts.mass * facts.gravity_z);
    motion.restitution = analysis.restitution();
    motion.dissipation = analysis.dissipation();
    motion.floor_slip = mean_slip(motion.curves);
    add_reaction(motion, facts.frequency);
    motion.friction_ratio = analysis.friction_ratio(motion.curves, phases);
    motion.largest_overlap = largest_in(*window, series.overlap);
    Values floor_overlap;
    for (double const clearance : series.clearance) floor_overlap.push_back(-clearance);
    motion.largest_floor_overlap = largest_in(*window, floor_overlap);
    return motion;
}

}  // namespace vibrotrough::measure
