#include "campaign/state/friction_results.hpp"

#include "campaign_folder.hpp"
#include "core/error.hpp"

namespace vibrotrough::campaign {
namespace {

class FrictionFile : public CampaignFolder {
  protected:
    evaluate::LayerFriction const measured{"0123456789ab", "ba9876543210", 0.23, 0.67, 1.7,  0.01,
                                           -0.002,         0.21,           0.2,  0.22, "PN", ""};
};

TEST_F(FrictionFile, ComesBackAsWritten) {
    evaluate::LayerFriction without{};
    without.layer = "none";
    without.message = "the layer creeps";
    std::filesystem::create_directories(folder);
    write_friction(folder, {measured, without});
    auto const tests = read_friction(folder);
    ASSERT_EQ(tests.size(), 1u) << "a test without a number is none for compare";
    evaluate::LayerFriction const& read = tests.at("0123456789ab");
    EXPECT_EQ(read.friction, 0.21);
    EXPECT_EQ(read.low, 0.2);
    EXPECT_EQ(read.high, 0.22);
    EXPECT_EQ(read.displacement, 1.7);
    EXPECT_EQ(read.mode, "PN");
}

TEST_F(FrictionFile, MissingIsNoneAndDamagedIsSaid) {
    EXPECT_TRUE(read_friction(folder).empty());
    for (char const* damaged : {"", "[", "[{}]", "[1]", "{\"layer\": 1}"}) {
        overwrite(friction_file(folder), damaged);
        EXPECT_THROW(read_friction(folder), core::InputError) << damaged;
    }
}

// K > mu sqrt(1 + pi^2 / 4): 1.862 mu, a fifth more, and never below the paper's 0.67.
TEST_F(FrictionFile, DefaultMachineNumberMakesTheLayerSlideBothWays) {
    EXPECT_EQ(evaluate::default_machine_number(0.23), 0.67);
    EXPECT_NEAR(evaluate::default_machine_number(0.5), 1.2 * 0.5 * 1.8621, 1e-4);
}

TEST_F(FrictionFile, SaysWhyThereIsNoNumber) {
    auto const untested = measure_friction(plan);
    ASSERT_EQ(untested.size(), 1u);
    EXPECT_FALSE(untested[0].friction);
    EXPECT_EQ(untested[0].message, "not finished");
    write_failure(planned, {core::Outcome::lost_grains, "a grain is gone", 1, 1});
    EXPECT_EQ(measure_friction(plan)[0].message, "lost-grains: a grain is gone");
}

}  // namespace
}  // namespace vibrotrough::campaign
