#include "measure/impacts.hpp"

#include "core/error.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vibrotrough::measure {
namespace {

constexpr double mass = 1e-5, hertz_stiffness = 6e5, spring_stiffness = 400;

ImpactingPair pair_of(ContactForce force) {
    return {mass, force == ContactForce::hertz ? hertz_stiffness : spring_stiffness};
}

/// The overlaps of an impact at times that are `step` (s) apart, the first `delay` after the first touch:
/// integrated with steps of a thousandth of the duration as the engine does it, velocity Verlet, with a
/// damping force written as LIGGGHTS documents it, 2 sqrt(5/6) z sqrt(S m*) v with S = 3/2 K sqrt(d).
std::vector<double> overlaps(ContactForce force, double restitution, double speed, double delay, double step,
                             double pressing = 0) {
    auto const [m, k] = pair_of(force);
    double const z = -std::log(restitution) / std::hypot(std::numbers::pi, std::log(restitution));
    auto const acceleration = [&, m = m, k = k](double d, double v) {
        if (d <= 0) return pressing / m;
        double const spring = force == ContactForce::hertz ? k * std::pow(d, 1.5) : k * d;
        double const damping = force == ContactForce::hertz
                                   ? 2 * std::sqrt(5.0 / 6) * z * std::sqrt(1.5 * k * std::sqrt(d) * m)
                                   : 2 * z * std::sqrt(m * k);
        return (pressing - spring - damping * v) / m;
    };
    constexpr int fine = 2000;
    double const dt = step / fine;
    std::vector<double> list;
    double d = 0, v = speed, t = 0, next = delay;
    while (list.size() < 4 && d >= 0) {
        double const half = v + dt / 2 * acceleration(d, v);
        d += dt * half;
        v = half + dt / 2 * acceleration(d, half);
        t += dt;
        if (t < next - dt / 2) continue;
        list.push_back(d);
        next += step;
    }
    return list;
}

/// Duration of an undamped impact, s.
double duration(ContactForce force, double speed) {
    if (force == ContactForce::spring) return std::numbers::pi * std::sqrt(mass / spring_stiffness);
    return 2.94 * std::pow(mass / hertz_stiffness * 1.25, 0.4) * std::pow(speed, -0.2);
}

// Of an impact on which nothing else acts, the energy m v^2 / 2 is found from any two overlaps of its
// approach. The tolerance is that of the two integrations.
TEST(ImpactLaw, FindsTheEnergyOfTheApproach) {
    for (auto const force : {ContactForce::hertz, ContactForce::spring})
        for (double const restitution : {0.1, 0.5, 0.9})
            for (double const speed : {0.003, 0.1, 1.0})
                for (double const delay : {0.05, 0.5, 1.0}) {
                    double const between = 0.2 * duration(force, speed);
                    auto const seen = overlaps(force, restitution, speed, delay * between, between);
                    ASSERT_GE(seen.size(), 2u);
                    auto const energy =
                        ImpactLaw(force, restitution).energy(pair_of(force), seen[0], seen[1], between);
                    ASSERT_TRUE(energy) << restitution << ' ' << speed << ' ' << delay;
                    EXPECT_NEAR(*energy / (mass * speed * speed / 2), 1, 5e-3)
                        << restitution << ' ' << speed << ' ' << delay;
                }
}

// The negative control: lists that are so far apart that the second one is in the rebound.
TEST(ImpactLaw, NeedsListsThatAreCloseTogether) {
    double const between = 0.6 * duration(ContactForce::hertz, 0.1);
    auto const seen = overlaps(ContactForce::hertz, 0.5, 0.1, 0.5 * between, between);
    ASSERT_GE(seen.size(), 2u);
    auto const energy =
        ImpactLaw(ContactForce::hertz, 0.5).energy(pair_of(ContactForce::hertz), seen[0], seen[1], between);
    EXPECT_LT(energy.value_or(0), 0.5 * mass * 0.1 * 0.1 / 2);
}

TEST(ImpactLaw, IsSilentWhereTheContactIsPartedAtOnce) {
    ImpactLaw const law(ContactForce::hertz, 0.5);
    EXPECT_FALSE(law.energy(pair_of(ContactForce::hertz), 1e-6, 0.9e-6, 1e-5));
    EXPECT_DOUBLE_EQ(law.elastic_energy(pair_of(ContactForce::hertz), 1e-6),
                     0.4 * hertz_stiffness * std::pow(1e-6, 2.5));
}

std::string list(long step, std::string const& contacts) {
    return fmt::format(
        "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ENTRIES\n{}\nITEM: BOX BOUNDS pp pp ff\n0 1\n0 "
        "1\n0 1\nITEM: ENTRIES c_a[1] c_a[2] c_a[3] c_a[4] \n{}",
        step, std::ranges::count(contacts, '\n'), contacts);
}

/// All grains have the same law.
std::optional<SeenImpacts> seen_in(std::string const& text, bool with_trough = false) {
    static ImpactLaw const law(ContactForce::hertz, 0.5);
    return find_impacts({"grain_contacts.22.dump", text}, with_trough, 1e-5, [](int, int) {
        return ImpactKind{pair_of(ContactForce::hertz), &law};
    });
}

// Grains 1 and 2 touch from the beginning, 3 and 4 hit each other between steps 100 and 102, and part. A
// contact that is new in the last list is not counted: it has no second overlap yet.
TEST(Impacts, AreContactsThatAreNew) {
    std::string const text = list(100, "1 2 0 1e-6 \n") + list(102, "2 1 1 1e-6 \n4 3 0 1e-6 \n") +
                             list(104, "1 2 0 1e-6 \n3 4 0 2e-6 \n") + list(106, "5 6 0 1e-7 \n");
    auto const seen = seen_in(text);
    ASSERT_TRUE(seen);
    ASSERT_EQ(seen->impacts.size(), 1u);
    Impact const& one = seen->impacts[0];
    EXPECT_EQ(one.step, 102);
    EXPECT_EQ(one.first, 3);
    EXPECT_EQ(one.second, 4);
    EXPECT_FALSE(one.brief);
    EXPECT_GT(one.energy, mass * std::pow(1e-6 / 2e-5, 2) / 2);  // it was slowed down already
    EXPECT_EQ(seen->watched, 4);
    EXPECT_DOUBLE_EQ(seen->contacts, 5.0 / 3);
}

// A grain that rolls from one triangle of the trough to the next one does not hit it.
TEST(Impacts, WithTheTroughAreThoseOfAGrain) {
    std::string const text = list(0, "0 5 7 1e-6 \n") + list(2, "0 5 7 1e-6 \n0 6 7 2e-6 \n0 1 8 1e-6 \n") +
                             list(4, "0 6 7 1e-6 \n");
    auto const seen = seen_in(text, true);
    ASSERT_TRUE(seen);
    ASSERT_EQ(seen->impacts.size(), 1u);
    EXPECT_EQ(seen->impacts[0].first, 8);
    EXPECT_EQ(seen->impacts[0].second, 0);
    EXPECT_TRUE(seen->impacts[0].brief);
}

// The engine may be writing the file.
TEST(Impacts, AreReadFromWholeFiles) {
    std::string const text = list(0, "") + list(2, "1 2 0 1e-6 \n") + list(4, "1 2 0 2e-6 \n");
    EXPECT_TRUE(seen_in(text));
    for (std::size_t size = 0; size < text.size(); ++size) {
        auto const seen = seen_in(text.substr(0, size));
        EXPECT_TRUE(!seen || seen->impacts.empty()) << size;
    }
}

TEST(Impacts, AreRefusedFromDamagedFiles) {
    for (char const* const damaged :
         {"1 2 x 1e-6 \n", "0 2 0 1e-6 \n", "1 2 0 -1e-6 \n", "1 2 0 nan \n", "1 2 0 1e-6 5\n"})
        EXPECT_THROW(seen_in(list(0, "") + list(2, damaged) + list(4, "")), core::InputError) << damaged;
    EXPECT_THROW(seen_in(list(0, "") + list(4, "") + list(2, "")), core::InputError);
}

ImpactList three_impacts() {
    return {{{2, 1, 2, 4e-7, false}, {4, 1, 3, 1e-7, true}, {4, 5, 0, 2e-6, false}}, 0.5, 3.25};
}

TEST(Impacts, AreKeptInAFile) {
    ImpactList const list = three_impacts();
    ImpactList const again = parse_impacts({"impacts.csv", impacts_text(list)});
    EXPECT_EQ(again.watched, 0.5);
    EXPECT_EQ(again.coordination, 3.25);
    ASSERT_EQ(again.impacts.size(), 3u);
    EXPECT_EQ(again.impacts[1].energy, 1e-7);
    EXPECT_TRUE(again.impacts[1].brief);
    EXPECT_EQ(again.impacts[2].second, 0);
    EXPECT_THROW(parse_impacts({"impacts.csv", "step,first,second,energy,brief\n"}), core::InputError);
}

// Energies per time and mass, and how often each occurs.
TEST(Impacts, ComeToARate) {
    Impacts const impacts = impacts_of(three_impacts(), 0.25);
    EXPECT_DOUBLE_EQ(impacts.power.value(), 5e-7 / (0.5 * 0.25));
    EXPECT_DOUBLE_EQ(impacts.trough_power.value(), 2e-6 / (0.5 * 0.25));
    EXPECT_EQ(impacts.energy, 4e-7);
    EXPECT_EQ(impacts.trough_energy, 2e-6);
    EXPECT_DOUBLE_EQ(impacts.brief_share.value(), 1.0 / 3);
    EXPECT_EQ(impacts.number, 3);
    ASSERT_EQ(impacts.from.size(), 7u);  // from 1e-7 to 2.5e-6
    EXPECT_DOUBLE_EQ(impacts.rate[0], 8);
    EXPECT_DOUBLE_EQ(impacts.rate[3], 8);
    EXPECT_DOUBLE_EQ(impacts.trough_rate[6], 8);
    EXPECT_DOUBLE_EQ(impacts.from[0], 1e-7);
    double sum = 0;
    for (double const rate : impacts.rate) sum += rate;
    EXPECT_DOUBLE_EQ(sum, 16);
}

}  // namespace
}  // namespace vibrotrough::measure
