#include "prepare/screen.hpp"

#include "deck/deck.hpp"
#include "deck/screen.hpp"
#include "deck/trough_mesh.hpp"
#include "scenario/example_campaign.hpp"
#include "scenario/reader/campaign_file.hpp"

#include <cmath>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vibrotrough::deck {
namespace {

using testing::HasSubstr;
using testing::Not;

prepare::PreparedCase screened(std::string const& opening) {
    std::string const text = with("max_cycles = 200", "") + "\n[screen]\nopening = \"" + opening +
                             "\"\nwire = \"1 mm\"\ntime = \"2 s\"\n";
    return prepare::prepare_case(scenario::parse_campaign(text, "test.toml").cases.front());
}

prepare::PreparedCase fed_screen(char const* inclination = "0 deg") {
    std::string const base = with("length = \"36 mm\"", "length = \"60 mm\"",
                                  with("restitution = 0.5", "restitution = 0.5\nside_wall_friction = 0",
                                       with("height = \"12 mm\"", "")));
    std::string const text = with("0 deg", inclination, base) +
                             "\n[feed]\nmass_flow = \"0.1 t/h\"\nlength = \"15 mm\"\n[screen]\nopening = "
                             "\"5 mm\"\nwire = \"1 mm\"\n";
    return prepare::prepare_case(scenario::parse_campaign(text, "test.toml").cases.front());
}

/// Area of the triangles of an STL text, and the largest coordinates.
std::array<double, 3> area_and_ends(std::string const& stl) {
    std::istringstream text(stl);
    std::array<double, 3> result{};
    std::vector<std::array<double, 3>> corners;
    for (std::string word; text >> word;) {
        if (word != "vertex") continue;
        std::array<double, 3> p{};
        text >> p[0] >> p[1] >> p[2];
        result[1] = std::max(result[1], p[0]);
        result[2] = std::max(result[2], p[1]);
        corners.push_back(p);
        if (corners.size() < 3) continue;
        auto const& [a, b, c] = std::array{corners[0], corners[1], corners[2]};
        result[0] += std::abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
        corners.clear();
    }
    return result;
}

// The area of the sheet is that of the box less that of its holes, and its ends are those of the box exactly.
TEST(ScreenMesh, HasItsHoles) {
    for (double const opening : {0.5e-3, 5e-3, 5.6e-3}) {
        auto const [area, x, y] = area_and_ends(screen_stl(0.036, 0.018, opening, 6, 3));
        EXPECT_NEAR(area, 0.036 * 0.018 - 18 * opening * opening, 1e-12);
        EXPECT_EQ(x, 0.036);
        EXPECT_EQ(y, 0.018);
    }
}

// While the grains settle there is a plate; settled packings do not depend on the openings.
TEST(ScreenDeck, SettlesOnAPlate) {
    Deck const narrow = make_deck(screened("5 mm"), {1}), wide = make_deck(screened("8 mm"), {1});
    EXPECT_EQ(narrow.settle_files, wide.settle_files);
    EXPECT_THAT(narrow.settle_files.at(settle_file),
                HasSubstr("fix             plate all mesh/surface/stress"));
    EXPECT_FALSE(narrow.settle_files.contains("trough.stl"));
    EXPECT_NE(narrow.files.at("trough.stl"), wide.files.at("trough.stl"));
    std::string const& deck = narrow.files.at(drive_file);
    EXPECT_THAT(deck, HasSubstr("meshes trough "));
    EXPECT_THAT(deck, HasSubstr("delete_atoms region outlet compress no"));
    EXPECT_THAT(deck, Not(HasSubstr("plate")));
    EXPECT_THAT(deck, Not(HasSubstr("phases.csv")));
}

// A screen without holes settles on the floor that moves.
TEST(ScreenDeck, WithoutHolesHasThePlainFloor) {
    Deck const closed = make_deck(screened("0 mm"), {1});
    EXPECT_TRUE(closed.settle_files.contains("trough.stl"));
    EXPECT_FALSE(closed.files.contains("plate.stl"));
}

// The expected cost counts the triangles that the deck has.
TEST(ScreenDeck, ItsTrianglesAreCounted) {
    for (char const* opening : {"5 mm", "8 mm"}) {
        auto const prepared = screened(opening);
        std::string const stl = make_deck(prepared, {1}).files.at("trough.stl");
        std::size_t facets = 0;
        for (auto at = stl.find("facet normal"); at != std::string::npos;
             at = stl.find("facet normal", at + 1))
            ++facets;
        EXPECT_EQ(facets, static_cast<std::size_t>(triangles_of_screen(prepared)));
    }
    EXPECT_EQ(triangles_of_screen(screened("0 mm")), 0);
}

// A fed screen: a plate under the feed, holes behind it, and a wall below the edge, in both decks. Its
// columns are those that measure reads.
TEST(ScreenDeck, OfAFedScreenSeparatesWhatPassedFromWhatLeft) {
    auto const prepared = fed_screen();
    Deck const deck = make_deck(prepared, {1});
    auto const [area, x, y] = area_and_ends(deck.files.at("trough.stl"));
    EXPECT_NEAR(area, 0.06 * 0.018 - prepared.domain.screen->along * 3 * 25e-6, 1e-12);
    EXPECT_EQ(x, 0.06);
    // Grains that roll to the holes while they settle would fall out of the box.
    EXPECT_FALSE(deck.settle_files.contains("trough.stl"));
    EXPECT_NEAR(area_and_ends(deck.settle_files.at("plate.stl"))[0], 0.06 * 0.018, 1e-12);
    EXPECT_THAT(deck.settle_files.at(settle_file),
                testing::AllOf(HasSubstr("meshes plate left right back end"),
                               HasSubstr("equal f_plate[1]+f_left[1]")));
    EXPECT_EQ(area_and_ends(deck.files.at("end.stl"))[1], 0.06);
    EXPECT_GT(prepared.domain.screen->plate, prepared.domain.open->feed_end);
    std::string const& drive = deck.files.at(drive_file);
    for (char const* line :
         {"n_meshes 5 meshes trough left right back end", "fix             drive_end all move/mesh mesh end",
          "delete_atoms    region passing compress no",
          ",window_mass,passed,passed_mass,size_1,size_2,size_3\""})
        EXPECT_THAT(drive, HasSubstr(line));
}

// The feed falls onto the plate with a metre per second, and a collision may turn it along the screen:
// nothing leaves the box before it is taken out at the end of a cycle, whichever way it flies.
TEST(ScreenDeck, TheBoxHoldsWhatTheFallOfTheFeedThrowsOverTheEdge) {
    for (char const* inclination : {"0 deg", "-10 deg"}) {
        auto const c = fed_screen(inclination);
        prepare::OpenTrough const& open = *c.domain.open;
        double const alpha = c.scenario.trough.inclination, period = 1 / c.scenario.trough.frequency;
        double const drop = open.feed_top * std::cos(alpha) - 0.06 * std::sin(alpha);
        double const speed = std::sqrt(open.feed_speed * open.feed_speed + 2 * 9.81 * drop);
        double const faster = -9.81 / 2 * period * period * std::sin(alpha);
        EXPECT_GT(speed, 2 * c.largest_speed);
        EXPECT_GT(open.box_end, open.out_x + speed * period + faster);
        EXPECT_LT(open.box_start, -speed * period);
        EXPECT_GT(open.box_side, speed * period);
    }
}

// Gaudin's probability: of an opening of 5 and bars of 1, a point passes with (5/6)^2, a sphere of 4 with
// (1/6)^2, and one as large as the opening never.
TEST(ScreenModel, IsTheShareOfTheAreaForTheCentre) {
    scenario::Screen const screen{0.005, 0.001, 1.0};
    EXPECT_NEAR(prepare::passage_probability(screen, 1e-12), 25.0 / 36, 1e-9);
    EXPECT_NEAR(prepare::passage_probability(screen, 0.004), 1.0 / 36, 1e-12);
    EXPECT_EQ(prepare::passage_probability(screen, 0.005), 0);
    EXPECT_EQ(prepare::passage_probability(screen, 0.006), 0);
}

}  // namespace
}  // namespace vibrotrough::deck
