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

TEST(MessageUnits, TellWhereADepthInDiametersBelongs) {
    EXPECT_THAT(error_of(with("height = \"12 mm\"", "height = \"8d\"")),
                HasSubstr("'8d' is a depth in diameters of the grains"));
    EXPECT_THAT(error_of(with("height = \"12 mm\"", "height = \"8 d\"")),
                HasSubstr("layer.height: '8 d' is a depth in diameters of the grains; write "
                          "layer.diameters = 8"));
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

TEST(MessageUnits, AreReadAsTheyStand) {
    EXPECT_EQ(core::unit_of("6 mm"), "mm");
    EXPECT_EQ(core::unit_of(" 1500/min "), "/min");
    EXPECT_EQ(core::unit_of("850 U/min"), "U/min");
    EXPECT_THROW(core::unit_of("six mm"), core::QuantityError);
}

}  // namespace
}  // namespace vibrotrough
