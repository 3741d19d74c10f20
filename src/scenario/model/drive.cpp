#include "scenario/model/drive.hpp"

#include "core/csv.hpp"
#include "scenario/model/scenario.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::scenario {
namespace {

constexpr int highest_waveform_order = 30;
constexpr std::size_t fewest_samples = 8;
constexpr double two_pi = 2 * std::numbers::pi;

using Sample = std::array<double, 3>;  // time, x, z

std::vector<Sample> read_samples(std::string_view csv) {
    std::vector<Sample> samples;
    for (auto const& row : core::read_number_table(csv, {"time_s", "x_m", "z_m"}))
        samples.push_back({row.values[0], row.values[1], row.values[2]});
    return samples;
}

/// x_i = sum_k a_k sin(k theta_i + phi_k), with a_k e^(i phi_k) = 2/N sum x_i (sin + i cos)(k theta_i).
std::vector<DriveTerm> fourier(std::vector<Sample> const& samples, std::size_t column) {
    auto const count = static_cast<double>(samples.size());
    int const highest = std::min(highest_waveform_order, static_cast<int>(samples.size() - 1) / 2);
    std::vector<DriveTerm> terms;
    for (int order = 1; order <= highest; ++order) {
        double sine = 0, cosine = 0;
        for (std::size_t i = 0; i < samples.size(); ++i) {
            double const angle = two_pi * order * static_cast<double>(i) / count;
            sine += 2 / count * samples[i][column] * std::sin(angle);
            cosine += 2 / count * samples[i][column] * std::cos(angle);
        }
        terms.push_back({order, std::hypot(sine, cosine), std::atan2(cosine, sine)});
    }
    return terms;
}

void drop_small(std::vector<DriveTerm>& terms, double least) {
    std::erase_if(terms, [least](DriveTerm const& term) { return term.amplitude < least; });
}

double sum_of(std::vector<DriveTerm> const& terms, int power) {
    double sum = 0;
    for (DriveTerm const& term : terms) sum += std::abs(term.amplitude) * std::pow(term.order, power);
    return sum;
}

double fundamental(std::vector<DriveTerm> const& terms) {
    return terms.empty() || terms.front().order != 1 ? 0.0 : terms.front().amplitude;
}

/// A sentence when a harmonic accelerates the trough too much against a fundamental of this amplitude, m.
void check_harmonics(std::vector<std::string>& faults, std::vector<DriveTerm> const& terms, double amplitude,
                     std::string_view direction) {
    constexpr double largest_ratio = 1000;  // theory/detail/conveyor/check.cpp
    for (DriveTerm const& term : terms) {
        double const acceleration = term.order * term.order * term.amplitude;
        if (term.order == 1 || acceleration <= largest_ratio * amplitude) continue;
        faults.push_back(fmt::format(
            "{} the trough its fundamental of {:.3g} mm is too small: the harmonic of order {} accelerates "
            "the trough by more than {} times as much",
            direction, 1e3 * amplitude, term.order, largest_ratio));
        return;
    }
}

}  // namespace

DriveMotion drive_motion(Trough const& trough) {
    if (trough.waveform) return trough.waveform->motion;
    DriveMotion motion;
    double const along = trough.amplitude * std::cos(trough.vibration_angle);
    double const normal = trough.amplitude * std::sin(trough.vibration_angle);
    if (along != 0) motion.along.push_back({1, along, trough.along_phase});
    if (normal != 0) motion.normal.push_back({1, normal, 0});
    for (DriveHarmonic const& harmonic : trough.harmonics) {
        // Integrating X'' = -a sin(k t + phase) twice gives X = a / k^2 sin(k t + phase).
        double const ratio = harmonic.ratio / (static_cast<double>(harmonic.order) * harmonic.order);
        if (along != 0) motion.along.push_back({harmonic.order, along * ratio, harmonic.phase});
        if (normal != 0) motion.normal.push_back({harmonic.order, normal * ratio, harmonic.phase});
    }
    return motion;
}

