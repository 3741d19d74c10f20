#include "scenario/model/recorded_motion.hpp"
#include "scenario/model/scenario.hpp"

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <stdexcept>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vibrotrough::scenario {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr double omega = 2 * std::numbers::pi * 25;

struct Sampling {
    double rate = 2000;  ///< Hz
    int count = 800;
    double start = 0;  ///< s
    char const* header = "time_s,x_m,z_m";
    char separator = ',', point = '.';
};

/// A record of a motion along the trough and normal to it.
std::string record(std::function<double(double)> const& x, std::function<double(double)> const& z,
                   Sampling const& s = {}) {
    std::string text = s.header;
    for (int i = 0; i < s.count; ++i) {
        double const t = s.start + i / s.rate;
        std::string row = fmt::format("\n{:.9f};{:.9g};{:.9g}", t, x(t), z(t));
        for (char& c : row) c = c == ';' ? s.separator : c == '.' ? s.point : c;
        text += row;
    }
    return text + "\n";
}

std::shared_ptr<Waveform const> read(std::string const& text) {
    return read_waveform({"w.csv", text});
}

double along(double t) {
    return 1.8e-3 * std::sin(omega * t) + 1e-4 * std::sin(3 * omega * t + 0.5);
}
double normal(double t) {
    return 1.1e-3 * std::sin(omega * t + 0.2);
}
/// Second derivatives of these.
double along_acceleration(double t) {
    return -omega * omega * (1.8e-3 * std::sin(omega * t) + 9e-4 * std::sin(3 * omega * t + 0.5));
}
double normal_acceleration(double t) {
    return -omega * omega * normal(t);
}

void expect_motion(Waveform const& w, double tolerance) {
    EXPECT_NEAR(w.frequency, 25, 25 * tolerance);
    EXPECT_NEAR(w.amplitude, std::hypot(1.8e-3, 1.1e-3), 2e-3 * tolerance);
    EXPECT_NEAR(w.angle, std::atan2(1.1, 1.8), tolerance);
    ASSERT_EQ(w.motion.along.size(), 2u);
    EXPECT_EQ(w.motion.along[1].order, 3);
    EXPECT_NEAR(w.motion.along[1].amplitude, 1e-4, 1e-4 * 20 * tolerance);
    // The phase of the third harmonic relative to the fundamental does not depend on where the record begins.
    double const shift = w.motion.along[1].phase - 3 * w.motion.along[0].phase;
    EXPECT_NEAR(std::remainder(shift - 0.5, 2 * std::numbers::pi), 0, 20 * tolerance);
    ASSERT_EQ(w.motion.normal.size(), 1u);
}

// x = sum a_k sin(k omega t + phi_k): the fit of as many harmonics is exact, to nine printed digits.
TEST(Waveform, IsMadeOfAnyPieceOfTheMotion) {
    for (int const count : {80, 400, 411, 800, 1999})
        expect_motion(*read(record(along, normal, {.count = count, .start = 3.217})), 1e-5);
    // One cycle with the first sample of the next one, as many programs write it.
    expect_motion(*read(record(along, normal, {.count = 81})), 1e-5);
}

// X = - X'' / omega^2: a harmonic of order k loses k^2.
TEST(Waveform, AccelerationsAreIntegrated) {
    char const* const header = "time_s,ax_m_per_s2,az_m_per_s2";
    expect_motion(*read(record(along_acceleration, normal_acceleration, {.count = 835, .header = header})),
                  1e-5);
    auto const in_g = [](auto const& function) {
        return [function](double t) { return function(t) / 9.80665; };
    };
    expect_motion(*read(record(in_g(along_acceleration), in_g(normal_acceleration),
                               {.header = "time_s;ax_g;az_g", .separator = ';', .point = ','})),
                  1e-5);
}

// White noise of s in N samples leaves s sqrt(2 / N) in an amplitude. An offset and a slow drift are not
// periodic and cannot be integrated: they are fitted beside the harmonics.
TEST(Waveform, NoiseAndDriftAreLeftOutAndTold) {
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0, 4);  // m/s2; the fundamental has 44 m/s2
    auto const shaken = [&](auto const& function) {
        return [&, function](double t) { return function(t) + noise(random) + 0.3 + 5 * t; };
    };
    auto const w = read(record(shaken(along_acceleration), shaken(normal_acceleration),
                               {.rate = 3300, .count = 1325, .header = "time_s,ax_m_per_s2,az_m_per_s2"}));
    expect_motion(*w, 0.01);
    EXPECT_GT(w->all.along.size(), 20u);
    ASSERT_EQ(w->remarks.size(), 2u);
    EXPECT_THAT(w->remarks[0], HasSubstr("10 whole cycles of accelerations at 2"));
    EXPECT_THAT(w->remarks[1], HasSubstr("up to order 3 of 30"));
    EXPECT_THAT(w->remarks[1], HasSubstr("noise of 5.")) << "4 m/s2 along both axes: 5.7";
    EXPECT_THAT(w->remarks[1], HasSubstr("drift"));
}

