#include "atlas/layer_mode.hpp"

#include "atlas/tables.hpp"
#include "atlas/value.hpp"

#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace vibrotrough::atlas {
namespace {

std::vector<LayerMotion> random_layers() {
    std::ifstream file(VALIDATION_FOLDER "/atlas/held_out.csv");
    std::string const table{std::istreambuf_iterator<char>(file), {}};
    auto layers = read_motions(table, "held_out.csv");
    std::erase_if(layers, [](LayerMotion const& one) { return !outside_ranges(one.place).empty(); });
    return layers;
}

// The 76 random layers of validation/atlas inside of its ranges are none of those that are asked. 57 modes
// are right; where the five layers agree, more often than where they do not. The table is stored, so that the
// numbers are exact.
TEST(LayerMode, OfRandomLayersIsMostlyRight) {
    auto const layers = random_layers();
    ASSERT_EQ(layers.size(), 76U);
    int right = 0, sure = 0, right_and_sure = 0;
    for (LayerMotion const& layer : layers) {
        LikelyMode const found = mode_at(layer.place);
        bool const is_right = found.mode == layer.mode, is_sure = found.agreeing == layers_asked;
        right += is_right;
        sure += is_sure;
        right_and_sure += is_right && is_sure;
    }
    EXPECT_EQ(right, 57);
    EXPECT_GT(1.0 * right_and_sure / sure, 0.85) << right_and_sure << " of " << sure;
}

// Few layers repeat only after several cycles, and those of the nearest throw numbers foretell it better than
// the share of all does: the mean square of what is said less what is so (Brier's score; G. W. Brier, 1950,
// doi:10.1175/1520-0493(1950)078<0001:VOFEIT>2.0.CO;2).
TEST(LayerMode, SeveralCyclesAreForetoldByTheThrowNumber) {
    double score = 0, score_of_share = 0, later = 0, known = 0;
    auto const layers = random_layers();
    for (LayerMotion const& layer : layers) {
        known += layer.period.has_value();
        later += layer.period.value_or(1) > 1;
    }
    int marked = 0, marked_and_later = 0;
    for (LayerMotion const& layer : layers) {
        if (!layer.period) continue;
        double const is_later = *layer.period > 1, near = repeating_later(layer.place[throw_number_input]);
        score += std::pow(near / layers_asked_for_period - is_later, 2);
        score_of_share += std::pow(later / known - is_later, 2);
        marked += near >= layers_asked_for_period / 5;
        marked_and_later += near >= layers_asked_for_period / 5 && is_later > 0;
    }
    EXPECT_LT(score, 0.9 * score_of_share);
    EXPECT_EQ(known, 76);
    EXPECT_EQ(later, 10);
    EXPECT_EQ(marked, 26);
    EXPECT_EQ(marked_and_later, 7);
}

// A layer far below take-off is not thrown, and repeats after one cycle.
TEST(LayerMode, OfASmallThrowNumberHasNoFlight) {
    Place place;
    for (SurfaceInput const& input : inputs()) place.push_back((input.low + input.high) / 2);
    place[throw_number_input] = 0.75;
    EXPECT_EQ(mode_at(place).mode.find('F'), std::string::npos) << mode_at(place).mode;
    EXPECT_EQ(repeating_later(0.75), 0);
}

}  // namespace
}  // namespace vibrotrough::atlas
