#include "atlas/atlas.hpp"

#include "atlas/tables.hpp"
#include "atlas/value.hpp"
#include "core/csv.hpp"
#include "prepare/prepared_case.hpp"
#include "scenario/example_campaign.hpp"
#include "scenario/single_case.hpp"
#include "theory/point_mass.hpp"
#include "theory/rolling_layer.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>

#include <boost/math/distributions/students_t.hpp>
#include <gtest/gtest.h>

namespace vibrotrough::atlas {
namespace {

/// A layer in the middle of the atlas: 12 mm of 3 mm spheres are 4 diameters.
std::string const inside_layer =
    with("rolling_friction = 0.0", "rotation = \"rolling\"\nrolling_friction = 0.1");

Answer answer_of(std::string const& text) {
    return predict(prepare::prepare_case(single_case(text)));
}

std::vector<std::string> names_outside(std::string const& text) {
    std::vector<std::string> names;
    for (Outside const& one : answer_of(text).outside) names.push_back(one.name);
    return names;
}

using Names = std::vector<std::string>;

TEST(Atlas, PredictsALayerInsideOfIt) {
    Answer const answer = answer_of(inside_layer);
    EXPECT_TRUE(answer.is_inside());
    // The demo's layer, which has 0.82 at throw number 2 without rolling friction; with it, between the point
    // mass (0.58) and that.
    EXPECT_GT(answer.efficiency.value(), 0.5);
    EXPECT_LT(answer.efficiency.value(), 0.95);
    EXPECT_GT(answer.half_width.value(), 0.01);
    EXPECT_LT(answer.half_width.value(), 0.25);
}

// Each case changes one line of a layer that lies inside.
TEST(Atlas, NamesWhatLiesOutside) {
    EXPECT_EQ(names_outside(with("height = \"12 mm\"", "height = \"69 mm\"", inside_layer)), Names{"depth"});
    EXPECT_EQ(names_outside(with("throw_number = 2.0", "throw_number = 3.5", inside_layer)),
              Names{"throw_number"});
    EXPECT_EQ(names_outside(with("diameter_spread = 0.1", "diameter_spread = 0", inside_layer)),
              Names{"diameter_spread"});
    EXPECT_EQ(
        names_outside(with("restitution = 0.5\n\n[grains]", "restitution = 0.8\n\n[grains]", inside_layer)),
        Names{"trough.restitution"});
    EXPECT_TRUE(
        answer_of(with("throw_number = 2.0", "throw_number = 3.5", inside_layer)).efficiency.has_value());
}

// Each number lies in its range, but no layer was simulated that has them together: with 0.02 more friction
// than slope, and 12 diameters deep on a steep slope or with a small amplitude.
TEST(Atlas, NamesWhatItHasNoLayersOfTogether) {
    Place const inside{2, 0.5, 0.1, 0.3, 0.5, 12, 0.5, 0.1, 0.5};
    EXPECT_TRUE(outside_ranges(inside).empty());
    auto const outside = [&](Input input, double value, Place place) {
        place[input] = value;
        auto const all = outside_ranges(place);
        return all.size() == 1 ? all.front().why : std::string();
    };
    Place downhill = inside;
    downhill[tan_inclination_input] = -0.13;
    downhill[depth_input] = 5;
    EXPECT_EQ(outside(friction_input, 0.155, downhill), "friction 0.155 (the atlas has 0.16 to 0.6)");
    EXPECT_EQ(outside(tan_inclination_input, -0.11, inside), "depth 12 (the atlas has 2 to 6)");
    EXPECT_EQ(outside(amplitude_input, 0.4, inside), "depth 12 (the atlas has 2 to 6)");
}

TEST(Atlas, DoesNotPredictLayersOfAnotherKind) {
    for (auto const& [from, to, name] :
         {std::tuple{"diameter_spread = 0.1", "shape = \"cube\"", "grains.shape"},
          std::tuple{"diameter_spread = 0.1", "diameter_spread = 0.1\nrotation = \"blocked\"",
                     "grains.rotation"},
          std::tuple{"friction = 0.23", "friction = 0.23\nside_wall_friction = 0.2",
                     "trough.side_wall_friction"},
          std::tuple{"friction = 0.23", "friction = 0.23\nalong_phase = \"30 deg\"", "trough"},
          std::tuple{"[measure]", "[engine]\ncontact = \"hooke\"\n\n[measure]", "engine.contact"},
          std::tuple{"[measure]", "[engine]\ncohesion = \"1 kJ/m3\"\n\n[measure]", "engine.cohesion"}}) {
        std::string text = with(from, to, inside_layer);
        if (std::string(name).starts_with("grains."))  // rolling friction is only for spheres that rotate
            text = with("rotation = \"rolling\"\nrolling_friction = 0.1\n", "", text);
        Answer const answer = answer_of(text);
        ASSERT_FALSE(answer.is_inside()) << to;
        EXPECT_EQ(answer.outside.front().name, name);
        EXPECT_FALSE(answer.efficiency.has_value()) << to;
    }
}

/// The layer of an open trough with smooth walls, by its feed.
std::string fed(std::string const& mass_flow, std::string const& text = inside_layer) {
    std::string const open = with("height = \"12 mm\"\n", "", with("36 mm", "200 mm", text));
    return with("friction = 0.23", "friction = 0.23\nside_wall_friction = 0", open) +
           "[feed]\nmass_flow = \"" + mass_flow + "\"\nlength = \"60 mm\"\n";
}

// The mass flow of the layer is that of the feed: Q = rho_b b h v. A periodic layer of the same depth has the
// same efficiency: 1e-5, to which the depth is found, in diameters, times at most 1 per diameter.
TEST(Atlas, TheFeedMakesTheDepth) {
    auto const prepared = prepare::prepare_case(single_case(fed("0.25 t/h")));
    Answer const answer = predict(prepared);
    ASSERT_TRUE(answer.is_inside()) << answer.outside.front().why;
    double const depth = answer.fed_depth.value().value, speed = *answer.efficiency * prepared.velocity_scale;
    EXPECT_NEAR(1400 * 0.58 * 0.018 * depth * speed, 250 / 3600.0, 1e-6);
    EXPECT_NEAR(answer.fed_depth->half_width / depth, *answer.half_width / *answer.efficiency, 1e-12);
    Answer const periodic = answer_of(
        with("height = \"12 mm\"", "height = \"" + std::to_string(1e3 * depth) + " mm\"", inside_layer));
    EXPECT_NEAR(periodic.efficiency.value(), *answer.efficiency, 1e-5);
    EXPECT_FALSE(place_of(prepared).has_value());
}

// A layer that is slower by a part w at every depth carries the feed Q in the depth in which the atlas' layer
// carries Q / (1 - w). The half-width is half the way between both ends: w^2, 0.15, for the curvature. Weakly
// thrown uphill the layer is slower where it is deeper; at the second drive it hardly is.
TEST(Atlas, AnErrorOfTheSpeedChangesTheDepthOfAFedLayer) {
    for (auto const& [throw_number, up, friction, tons, least] :
         {std::tuple{"1.18", "0.053", "0.547", 0.1, 1.15}, std::tuple{"2.0", "0.09", "0.23", 0.25, 1.0}}) {
        std::string const drive =
            with("throw_number = 2.0", std::string("throw_number = ") + throw_number,
                 with("inclination = \"0 deg\"", std::string("tan_inclination = ") + up, inside_layer));
        auto const answer_with_friction = [&](std::string const& text) {
            return answer_of(with("friction = 0.23", std::string("friction = ") + friction, text));
        };
        auto const at = [&](double feed) {
            return answer_with_friction(fed(std::to_string(feed) + " t/h", drive));
        };
        Answer const answer = at(tons);
        double const depth = answer.fed_depth.value().value;
        std::string const height = "height = \"" + std::to_string(1e3 * depth) + " mm\"";
        Answer const periodic = answer_with_friction(with("height = \"12 mm\"", height, drive));
        double const w = periodic.half_width.value() / periodic.efficiency.value();
        double const deep = at(tons / (1 - w)).fed_depth.value().value;
        double const shallow = at(tons / (1 + w)).fed_depth.value().value;
        EXPECT_NEAR(answer.fed_depth->half_width, (deep - shallow) / 2, 0.15 * (deep - shallow) / 2) << tons;
        EXPECT_GE(answer.fed_depth->half_width / depth / w, least) << throw_number;
    }
}

TEST(Atlas, AFedLayerMayBeTooShallowOrTooDeepForIt) {
    std::string const much =
        with("200 mm", "400 mm", with("length = \"60 mm\"", "length = \"160 mm\"", fed("3 t/h")));
    for (auto const& [layer, low, high] :
         {std::tuple{fed("0.02 t/h"), 0.1, 0.5}, std::tuple{much, 32.0, 100.0}}) {
        Answer const answer = answer_of(layer);
        EXPECT_FALSE(answer.efficiency.has_value() || answer.fed_depth.has_value()) << layer;
        ASSERT_EQ(names_outside(layer), Names{"depth"}) << layer;
        double const depth = std::stod(answer.outside.front().why.substr(6));
        EXPECT_GT(depth, low) << layer;
        EXPECT_LT(depth, high) << layer;
    }
    std::string const rough = with("side_wall_friction = 0", "side_wall_friction = 0.2", fed("0.25 t/h"));
    EXPECT_EQ(names_outside(rough), Names{"trough.side_wall_friction"});
    // A drive far outside is named as such.
    EXPECT_EQ(names_outside(with("throw_number = 2.0", "throw_number = 6.0", fed("0.25 t/h"))),
              Names{"throw_number"});
    std::string const up = with("inclination = \"0 deg\"", "tan_inclination = 0.1", inside_layer);
    EXPECT_EQ(names_outside(with("throw_number = 2.0", "throw_number = 0.75", fed("0.25 t/h", up))),
              Names{"feed"});
}

// The same numbers without a dimension: twice the length and sqrt(2) times the time. Tolerance: rounding.
TEST(Atlas, DependsOnNumbersWithoutDimension) {
    std::string large = with("diameter = \"3 mm\"", "diameter = \"6 mm\"", inside_layer);
    large = with("amplitude = \"6 mm\"", "amplitude = \"12 mm\"", large);
    large = with("height = \"12 mm\"", "height = \"24 mm\"", large);
    large = with("length = \"36 mm\"\nwidth = \"18 mm\"", "length = \"72 mm\"\nwidth = \"36 mm\"", large);
    large = with("density = \"1400", "density = \"2800", large);
    EXPECT_NEAR(answer_of(large).efficiency.value(), answer_of(inside_layer).efficiency.value(), 1e-9);
}

TEST(Atlas, TablesAreReadBack) {
    auto const& of = surface_inputs();
    auto const draws = read_draws(draws_table, "draws.csv", of);
    ASSERT_FALSE(draws.empty());
    EXPECT_EQ(draws_csv(read_draws(draws_csv(draws, of), "again", of), of), draws_csv(draws, of));
    EXPECT_EQ(static_cast<int>(read_layers(layers_table, "layers.csv").size()), simulated_layers());
    EXPECT_THROW(read_layers("case,throw_number\na,1\n", "layers.csv"), core::CsvError);
    EXPECT_THROW(read_draws("deviation\nx\n", "draws.csv"), core::CsvError);
}

// The stored trend of each layer is what the program works out: the constants of the law, and how rolling
// friction adds, are those with which the table was made. Tolerance: five digits in the table.
TEST(Atlas, TheStoredTrendIsThatOfTheProgram) {
    for (SurfacePoint const& one : read_layers(layers_table, "layers.csv")) {
        theory::PointMass const point{one.place[throw_number_input], one.place[tan_vibration_input],
                                      one.place[tan_inclination_input], one.place[friction_input]};
        theory::RollingLaw law;
        law.dry_torque += one.place[rolling_friction_input];
        double const rolling = theory::solve(theory::RollingLayer{point, law}).motion.velocity_efficiency;
        EXPECT_NEAR(one.theory, trend_of(rolling, theory::solve(point).velocity_efficiency), 2e-5)
            << one.case_id;
    }
}

// validation/atlas/design.py has the same ranges: its layers lie within those of the program and fill them.
// The first sequence comes back to five values of the friction between grains, 0.35 to 0.75, so that four
// fifths are asked. What the program says of where it has no layers holds for all of them.
TEST(Atlas, TheLayersFillTheRanges) {
    auto const points = read_layers(layers_table, "layers.csv");
    for (std::size_t k = 0; k < inputs().size(); ++k) {
        double low = points.front().place[k], high = low;
        for (SurfacePoint const& one : points) {
            low = std::min(low, one.place[k]);
            high = std::max(high, one.place[k]);
        }
        double const width = inputs()[k].high - inputs()[k].low;
        EXPECT_GE(low, inputs()[k].low) << inputs()[k].key;
        // Layers that climb more steeply are too few to be promised.
        EXPECT_LE(high, k == tan_inclination_input ? 0.18 : inputs()[k].high) << inputs()[k].key;
        EXPECT_GT(high - low, 0.8 * width) << inputs()[k].key;
    }
    for (SurfacePoint const& one : points) {
        bool const climbs_steeply = one.place[tan_inclination_input] > inputs()[tan_inclination_input].high;
        EXPECT_EQ(outside_ranges(one.place).empty(), !climbs_steeply) << one.case_id;
    }
}

// What is not known is in the middle of its range, of its logarithm for the depth: sqrt(2 * 20).
TEST(Atlas, WhatIsNotKnownIsInTheMiddle) {
    KnownNumbers numbers{2, 0.5, 0, 0.3, 2, {}, 0.55, {}, 0.6026};
    Place const place = place_of(numbers);
    EXPECT_NEAR(place[depth_input], std::sqrt(40), 1e-12);
    EXPECT_NEAR(place[rolling_friction_input], 0.1, 1e-12);
    EXPECT_EQ(place[friction_input], 0.3);
}

// The difference between two places is that of what the atlas says of them, and is known better than by two
// intervals that had nothing in common.
TEST(Atlas, ADifferenceIsKnownBetterThanItsEnds) {
    Place const shallow{2, 0.5, 0, 0.3, 2, 3, 0.55, 0.1, 0.55};
    Place deep = shallow;
    deep[depth_input] = 4;
    SurfaceValue const found = difference_between(deep, shallow).value();
    EXPECT_NEAR(found.efficiency, *efficiency_at(deep) - *efficiency_at(shallow), 1e-12);  // rounding
    EXPECT_GT(found.half_width, 0);
    EXPECT_LT(found.half_width, std::hypot(value_at(deep)->half_width, value_at(shallow)->half_width));
    EXPECT_NEAR(difference_between(deep, deep)->half_width, 0, 1e-6);  // the root of rounding errors of 1e-12
}

TEST(Atlas, TellsWhatDepthAndSlopeChange) {
    auto const effects_of = [](std::string const& text) {
        return effects(prepare::prepare_case(single_case(text)));
    };
    Effects const level = effects_of(inside_layer).value();
    EXPECT_NEAR(level.depth, 4, 0.2);
    EXPECT_TRUE(level.of_depth.has_value());
    EXPECT_FALSE(level.of_slope.has_value());
    Effects const uphill =
        effects_of(with("inclination = \"0 deg\"", "tan_inclination = 0.05", inside_layer)).value();
    // The difference from the point mass: without what the slope does to both.
    EXPECT_LT(std::abs(uphill.of_slope->efficiency), 0.3);
    EXPECT_FALSE(effects_of(with("height = \"12 mm\"", "height = \"69 mm\"", inside_layer)).has_value());
}

// What all layers have in common of an error is m x, where m is known with t sigma (mean_half_width) and not
// corrected: the root of (t m)^2 + (t sigma)^2, times x, which is s^2, d^2 / (L W) and the step over
// Rayleigh's time at the ordinary settings. Largest at throw numbers 1.75 to 2.65. Tolerance: two digits.
TEST(Atlas, CommonNumericalErrorIsThatOfTheStudy) {
    std::map<std::string, double> common;
    std::ifstream file(VALIDATION_FOLDER "/numerics/model.csv");
    std::string const text(std::istreambuf_iterator<char>(file), {});
    core::CsvReader reader(text, "model.csv", {.comments = true});
    auto const column = [&](std::string const& name) {
        auto const& all = reader.columns();
        return static_cast<std::size_t>(std::ranges::find(all, name) - all.begin());
    };
    std::map<std::string, double> const x{{"softness", 0.079 * 0.079}, {"box", 1 / 40.0}, {"step", 0.2}};
    while (reader.next()) {
        std::string const error(reader.cells()[column("error")]);
        boost::math::students_t const t(reader.number(column("layers")) - 1);
        double const mean = boost::math::quantile(t, 0.975) * reader.number(column("mean"));
        common[error] =
            std::max(common[error], std::hypot(mean, reader.number(column("mean_half_width"))) * x.at(error));
    }
    EXPECT_NEAR(common_numerical_error, std::hypot(common["softness"], common["box"], common["step"]), 5e-4);
}

// Even by the logarithm of the depth, from the estimates of layers up to 6 diameters to the bounds from 8 on:
// half way at sqrt(6 x 8).
TEST(Atlas, NumericalErrorsGoFromEstimatesToBounds) {
    double const shallow = common_numerical_error, deep = read_numerical_bound(layers_table, "layers.csv");
    EXPECT_GT(deep, 0.03) << "bounds are about three times the differences (validation/whole_interval)";
    for (double const depth : {3.0, 6.0}) EXPECT_NEAR(numerical_error(depth), shallow, 1e-12);
    for (double const depth : {8.0, 20.0}) EXPECT_NEAR(numerical_error(depth), deep, 1e-12);
    EXPECT_NEAR(numerical_error(std::sqrt(48)), (shallow + deep) / 2, 1e-12);
}

// Every simulated layer lies within the interval that the surface has at its own place, but for the share
// that 95 % intervals leave out: the tables belong to each other.
TEST(Atlas, TheDrawsBelongToTheLayers) {
    auto const points = read_layers(layers_table, "layers.csv");
    Surface const surface(surface_inputs(), with_trends(points),
                          read_draws(draws_table, "draws.csv", surface_inputs()));
    EXPECT_GE(surface.quality().covered, surface.quality().least_covered);
    EXPECT_GT(surface.quality().q2, 0.8);
}

}  // namespace
}  // namespace vibrotrough::atlas