// What lies above order 30, or is no multiple of the fundamental, is left out and told.
TEST(Waveform, OtherVibrationsAreTold) {
    auto const with = [](double size, double order) {
        return [=](double t) { return 1.5e-3 * std::sin(omega * t) + size * std::sin(order * omega * t); };
    };
    EXPECT_THAT(read(record(with(5e-4, 40), normal, {.rate = 5000}))->remarks[1],
                HasSubstr("a vibration of 0.5 mm at 1000 Hz"));
    EXPECT_THAT(read(record(with(1e-4, 2.4), normal))->remarks[1], HasSubstr("of 0.1 mm at 60 Hz"));
    EXPECT_THAT(read(record(with(5e-4, 29), normal))->remarks[1], Not(HasSubstr("a vibration")));
}

// The figure of the report shows the samples as they were read; mean and drift are of the whole cycles.
TEST(Waveform, TheRecordIsReadAgainForItsFigure) {
    auto const w = read(record([](double t) { return 0.01 + along(t); }, normal, {.count = 835, .start = 3}));
    RecordedMotion const found = recorded_motion(*w);
    EXPECT_FALSE(found.is_acceleration);
    ASSERT_EQ(found.time.size(), 835u);
    EXPECT_NEAR(found.time.back(), 3 + 834 / 2000., 1e-9);
    EXPECT_NEAR(found.samples[0][7], 0.01 + along(3 + 7 / 2000.), 1e-9);
    EXPECT_NEAR(found.samples[1][834], normal(found.time.back()), 1e-9);
    ASSERT_EQ(found.left_out[0].size(), 800u) << "ten cycles of 80 samples";
    EXPECT_NEAR(found.left_out[0][400], 0.01, 1e-8);
    EXPECT_NEAR(found.left_out[1][799], 0, 1e-8);
}

// A fundamental that is weaker than one of its harmonics is found all the same.
TEST(Waveform, TheFundamentalNeedNotBeTheStrongest) {
    auto const w =
        read(record([](double t) { return 1e-3 * (std::sin(omega * t) + 3 * std::sin(4 * omega * t)); },
                    [](double) { return 0.0; }));
    EXPECT_NEAR(w->frequency, 25, 1e-4);
    EXPECT_EQ(w->angle, 0);
}

TEST(Waveform, AVerticalMotionHasNinetyDegrees) {
    auto const w = read(record([](double) { return 0.0; }, normal));
    EXPECT_EQ(w->angle, std::numbers::pi / 2);
    EXPECT_TRUE(w->motion.along.empty());
}

std::string error(std::string const& text) {
    try {
        read(text);
    } catch (std::invalid_argument const& wrong) {
        return wrong.what();
    }
    return "no error";
}

// Two samples in a cycle or fewer show another frequency (Nyquist), and fewer than three no amplitude.
TEST(Waveform, ARecordThatIsSampledTooCoarselyIsNamed) {
    for (double const rate : {52., 60., 70., 74.})
        EXPECT_THAT(error(record(along, normal, {.rate = rate})),
                    AllOf(HasSubstr("sampled too coarsely"), HasSubstr("a cycle of 25 Hz")))
            << rate;
    EXPECT_THAT(
        error(record(along, normal, {.rate = 62.5})),
        AllOf(HasSubstr("every 16 ms, a cycle of 25 Hz has only 2.5 of them"), HasSubstr("one every 2 ms")));
    // Below two, the frequency of the trough tells.
    Trough trough{};
    trough.frequency = 25;
    EXPECT_THAT(find_fault(*read(record(along, normal, {.rate = 32})), trough)->wrong,
                HasSubstr("of whose cycle it has only 1.28 samples: sample it more often"));
    auto const sine = [](double t) { return 1e-3 * std::sin(omega * t); };
    EXPECT_NEAR(read(record(sine, normal, {.rate = 77}))->motion.along[0].amplitude, 1e-3, 1e-6);
}

TEST(Waveform, MistakesAreNamed) {
    EXPECT_THAT(error("time_s,ax_g,z_m\n0,0,0\n"), HasSubstr("displacements and accelerations are mixed"));
    EXPECT_THAT(error("time_s,u_m,z_m\n"), HasSubstr("line 1: 'u_m' is not a known column"));
    EXPECT_THAT(error("time_s,x_m\n"), HasSubstr("time, x and z are not given once each"));
    EXPECT_THAT(error(record(along, normal, {.count = 100})), HasSubstr("does not end where it begins"));
    EXPECT_THAT(error(record(along, normal, {.point = ','})),
                AllOf(HasSubstr("its numbers seem to have decimal commas"),
                      HasSubstr("separate the columns with semicolons")));
    EXPECT_EQ(error(record([](double) { return 1.0; }, [](double) { return 2.0; })),
              "the trough does not move");
}

}  // namespace
}  // namespace vibrotrough::scenario
