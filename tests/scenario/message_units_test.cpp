#include "core/quantity.hpp"
#include "example_campaign.hpp"
#include "single_case.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vibrotrough {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// The example with another length of the box.
std::string long_as(std::string const& length) {
    return with("length = \"36 mm\"", "length = \"" + length + "\"");
}

TEST(MessageUnits, AreThoseOfTheFile) {
    EXPECT_THAT(
        error_of(long_as("1.2 cm")),
        AllOf(HasSubstr("layer.length: 1.2 cm is less than 4 diameters of the largest grains (3.3 mm each)"),
              HasSubstr("write at least \"1.32 cm\"")));
    EXPECT_THAT(error_of(with("diameter = \"3 mm\"", "diameter = \"3000 um\"", long_as("0.012 m"))),
                AllOf(HasSubstr("0.012 m is less than"), HasSubstr("(3300 um each)"),
                      HasSubstr("write at least \"0.0132 m\"")));
    EXPECT_THAT(error_of(with("height = \"12 mm\"", "height = \"0.2 cm\"")),
                AllOf(HasSubstr("layer.height: 0.2 cm is less than one grain diameter"),
                      HasSubstr("write at least \"0.3 cm\"")));
}

// 4 diameters of 3 mm are 12 mm.
TEST(MessageUnits, ADepthInDiametersIsThatOfItsHeight) {
    auto const deep =
        scenario::parse_campaign(with("height = \"12 mm\"", "diameters = 4"), "test.toml").cases.front();
    auto const high = scenario::parse_campaign(example_campaign, "test.toml").cases.front();
    EXPECT_EQ(deep.layer.grains, high.layer.grains);
    EXPECT_EQ(deep.layer.diameters, 4);
}

// A swept value has the unit of the section's own value, and mm without one.
TEST(MessageUnits, HoldForSweptValues) {
    std::string const sweep = "\n[sweep]\n\"layer.length\" = [\"36 mm\", \"9 mm\"]\n";
    EXPECT_THAT(error_of(long_as("3.6 cm") + sweep),
                HasSubstr("layer.length: 0.9 cm is less than 4 diameters"));
    EXPECT_THAT(error_of(with("length = \"36 mm\"\n", "") + sweep),
                HasSubstr("layer.length: 9 mm is less than 4 diameters"));
    EXPECT_THAT(
        error_of(
            example_campaign +
            std::string("\n[sweep]\n\"trough.inclination\" = { from = \"0 deg\", to = \"100 deg\", step = "
                        "\"50 deg\" }\n")),
        HasSubstr("trough.inclination: 100 deg is out of range"));
}

// A range is told in the unit that was typed, and with the slip of a unit that explains the number.
TEST(MessageUnits, ARangeHasThemAndNamesTheSlip) {
    EXPECT_THAT(error_of(with("inclination = \"0 deg\"", "inclination = \"1.2 rad\"")),
                AllOf(HasSubstr("trough.inclination: '1.2 rad' is out of range (were 1.2 deg meant?)"),
                      HasSubstr("in the range -0.785398 to 0.785398 rad")));
    EXPECT_THAT(error_of(with("amplitude = \"6 mm\"", "stroke = \"9.7 m\"")),
                AllOf(HasSubstr("trough.stroke: '9.7 m' is out of range (were 9.7 mm meant?)"),
                      HasSubstr("in the range 2e-06 to 2 m")));
    EXPECT_THAT(error_of(with("throw_number = 2.0", "frequency = \"0.1 rpm\"")),
                AllOf(HasSubstr("'0.1 rpm' is out of range (were 0.1 Hz meant?)"),
                      HasSubstr("in the range 0.6 to 600000 rpm")));
    EXPECT_THAT(error_of(with("density = \"1400 kg/m3\"", "density = \"0.6 kg/m3\"")),
                HasSubstr("grains.density: '0.6 kg/m3' is out of range (were 0.6 t/m3 meant?)"));
    EXPECT_THAT(
        error_of(with("friction = 0.23", "friction = 30")),
        HasSubstr("30 is out of range (was an angle of friction meant (its tangent is 0.577), or 30 %?)"));
    EXPECT_THAT(error_of(with("inclination = \"0 deg\"", "tan_inclination = 5")),
                HasSubstr("5 is out of range (was an angle of 5 degrees meant (its tangent is 0.0875)?)"));
}

// The typed quantity is named where a number follows from several.
TEST(MessageUnits, AStrokeIsNotCalledAnAmplitude) {
    EXPECT_THAT(
        error_of(with("amplitude = \"6 mm\"", "stroke = \"1 m\"",
                      with("throw_number = 2.0", "frequency = \"1000 Hz\""))),
        AllOf(HasSubstr("trough.frequency: gives a throw_number of"), HasSubstr("reduce it or the stroke")));
}

// The bulk density is a key of the grains; a campaign measures that of the layer, from density and packing.
TEST(MessageUnits, TheBulkDensityIsThatOfTheGrains) {
    EXPECT_THAT(error_of(with("width = \"18 mm\"", "width = \"18 mm\"\nbulk_density = \"600 kg/m3\"")),
                HasSubstr("layer.bulk_density: unknown key"));
    EXPECT_THAT(error_of(with("friction = 0.5", "friction = 0.5\nbulk_density = \"600 kg/m3\"")),
                HasSubstr("grains.bulk_density: grains.density is also given"));
}

TEST(MessageUnits, AreReadAsTheyStand) {
    EXPECT_EQ(core::unit_of("6 mm"), "mm");
    EXPECT_EQ(core::unit_of(" 1500/min "), "/min");
    EXPECT_EQ(core::unit_of("850 U/min"), "U/min");
    EXPECT_THROW(core::unit_of("six mm"), core::QuantityError);
}

}  // namespace
}  // namespace vibrotrough
