#include "scenario/model/grains.hpp"

#include "core/temporary_folder.hpp"
#include "example_campaign.hpp"
#include "scenario/reader/campaign_file.hpp"
#include "scenario/reader/written_campaign.hpp"

#include <cmath>
#include <fstream>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

namespace vibrotrough {
namespace {

scenario::Grains grains(std::string const& text) {
    return scenario::parse_campaign(text, "test.toml").cases.front().grains;
}

scenario::Grains law(std::string const& name, double spread) {
    scenario::Grains g = grains(example_campaign);
    g.diameter_spread = spread;
    g.size_law = name == "uniform" ? scenario::SizeLaw::uniform : scenario::SizeLaw::lognormal;
    return g;
}

double sum_of_fractions(scenario::Grains const& g) {
    double sum = 0;
    for (scenario::SizeClass const& size : size_classes(g)) sum += size.number_fraction;
    return sum;
}

// Mean volume pi d^3 / 6 times: 1 + 2 s^2 for three classes at d (1 - s, 1, 1 + s); 1 + s^2 for the uniform
// law, E[(1 + s u)^3] with u uniform in [-1, 1]. The classes keep it to rounding.
TEST(Grains, ClassesKeepTheMeanVolume) {
    double const volume = std::numbers::pi / 6 * 27e-9;
    EXPECT_NEAR(mean_grain_volume(grains(example_campaign)) / volume, 1 + 2 * 0.01, 1e-12);
    EXPECT_NEAR(mean_grain_volume(law("uniform", 0.3)) / volume, 1 + 0.09, 1e-12);
}

// The standard deviation of the diameters over s d: sqrt(2/3) for three classes, 1/sqrt(3) for the uniform
// law, as the page of keys says. Tolerances: what the page rounds to, and for the uniform law its classes.
TEST(Grains, TheSpreadIsTheStandardDeviationThatIsDocumented) {
    auto const deviation = [](scenario::Grains const& g) {
        double mean = 0, square = 0;
        for (scenario::SizeClass const& size : size_classes(g)) {
            mean += size.number_fraction * size.diameter;
            square += size.number_fraction * size.diameter * size.diameter;
        }
        return std::sqrt(square - mean * mean) / (g.diameter_spread * g.diameter);
    };
    EXPECT_NEAR(deviation(grains(example_campaign)), 0.82, 0.005);
    EXPECT_NEAR(deviation(law("uniform", 0.2)), 0.58, 0.02);
    std::string_view const meaning = scenario::find_key("grains.diameter_spread")->meaning;
    EXPECT_NE(meaning.find("0.82 s of three classes, 0.58 s of a uniform"), std::string_view::npos)
        << meaning;
}

// E[d^3] = m^3 exp(9 s^2 / 2) for the whole law; cutting it at 2.5 s takes away large grains. Checked against
// the integral of exp(3 s z) phi(z) over |z| < 2.5 by the midpoint rule.
TEST(Grains, LognormalIsCutAtTwoAndAHalf) {
    double const s = 0.3;
    double integral = 0, inside = 0;
    int const n = 20000;
    for (int i = 0; i < n; ++i) {
        double const z = -2.5 + 5.0 * (i + 0.5) / n, phi = std::exp(-z * z / 2) * 5.0 / n;
        integral += std::exp(3 * s * z) * phi;
        inside += phi;
    }
    EXPECT_NEAR(mean_grain_volume(law("lognormal", s)) / (std::numbers::pi / 6 * 27e-9), integral / inside,
                1e-6);
    EXPECT_LT(largest_diameter(law("lognormal", s)), 3e-3 * std::exp(2.5 * s));
    EXPECT_GT(smallest_diameter(law("lognormal", s)), 3e-3 * std::exp(-2.5 * s));
}

TEST(Grains, ClassesAreLargestFirstAndSumToOne) {
    for (scenario::Grains const& g : {grains(example_campaign), law("uniform", 0.5), law("lognormal", 0.5)}) {
        auto const sizes = size_classes(g);
        EXPECT_NEAR(sum_of_fractions(g), 1, 1e-12);
        for (std::size_t i = 1; i < sizes.size(); ++i) EXPECT_LT(sizes[i].diameter, sizes[i - 1].diameter);
    }
}

// Equal masses of 2 mm and 4 mm are 8 : 1 by number.
TEST(Grains, MassFractionsAreByVolume) {
    scenario::Grains const g = grains(with("diameter = \"3 mm\"\ndiameter_spread = 0.1",
                                           "diameters = [\"2 mm\", \"4 mm\"]\nmass_fractions = [1, 1]"));
    auto const sizes = size_classes(g);
    ASSERT_EQ(sizes.size(), 2u);
    EXPECT_NEAR(sizes[1].number_fraction / sizes[0].number_fraction, 8, 1e-12);
    EXPECT_NEAR(g.diameter, (8 * 2e-3 + 4e-3) / 9, 1e-15);
    scenario::Grains const by_number =
        grains(with("diameter = \"3 mm\"\ndiameter_spread = 0.1",
                    "diameters = [\"2 mm\", \"4 mm\"]\nnumber_fractions = [3, 1]"));
    EXPECT_NEAR(size_classes(by_number)[1].number_fraction, 0.75, 1e-12);
}

TEST(Grains, ShapeFilesAreReadAndTheirMistakesNamed) {
    scenario::Grains g = grains(with("diameter_spread = 0.1", "shape = \"cube\""));
    EXPECT_EQ(shape_spheres(g).size(), 8u);
    g.shape = "two.csv";
    auto const error_of = [&](std::string const& text) -> std::string {
        try {
            g.shape_file = scenario::read_shape({"two.csv", text});
        } catch (std::invalid_argument const& error) {
            return error.what();
        }
        return {};
    };
    EXPECT_EQ(error_of("# a dumb-bell\nx,y,z,radius\n0,0,0,1\r\n1.5,0,0,1\n"), "");
    EXPECT_EQ(error_of(""), "there are no spheres");
    EXPECT_EQ(error_of("x,y,z\n"), "line 1: this is not the header x,y,z,radius");
    EXPECT_EQ(error_of("x,y,z,radius\n0,0,0,1\n0,0,1\n"),
              "line 3: expected 4 values, one per column, but found 3");
    EXPECT_EQ(error_of("x,y,z,radius\n0,0,0,inf\n"), "line 2: column radius: 'inf' is not a finite number");
    EXPECT_EQ(error_of("x,y,z,radius\n0,0,0,0\n"), "line 2: the radius is not above 0");
    // Third powers of such numbers overflow or are lost in rounding.
    for (char const* far : {"1e155,0,0,1", "0,-1e300,0,1", "0,0,1001,1", "0,0,0,1e155"}) {
        std::string const error = error_of(std::string("x,y,z,radius\n0,0,0,1\n") + far + "\n");
        EXPECT_NE(error.find("more than 1000 times the smallest radius"), std::string::npos) << far << error;
    }
}

// A campaign with a shape of its own, from the file beside it.
TEST(Grains, ShapeFileStandsBesideTheCampaign) {
    core::TemporaryFolder const own_folder;
    std::filesystem::path const& folder = own_folder.path();
    std::ofstream(folder / "two.csv") << "x,y,z,radius\n0,0,0,1\n1.5,0,0,1\n";
    std::ofstream(folder / "c.toml") << with("diameter_spread = 0.1", "shape = \"two.csv\"");
    scenario::Scenario const s = scenario::read_campaign(folder / "c.toml").cases.front();
    EXPECT_EQ(shape_spheres(s.grains).size(), 2u);
    ASSERT_EQ(named_files(s).size(), 1u);
    EXPECT_NE(to_toml(s).find("shape = \"two.csv\""), std::string::npos);
}

}  // namespace
}  // namespace vibrotrough
