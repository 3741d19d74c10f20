#include "atlas/layer_mode.hpp"

#include "atlas/tables.hpp"

#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

namespace vibrotrough::atlas {
namespace {

// The 115 random layers of validation/atlas are none of those that are asked. 83 modes are right; where the
// five layers agree, more often than where they do not. The table is stored, so that the numbers are exact.
TEST(LayerMode, OfRandomLayersIsMostlyRight) {
    std::ifstream file(VALIDATION_FOLDER "/atlas/held_out.csv");
    std::string const table{std::istreambuf_iterator<char>(file), {}};
    auto const layers = read_modes(table, "held_out.csv");
    ASSERT_EQ(layers.size(), 115U);
    int right = 0, sure = 0, right_and_sure = 0;
    for (LayerMotion const& layer : layers) {
        LikelyMode const found = mode_at(layer.place);
        bool const is_right = found.mode == layer.mode, is_sure = found.agreeing == layers_asked;
        right += is_right;
        sure += is_sure;
        right_and_sure += is_right && is_sure;
    }
    EXPECT_EQ(right, 83);
    EXPECT_GT(1.0 * right_and_sure / sure, 0.9) << right_and_sure << " of " << sure;
}

// A layer far below take-off is not thrown.
TEST(LayerMode, OfASmallThrowNumberHasNoFlight) {
    Place place;
    for (SurfaceInput const& input : inputs()) place.push_back((input.low + input.high) / 2);
    place[throw_number_input] = 0.75;
    EXPECT_EQ(mode_at(place).mode.find('F'), std::string::npos) << mode_at(place).mode;
}

}  // namespace
}  // namespace vibrotrough::atlas
