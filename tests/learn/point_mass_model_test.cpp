#include "learn/point_mass_model.hpp"

#include "core/error.hpp"
#include "learn/machine_keys.hpp"
#include "theory/point_mass.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace vibrotrough::learn {
namespace {

MeasuredSpeed setting(double amplitude, double frequency, double angle_deg, double inclination_deg) {
    return {2, amplitude, frequency, angle_deg * degree, inclination_deg * degree, 0.1, 0.01};
}

// v = eta omega r cos(beta), eta at Gamma = omega^2 r sin(beta) / (g cos(alpha)).
TEST(PointMassModel, SpeedOfTheTheory) {
    MeasuredSpeed const m = setting(0.003, 12, 30, 2);
    CalibrationModel const model = point_mass_model({"friction"}, {}, {m});
    double const omega = 2 * std::numbers::pi * 12;
    double const gamma = omega * omega * 0.003 * 0.5 / (9.81 * std::cos(2 * degree));
    double const eta =
        theory::solve(theory::PointMass{gamma, std::tan(30 * degree), std::tan(2 * degree), 0.4})
            .velocity_efficiency;
    auto const answer = model(std::array{0.4}, m);
    ASSERT_TRUE(answer);
    EXPECT_NEAR(answer->speed, eta * omega * 0.003 * std::cos(30 * degree), 1e-9);
    EXPECT_DOUBLE_EQ(answer->trough_speed, omega * 0.003 * std::cos(30 * degree));
    EXPECT_EQ(answer->sd, 0);
}

TEST(PointMassModel, FreeAnglesReplaceThoseOfTheMeasurement) {
    MeasuredSpeed const m = setting(0.003, 12, 30, 2), other = setting(0.003, 12, 25, -3);
    CalibrationModel const model =
        point_mass_model({"inclination", "vibration_angle"}, {{"friction", 0.4}}, {m});
    CalibrationModel const plain = point_mass_model({"friction"}, {}, {other});
    EXPECT_DOUBLE_EQ(model(std::array{-3.0, 25.0}, m)->speed, plain(std::array{0.4}, other)->speed);
}

// |tan(alpha)| > mu: the mass runs away. A static friction below the kinetic one does not exist.
TEST(PointMassModel, NoSteadySpeed) {
    MeasuredSpeed const m = setting(0.003, 12, 30, 20);
    EXPECT_FALSE(point_mass_model({"friction"}, {}, {m})(std::array{0.3}, m));
    EXPECT_TRUE(point_mass_model({"friction"}, {}, {m})(std::array{0.4}, m));
    EXPECT_FALSE(point_mass_model({"friction", "static_friction"}, {}, {m})(std::array{0.5, 0.45}, m));
}

// Below throw number 1 nothing lands, so that restitution cannot matter; the general solver agrees with the
// fast one.
TEST(PointMassModel, GeneralSolverAgreesWhereNothingFlies) {
    MeasuredSpeed const m = setting(0.003, 8, 30, 0);
    CalibrationModel const plain = point_mass_model({"friction"}, {}, {m});
    CalibrationModel const general = point_mass_model({"friction", "restitution"}, {}, {m});
    EXPECT_NEAR(plain(std::array{0.4}, m)->speed, general(std::array{0.4, 0.3}, m)->speed, 1e-9);
}

TEST(PointMassModel, WrongNamesAreRefused) {
    MeasuredSpeed m = setting(0.003, 12, 30, 2);
    EXPECT_THROW(point_mass_model({"fricton"}, {}, {m}), core::InputError);
    EXPECT_THROW(point_mass_model({"friction", "friction"}, {}, {m}), core::InputError);
    EXPECT_THROW(point_mass_model({"friction"}, {{"friction", 0.3}}, {m}), core::InputError);
    EXPECT_THROW(point_mass_model({"inclination"}, {}, {m}), core::InputError);
    m.vibration_angle.reset();
    EXPECT_THROW(point_mass_model({"friction"}, {}, {m}), core::InputError);
    EXPECT_NO_THROW(point_mass_model({"friction"}, {{"vibration_angle", 30}}, {m}));
}

}  // namespace
}  // namespace vibrotrough::learn
