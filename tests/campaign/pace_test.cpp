#include "campaign/state/pace.hpp"

#include "campaign_folder.hpp"
#include "deck/deck.hpp"

#include <chrono>

namespace vibrotrough::campaign {
namespace {

namespace fs = std::filesystem;

class Pace : public CampaignFolder {
  protected:
    /// The files of a run that began `seconds` before its last cycle.
    void write_run(int packing, int cycles, double seconds) const {
        fs::path const run = planned.packing_folder(packing);
        overwrite(run / "cycles.csv", cycles_text(scenario, cycles, [](int) { return 0.5; }));
        overwrite(run / deck::control_file, "");
        auto const now = fs::last_write_time(run / "cycles.csv");
        fs::last_write_time(run / deck::control_file,
                            now - std::chrono::milliseconds(static_cast<long>(1000 * seconds)));
    }
};

// Time between the start of the engine and its last cycle over the number of cycles. Tolerance: the
// milliseconds to which this test sets the times of the files.
TEST_F(Pace, IsThatOfTheFilesWithoutACheckpoint) {
    write_packing(1, cycles_text(scenario, 60, [](int) { return 0.5; }));
    write_run(2, 10, 25);
    fs::create_directories(planned.packing_folder(3));
    auto const found = packings_under_way(planned);
    ASSERT_EQ(found.size(), 2u) << "packing 1 has ended";
    EXPECT_EQ(found[0].packing, 2);
    EXPECT_EQ(found[0].cycles, 10);
    EXPECT_NEAR(found[0].seconds_per_cycle.value(), 2.5, 0.01);
    EXPECT_EQ(found[1].packing, 3);
    EXPECT_EQ(found[1].cycles, 0) << "it settles";
    EXPECT_FALSE(found[1].seconds_per_cycle);
}

TEST_F(Pace, IsUnknownBeforeTheFirstCycle) {
    write_run(1, 0, 5);
    auto const found = packings_under_way(planned);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_FALSE(found[0].seconds_per_cycle);
}

}  // namespace
}  // namespace vibrotrough::campaign
