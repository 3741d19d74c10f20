#include "scenario/model/record.hpp"
#include "scenario/model/recorded_motion.hpp"
#include "scenario/model/scenario.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <Eigen/Dense>
#include <boost/math/tools/minima.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unsupported/Eigen/FFT>

namespace vibrotrough::scenario {
namespace {

constexpr int highest_waveform_order = 30;
constexpr double two_pi = 2 * std::numbers::pi;
constexpr double least_told =
    0.01;  ///< of the fundamental: a vibration that is left out is told from this size on
constexpr double beyond_noise =
    6;  ///< standard errors: 1 of 100 maxima of a million lines of pure noise is larger
constexpr double fewest_in_cycle = 3;  ///< samples: of a sine, a cosine and a mean
constexpr double certain = 4;          ///< standard errors: 1 of 3000 amplitudes of pure noise is larger

/// A least-squares fit of sines and cosines of the orders 1 to `orders`, and of a polynomial.
struct Fit {
    Eigen::MatrixXd coefficients;  ///< polynomial, then cosine and sine of each order; for each axis
    Eigen::RowVector2d residual;   ///< sum of squares of each axis
    int powers;                    ///< of time in the polynomial, with the constant
    Eigen::MatrixXd polynomial;    ///< its values
    Eigen::MatrixXd rest;          ///< of the samples, which neither explains
};

/// @param count  of the first samples are used
Fit fit(Record const& record, Eigen::Index count, double frequency, int orders, int powers) {
    Eigen::MatrixXd design(count, powers + 2 * orders);
    Eigen::ArrayXd const index = Eigen::ArrayXd::LinSpaced(count, 0, static_cast<double>(count - 1));
    Eigen::ArrayXd const time = 2 * index / static_cast<double>(count) - 1;
    for (int k = 0; k < powers; ++k) design.col(k) = time.pow(k);
    for (int order = 1; order <= orders; ++order) {
        Eigen::ArrayXd const angle = two_pi * frequency * order * record.spacing * index;
        design.col(powers + 2 * order - 2) = angle.cos();
        design.col(powers + 2 * order - 1) = angle.sin();
    }
    auto const samples = record.samples.topRows(count);
    Eigen::MatrixXd const normal = design.transpose() * design;
    Eigen::MatrixXd const coefficients = normal.ldlt().solve(design.transpose() * samples);
    Eigen::MatrixXd rest = samples - design * coefficients;
    return {coefficients, rest.colwise().squaredNorm(), powers,
            design.leftCols(powers) * coefficients.topRows(powers), std::move(rest)};
}

/// Powers of time in a fit: a drift cannot be told from the motion in less than three cycles.
int powers_of(double cycles) {
    return cycles < 2.9 ? 1 : 3;
}

/// The frequency near `guess` (to `range`) with the least residual.
double refined(Record const& record, double guess, double range, int orders) {
    Eigen::Index const count = record.count();
    int const powers = powers_of(guess * record.spacing * static_cast<double>(count));
    return boost::math::tools::brent_find_minima(
               [&](double f) { return fit(record, count, f, orders, powers).residual.sum(); }, guess - range,
               guess + range, 30)
        .first;
}

/// A line of the spectrum of both directions together.
struct Line {
    Eigen::Index number;  ///< periods in the samples
    double amplitude;
};

Line strongest_line(Eigen::MatrixXd const& samples) {
    Eigen::Index const count = samples.rows();
    Eigen::VectorXd power = Eigen::VectorXd::Zero(count / 2 + 1);
    for (Eigen::Index axis = 0; axis < 2; ++axis) {
        Eigen::FFT<double> transform;
        Eigen::VectorXd const values = (samples.col(axis).array() - samples.col(axis).mean()).matrix();
        Eigen::VectorXcd lines;
        transform.fwd(lines, values);
        power += lines.head(count / 2 + 1).cwiseAbs2();
    }
    Eigen::Index line = 0;
    double const largest = power.tail(count / 2).maxCoeff(&line);
    return {line + 1, 2 * std::sqrt(largest) / static_cast<double>(count)};
}

/// Whether a record that is taken for one cycle ends where it begins, to a few of its steps.
bool is_closed(Record const& record) {
    Eigen::Index const last = record.count() - 1;
    Eigen::MatrixXd const steps = record.samples.bottomRows(last) - record.samples.topRows(last);
    double const jump = (record.samples.row(0) - record.samples.row(last)).norm();
    return jump <= 3 * steps.rowwise().norm().maxCoeff();
}

/// A record of one cycle often ends with the first sample of the next one: it is where the first is, much
/// closer than samples are to each other there.
void drop_first_of_next(Record& record) {
    Eigen::Index const last = record.count() - 1;
    auto const distance = [&](Eigen::Index a, Eigen::Index b) {
        return (record.samples.row(a) - record.samples.row(b)).norm();
    };
    if (strongest_line(record.samples).number > 1 || last < fewest_samples) return;
    if (distance(0, last) < 0.25 * (distance(0, 1) + distance(last - 1, last)) / 2)
        record.samples.conservativeResize(last, 2);
}

/// The frequency of the fundamental, Hz: that of the strongest line, or the largest whole part of it whose
/// multiples explain the motion to 1 %. A record of less than one and a half cycles is exactly one.
double fundamental_of(Record const& record) {
    constexpr int most_parts = 10, orders = 6;
    auto const duration = record.spacing * static_cast<double>(record.count());
    Record first = record;
    first.samples.conservativeResize(std::min<Eigen::Index>(record.count(), 8192), 2);
    double const length = first.spacing * static_cast<double>(first.count());
    Line const peak = strongest_line(first.samples);
    if (!(peak.amplitude > 0)) throw std::invalid_argument("the trough does not move");
    auto const line = static_cast<double>(peak.number);
    if (line < 1.5) {
        if (first.count() == record.count() && is_closed(record)) return 1 / duration;
        throw std::invalid_argument(
            "it is neither one whole cycle nor several: it does not end where it begins");
    }
    double const strongest = refined(first, line / length, 0.6 / length, 1);
    double const all = fit(first, first.count(), strongest, 0, powers_of(line)).residual.sum();
    std::array<double, most_parts> left{};
    int parts = 0;
    for (; parts < most_parts && (line + 0.5) / (parts + 1) >= 1; ++parts) {
        int const most = std::max(1, static_cast<int>((static_cast<double>(first.count()) - 5) / 4));
        left.at(static_cast<std::size_t>(parts)) = fit(first, first.count(), strongest / (parts + 1),
                                                       std::min(orders * (parts + 1), most), powers_of(line))
                                                       .residual.sum();
    }
    double const least = *std::min_element(left.begin(), left.begin() + parts);
    int part = 1;
    while (left.at(static_cast<std::size_t>(part - 1)) > least + 0.01 * all) ++part;
    double const guess = strongest / part;
    if (guess * duration < 1.5) return 1 / duration;
    double const near = refined(first, guess, 0.1 / length, std::min(orders * part, 20));
    return first.count() == record.count() ? near : refined(record, near, 0.05 / length, orders);
}

/// The harmonics of a record, as displacements.
struct Harmonics {
    DriveMotion all, kept;
    double noise = 0;          ///< standard deviation of a sample, in the unit of the record
    Eigen::MatrixXd left_out;  ///< mean and drift, sample by sample
    Line other = {};           ///< the strongest one of what is left
    int highest = 0;           ///< order that was looked for
};

/// a sin(k t + phi) from the coefficients of cosine and sine; twice integrated where it is an acceleration.
DriveTerm term_of(Record const& record, double frequency, int order, double cosine, double sine) {
    double const omega = two_pi * frequency * order;
    double const factor = record.is_acceleration ? -1 / (omega * omega) : 1;
    return {order, std::abs(factor) * std::hypot(sine, cosine), std::atan2(factor * cosine, factor * sine)};
}

Harmonics harmonics_of(Record const& record, double frequency, double cycles) {
    double const per_cycle = 1 / (frequency * record.spacing);
    auto const count = std::min(record.count(), static_cast<Eigen::Index>(std::lround(cycles * per_cycle)));
    Harmonics found;
    found.highest = std::min(highest_waveform_order, static_cast<int>((per_cycle + 1e-6 - 1) / 2));
    Fit const fitted = fit(record, count, frequency, found.highest, powers_of(cycles));
    auto const free = static_cast<double>(count - fitted.powers - 2 * found.highest);
    Eigen::RowVector2d noise = Eigen::RowVector2d::Zero();
    if (free >= 8) noise = (fitted.residual / free).cwiseSqrt();
    found.noise = noise.norm();
    found.left_out = fitted.polynomial;
    found.other = strongest_line(fitted.rest);
    for (int axis = 0; axis < 2; ++axis) {
        double const least = certain * noise[axis] * std::sqrt(2 / static_cast<double>(count));
        auto& all = axis == 0 ? found.all.along : found.all.normal;
        auto& kept = axis == 0 ? found.kept.along : found.kept.normal;
        for (int order = 1; order <= found.highest; ++order) {
            Eigen::Index const row = fitted.powers + 2 * order - 2;
            double const cosine = fitted.coefficients(row, axis), sine = fitted.coefficients(row + 1, axis);
            all.push_back(term_of(record, frequency, order, cosine, sine));
            if (std::hypot(cosine, sine) >= least) kept.push_back(all.back());
        }
    }
    return found;
}

double largest_term(DriveMotion const& motion) {
    double largest = 0;
    for (auto const* terms : {&motion.along, &motion.normal})
        for (DriveTerm const& term : *terms) largest = std::max(largest, term.amplitude);
    return largest;
}

void drop_small(DriveMotion& motion, double least) {
    for (auto* terms : {&motion.along, &motion.normal})
        std::erase_if(*terms, [least](DriveTerm const& term) { return term.amplitude < least; });
}

double fundamental(std::vector<DriveTerm> const& terms) {
    return terms.empty() || terms.front().order != 1 ? 0.0 : terms.front().amplitude;
}

/// What was made of a record, and what was left out.
std::vector<std::string> remarks_on(Waveform const& w, Record const& record, Harmonics const& found,
                                    double cycles) {
    std::vector<std::string> all;
    all.push_back(fmt::format(
        "{}: {:.0f} whole cycle{} of {} at {:.6g} Hz; the fundamental has an amplitude of {:.5g} mm at "
        "{:.4g} deg",
        w.file.name, cycles, cycles > 1 ? "s" : "",
        record.is_acceleration ? "accelerations" : "displacements", w.frequency, 1e3 * w.amplitude,
        in_degrees(w.angle)));
    std::vector<std::string> left;
    if (found.noise > 0)
        left.push_back(fmt::format("noise of {:.2g} {} (rms)", record.in_unit(found.noise), record.unit()));
    if (powers_of(cycles) > 1) {
        double const drift =
            (found.left_out.colwise().maxCoeff() - found.left_out.colwise().minCoeff()).norm();
        left.push_back(fmt::format("a drift of {:.2g} {}", record.in_unit(drift), record.unit()));
    }
    auto const count = static_cast<double>(found.left_out.rows());
    double const fundamental = w.amplitude * (record.is_acceleration ? std::pow(two_pi * w.frequency, 2) : 1);
    if (found.other.amplitude >
        std::max(least_told * fundamental, beyond_noise * found.noise * std::sqrt(2 / count)))
        left.push_back(fmt::format("a vibration of {:.2g} {} at {:.4g} Hz",
                                   record.in_unit(found.other.amplitude), record.unit(),
                                   static_cast<double>(found.other.number) / (count * record.spacing)));
    if (record.across > 0)
        left.push_back(
            fmt::format("a motion across of up to {:.2g} {}", record.in_unit(record.across), record.unit()));
    all.push_back(fmt::format("{}: harmonics up to order {} of {} are kept{}{}", w.file.name,
                              highest_order(w.motion), found.highest, left.empty() ? "" : "; left out are ",
                              fmt::join(left, ", ")));
    return all;
}

/// @throws std::invalid_argument when no order can be fitted to a cycle
void check_sampling(Record const& record, double frequency) {
    constexpr double good = 20;
    double const in_cycle = 1 / (frequency * record.spacing);
    if (in_cycle > fewest_in_cycle - 1e-6) return;
    throw std::invalid_argument(fmt::format(
        "it is sampled too coarsely: with a sample every {:.4g} ms, a cycle of {:.4g} Hz has only "
        "{:.3g} of them, and at least {} are needed; record one every {:.2g} ms, so that it has {}",
        1e3 * record.spacing, frequency, in_cycle, fewest_in_cycle, 1e3 / (good * frequency), good));
}

double whole_cycles(Record const& record, double frequency) {
    return std::max(1.0, std::floor(frequency * record.spacing * static_cast<double>(record.count()) + 0.01));
}

/// A sentence when a harmonic accelerates the trough too much against a fundamental of this amplitude, m.
void check_harmonics(std::vector<std::string>& faults, std::vector<DriveTerm> const& terms, double amplitude,
                     std::string_view direction) {
    constexpr double largest_ratio = 1000;  // theory/detail/conveyor/check.cpp
    for (DriveTerm const& term : terms) {
        double const acceleration = term.order * term.order * term.amplitude;
        if (amplitude == 0 || term.order == 1 || acceleration <= largest_ratio * amplitude) continue;
        faults.push_back(fmt::format(
            "{} the trough its fundamental of {:.3g} mm is too small: the harmonic of order {} accelerates "
            "the trough by more than {} times as much",
            direction, 1e3 * amplitude, term.order, largest_ratio));
        return;
    }
}

}  // namespace

std::shared_ptr<Waveform const> read_waveform(NamedFile file) {
    Record record = read_record(file.content);
    drop_first_of_next(record);
    Waveform w{std::move(file)};
    w.frequency = fundamental_of(record);
    check_sampling(record, w.frequency);
    double const cycles = whole_cycles(record, w.frequency);
    Harmonics found = harmonics_of(record, w.frequency, cycles);
    double const least = 1e-6 * largest_term(found.all);
    drop_small(found.all, least);
    drop_small(found.kept, least);
    w.all = std::move(found.all);
    w.motion = std::move(found.kept);
    double const along = fundamental(w.motion.along), normal = fundamental(w.motion.normal);
    w.amplitude = std::hypot(along, normal);
    w.angle = std::atan2(normal, along);
    if (!(w.amplitude > 0)) throw std::invalid_argument("the trough has no motion above the noise");
    w.remarks = remarks_on(w, record, found, cycles);
    return std::make_shared<Waveform const>(std::move(w));
}

RecordedMotion recorded_motion(Waveform const& waveform) {
    Record record = read_record(waveform.file.content);
    RecordedMotion motion{.is_acceleration = record.is_acceleration};
    for (Eigen::Index i = 0; i < record.count(); ++i)
        motion.time.push_back(record.start + record.spacing * static_cast<double>(i));
    for (int axis = 0; axis < 2; ++axis)
        motion.samples.at(axis).assign(record.samples.col(axis).begin(), record.samples.col(axis).end());
    drop_first_of_next(record);
    Eigen::MatrixXd const left_out =
        harmonics_of(record, waveform.frequency, whole_cycles(record, waveform.frequency)).left_out;
    for (int axis = 0; axis < 2; ++axis)
        motion.left_out.at(axis).assign(left_out.col(axis).begin(), left_out.col(axis).end());
    return motion;
}

std::optional<WaveformFault> find_fault(Waveform const& waveform, Trough const& trough) {
    double const along = fundamental(waveform.motion.along), normal = fundamental(waveform.motion.normal);
    std::vector<std::string> faults;
    if (std::abs(waveform.frequency - trough.frequency) > near_record * waveform.frequency) {
        faults.push_back(fmt::format("its frequency is {:.6g} Hz, and that of the trough {:.6g} Hz",
                                     waveform.frequency, trough.frequency));
        double const in_cycle = 1 / (trough.frequency * read_record(waveform.file.content).spacing);
        if (in_cycle < fewest_in_cycle)  // a lower frequency is seen (Nyquist)
            faults.back() +=
                fmt::format(", of whose cycle it has only {:.3g} samples: sample it more often", in_cycle);
    }
    if (std::abs(waveform.amplitude - trough.amplitude) > near_record * waveform.amplitude ||
        std::abs(waveform.angle - trough.vibration_angle) > near_record) {
        faults.push_back(
            fmt::format("its fundamental has amplitude {:.6g} mm and vibration angle {:.5g} deg, which "
                        "differ from the keys",
                        1e3 * waveform.amplitude, in_degrees(waveform.angle)));
    }
    check_harmonics(faults, waveform.motion.along, along, "along");
    check_harmonics(faults, waveform.motion.normal, normal, "normal to");
    if (faults.empty()) return {};
    return WaveformFault{
        fmt::format("{}: {}", waveform.file.name, fmt::join(faults, "; besides, ")),
        fmt::format(
            "leave out amplitude, vibration_angle and frequency, which follow from the file, or write "
            "amplitude = \"{:.6g} mm\", vibration_angle = \"{:.5g} deg\" and frequency = \"{:.6g} "
            "Hz\"; its fundamental must not be small",
            1e3 * waveform.amplitude, in_degrees(waveform.angle), waveform.frequency)};
}

}  // namespace vibrotrough::scenario
