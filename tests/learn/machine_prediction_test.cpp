#include "learn/machine_prediction.hpp"

#include "learn/design_report.hpp"
#include "learn/pellets.hpp"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vibrotrough::learn {
namespace {

/// A trough at 1000 1/min under 40 mm of spheres of 4 mm, with a friction between them of 0.5.
ExistingMachine pellet_machine() {
    double const degree = std::numbers::pi / 180;
    ExistingMachine m{{1000.0 / 60, 0.004, 25 * degree, 0}, {0.3}};
    m.grains = {0.004, {}, Uncertain{0.5}};
    m.depth = 0.04;
    return m;
}

double half_width(ExistingMachine const& m) {
    return predict_machine(m).layer.value().half_width;
}

// What nobody gave lies anywhere in the range that was simulated: the same as if that range had been given,
// which is more than if it were known exactly.
TEST(MachinePrediction, NotGivenIsAnywhereInTheRange) {
    for (double const rpm : {750., 900., 1000., 1200.}) {
        ExistingMachine m = pellet_machine();
        m.drive.frequency = rpm / 60;
        double const unknown = half_width(m);
        m.grains.rolling_friction = between_ends(0, 0.2);
        EXPECT_NEAR(half_width(m), unknown, 1e-12) << rpm;
        m.grains.rolling_friction = Uncertain{0.1};
        EXPECT_LT(half_width(m), unknown) << rpm;
    }
}

// Who knows less has the wider interval, also where what is not known reaches beyond the atlas (0.15 to 0.6
// for the friction), which is then said.
TEST(MachinePrediction, LessKnowledgeIsAWiderInterval) {
    double last = 0;
    for (double const sd : {0., 0.02, 0.05, 0.1, 0.15, 0.2}) {
        ExistingMachine m = pellet_machine();
        m.grains.rolling_friction = Uncertain{0.1};
        m.friction = {0.3, sd};
        MachinePrediction const p = predict_machine(m);
        EXPECT_GT(p.layer.value().half_width, last) << sd;
        last = p.layer->half_width;
        EXPECT_EQ(p.outside.empty(), 0.3 - 1.96 * sd >= 0.15) << sd;
        for (atlas::Outside const& one : p.outside)
            EXPECT_THAT(one.why, testing::HasSubstr("which it may be"));
    }
    for (double const mean : {0.1, 0.15, 0.6, 0.65}) {  // beyond the atlas, and at its ends
        ExistingMachine m = pellet_machine();
        m.friction = {mean};
        double const exact = half_width(m);
        m.friction.sd = 0.03;
        EXPECT_GT(half_width(m), exact) << mean;
    }
}

// A trough 20 mm wide is five grains wide: its side walls brake the layer, and the atlas has none.
TEST(MachinePrediction, SideWallsBesideEachOtherAreOutside) {
    ExistingMachine m = pellet_machine();
    m.width = 0.4;
    EXPECT_THAT(predict_machine(m).outside, testing::IsEmpty());
    m.width = 0.02;
    ASSERT_EQ(predict_machine(m).outside.size(), 1U);
    EXPECT_EQ(predict_machine(m).outside.front().why, "side walls 5 diameters apart (at least 20)");
    DesignTask task = pellets();
    task.grain_diameter = 0.02;
    EXPECT_THAT(design_with_risk(task).untested.value_or(""),
                testing::HasSubstr("side walls 15 diameters apart"));
}

// f(x) = 2 x is known from 0 to 1: its standard deviation is twice that of x, wherever x lies.
TEST(MachinePrediction, DeviationsGoOnBeyondWhatIsKnown) {
    auto const twice = [](double x) -> std::optional<double> {
        EXPECT_GE(x, -0.1);
        EXPECT_LE(x, 1.1);
        return 2 * x;
    };
    for (double const mean : {-0.1, 0., 0.3, 1., 1.1})
        EXPECT_NEAR(deviation_within({0, 1}, {mean, 0.5}, twice), 1, 1e-12) << mean;
}

}  // namespace
}  // namespace vibrotrough::learn
