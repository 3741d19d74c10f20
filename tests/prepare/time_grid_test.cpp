#include "core/error.hpp"
#include "prepare/prepared_case.hpp"
#include "scenario/example_campaign.hpp"
#include "scenario/reader/campaign_file.hpp"

#include <gtest/gtest.h>

namespace vibrotrough::prepare {
namespace {

TimeGrid time_of(scenario::Scenario const& s) {
    return prepare_case(s).time;
}

// Rayleigh time by hand for R = 1.35 mm, rho = 1400, E = 5 MPa, nu = 0.35:
// G = 5e6 / 2.7 = 1.851852e6, pi R sqrt(rho / G) / (0.1631 nu + 0.8766) = 1.24895e-4 s.
TEST(TimeGrid, TimeStepIsAFifthOfTheRayleighTimeAndWholePerCycle) {
    scenario::Scenario const s = scenario_of();
    TimeGrid const time = time_of(s);
    double const rayleigh = 1.24895e-4;
    EXPECT_LE(time.time_step, 0.2 * rayleigh * 1.0001);  // the hand value has six digits
    EXPECT_GE(time.time_step,
              0.2 * rayleigh * 0.96);  // 2600 steps are made a multiple of 100
    EXPECT_NEAR(time.time_step / time.rayleigh_fraction, rayleigh, 1e-4 * rayleigh);
    EXPECT_NEAR(time.time_step * time.steps_per_cycle * s.trough.frequency, 1, 1e-14);
}

// t_H = 2.87 (m*^2 / (R* E*^2 v))^(1/5): a hundred times faster impacts shorten it by 100^(1/5) = 2.5.
TEST(TimeGrid, FastImpactsShortenTheTimeStep) {
    scenario::Scenario fast = scenario_of();
    fast.trough.amplitude *= 100;
    TimeGrid const time = time_of(fast);
    EXPECT_NEAR(time.contact_fraction, 0.1, 2e-3);  // 5,000 steps are made a multiple of 100
    EXPECT_LT(time.rayleigh_fraction, 0.2);
}

// The Rayleigh time of a 30 mm grain is ten cycles of 10 kHz: the sinusoid itself needs steps, too.
TEST(TimeGrid, TheSinusoidHasSteps) {
    scenario::Scenario s = scenario_of();
    s.grains.diameter = 0.03;
    s.trough.amplitude = 1e-6;
    s.trough.frequency = 1e4;
    EXPECT_EQ(time_of(s).steps_per_cycle, 500);
    s.grains.diameter = 1e-6;
    s.grains.youngs_modulus = 1e12;
    s.trough.frequency = 0.01;
    EXPECT_THROW(time_of(s), core::InputError);
}

TEST(TimeGrid, StepsDivideIntoFrames) {
    for (int const frames : {1, 7, 12, 100}) {
        scenario::Scenario s = scenario_of();
        s.output.frames_per_cycle = frames;
        EXPECT_EQ(time_of(s).steps_per_cycle % frames, 0) << frames;
        EXPECT_EQ(time_of(s).steps_per_cycle % phases_per_cycle, 0) << frames;
    }
}

}  // namespace
}  // namespace vibrotrough::prepare