double largest_excursion(DriveMotion const& motion) {
    return std::hypot(sum_of(motion.along, 0), sum_of(motion.normal, 0));
}

double largest_speed(DriveMotion const& motion, double omega) {
    return omega * std::hypot(sum_of(motion.along, 1), sum_of(motion.normal, 1));
}

int highest_order(DriveMotion const& motion) {
    int order = 1;
    for (auto const* terms : {&motion.along, &motion.normal}) {
        for (DriveTerm const& term : *terms) order = std::max(order, term.order);
    }
    return order;
}

std::shared_ptr<Waveform const> read_waveform(NamedFile file) {
    std::vector<Sample> const samples = read_samples(file.content);
    if (samples.size() < fewest_samples) {
        throw std::invalid_argument(
            fmt::format("there are {} samples, but at least {} are needed", samples.size(), fewest_samples));
    }
    DriveMotion motion{fourier(samples, 1), fourier(samples, 2)};
    double largest = 0;
    for (auto const* terms : {&motion.along, &motion.normal}) {
        for (DriveTerm const& term : *terms) largest = std::max(largest, term.amplitude);
    }
    if (!(largest > 0)) throw std::invalid_argument("the trough does not move");
    drop_small(motion.along, 1e-6 * largest);
    drop_small(motion.normal, 1e-6 * largest);
    std::vector<double> times;
    for (Sample const& sample : samples) times.push_back(sample[0]);
    return std::make_shared<Waveform const>(Waveform{std::move(file), std::move(times), std::move(motion)});
}

void check_samples(Waveform const& waveform, double period) {
    auto const count = static_cast<double>(waveform.times.size());
    double const spacing = period / count;
    for (std::size_t i = 0; i < waveform.times.size(); ++i) {
        double const expected = spacing * static_cast<double>(i);
        if (std::abs(waveform.times[i] - expected) <= 1e-3 * spacing) continue;
        throw std::invalid_argument(
            fmt::format("sample {} is at {:.6g} s instead of {:.6g} s; {} samples must divide one cycle of "
                        "{:.6g} s evenly (without the first sample of the next cycle)",
                        i + 1, waveform.times[i], expected, waveform.times.size(), period));
    }
}

std::optional<WaveformFault> find_fault(Waveform const& waveform, Trough const& trough) {
    double const along = fundamental(waveform.motion.along), normal = fundamental(waveform.motion.normal);
    double const amplitude = std::hypot(along, normal), angle = std::atan2(normal, along);
    std::vector<std::string> faults;
    try {
        check_samples(waveform, 1 / trough.frequency);
    } catch (std::invalid_argument const& error) {
        faults.emplace_back(error.what());
    }
    if (std::abs(amplitude - trough.amplitude) > 0.01 * amplitude ||
        std::abs(angle - trough.vibration_angle) > 0.01) {
        faults.push_back(
            fmt::format("its fundamental has amplitude {:.6g} mm and vibration angle {:.5g} deg, which "
                        "differ from the keys",
                        1e3 * amplitude, in_degrees(angle)));
    }
    check_harmonics(faults, waveform.motion.along, along, "along");
    check_harmonics(faults, waveform.motion.normal, normal, "normal to");
    if (faults.empty()) return {};
    auto const count = static_cast<double>(waveform.times.size());
    double const frequency = (count - 1) / (count * (waveform.times.back() - waveform.times.front()));
    return WaveformFault{
        fmt::format("{}: {}", waveform.file.name, fmt::join(faults, "; besides, ")),
        fmt::format(
            "write amplitude = \"{:.6g} mm\" and vibration_angle = \"{:.5g} deg\" for its frequency of "
            "{:.6g} Hz; its samples must be evenly spaced in one cycle, and its fundamental not small",
            1e3 * amplitude, in_degrees(angle), frequency)};
}

}  // namespace vibrotrough::scenario
