#include "campaign/state/checkpoint.hpp"

#include "campaign_folder.hpp"
#include "core/atomic_file.hpp"

namespace vibrotrough::campaign {
namespace {

namespace fs = std::filesystem;

// A run that goes on from cycle 50 writes everything after it anew: what lies there of later cycles would be
// there twice, or be taken for a checkpoint that nobody has sealed.
TEST(Checkpoint, NothingOfLaterCyclesStays) {
    core::TemporaryFolder const temporary;
    fs::path const folder = temporary.path();
    std::vector<std::string> const kept{"checkpoint.50.restart", "dump/frames.500.dump",
                                        "dump/contacts.500.dump", "notes.txt"};
    std::vector<std::string> const later{"checkpoint.60.restart",  "checkpoint.100.restart",
                                         "dump/frames.510.dump",   "dump/frames.600.dump",
                                         "dump/contacts.510.dump", "dump/trough_contacts.510.dump"};
    for (auto const* names : {&kept, &later})
        for (std::string const& name : *names) overwrite(folder / name, "x");
    overwrite(folder / "cycles.csv", "# SI units\nstep,grains\n0,9\n500,9\n510,9\n");
    cut_outputs(folder, {50, "checkpoint.50.restart", "", 1}, 10);
    for (std::string const& name : kept) EXPECT_TRUE(fs::exists(folder / name)) << name;
    for (std::string const& name : later) EXPECT_FALSE(fs::exists(folder / name)) << name;
    EXPECT_EQ(core::read_file(folder / "cycles.csv"), "# SI units\nstep,grains\n0,9\n500,9\n");
    EXPECT_EQ(last_checkpoint(folder), 50);
}

}  // namespace
}  // namespace vibrotrough::campaign
