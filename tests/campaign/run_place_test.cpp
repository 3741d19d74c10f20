#include "campaign/execute/run_place.hpp"

#include "core/error.hpp"
#include "core/temporary_folder.hpp"

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace vibrotrough::campaign {
namespace {

namespace fs = std::filesystem;

class RunPlaceTest : public testing::Test {
  protected:
    static void write(fs::path const& file, std::string const& text) { std::ofstream(file) << text; }
    static std::string read(fs::path const& file) {
        std::ifstream stream(file);
        return {std::istreambuf_iterator<char>(stream), {}};
    }
    RunPlaceTest() {
        fs::create_directory(home);
        fs::create_directory(scratch);
        for (char const* const name : {"in.liggghts", "cycles.csv", "checkpoint.50.restart", "notes.txt"})
            write(home / name, name);
    }
    RunPlace make_place() const { return {home, scratch.string(), home}; }
    /// What lies below the scratch folder, besides the place of a run.
    std::vector<fs::path> kept() const {
        std::vector<fs::path> found;
        for (auto const& entry : fs::directory_iterator(scratch))
            if (entry.path().filename().string().starts_with("vibrotrough-kept-")) found.push_back(entry);
        return found;
    }

    core::TemporaryFolder const folder;
    fs::path home = folder.path() / "home", scratch = folder.path() / "scratch";
};

// A site's purge removes files and leaves the folder: what the home has stays as it is.
TEST_F(RunPlaceTest, APurgeOfTheScratchFolderTakesNothingFromTheHome) {
    RunPlace place = make_place();
    for (auto const& entry : fs::directory_iterator(place.folder()))
        if (entry.is_regular_file()) fs::remove(entry.path());
    write(place.folder() / "checkpoint.100.restart", "new");
    EXPECT_THROW(place.bring_back(), core::MissingError);
    for (char const* const name : {"in.liggghts", "cycles.csv", "checkpoint.50.restart", "notes.txt"})
        EXPECT_EQ(read(home / name), name);
    EXPECT_FALSE(fs::exists(home / "checkpoint.100.restart"));
}

TEST_F(RunPlaceTest, WhatARunReplacesAndRemovesIsReplacedAndRemovedInTheHome) {
    RunPlace place = make_place();
    write(place.folder() / "checkpoint.100.restart", "new");
    fs::remove(place.folder() / "checkpoint.50.restart");
    write(place.folder() / "cycles.csv", "longer than before");
    place.bring_back();
    EXPECT_EQ(read(home / "checkpoint.100.restart"), "new");
    EXPECT_FALSE(fs::exists(home / "checkpoint.50.restart"));
    EXPECT_EQ(read(home / "cycles.csv"), "longer than before");
    EXPECT_EQ(read(home / "notes.txt"), "notes.txt");
}

// A person may have put anything into a packing's folder.
TEST_F(RunPlaceTest, OnlyFilesOfTheRunAreCopied) {
    fs::create_directory(home / "pictures");
    write(home / "in.liggghts", "fix mine all print 100 \"$t\" append forces.txt");
    write(home / "forces.txt", "1");
    RunPlace const place = make_place();
    for (char const* const name : {"in.liggghts", "cycles.csv", "checkpoint.50.restart", "forces.txt"})
        EXPECT_EQ(read(place.folder() / name), read(home / name));
    EXPECT_FALSE(fs::exists(place.folder() / "notes.txt"));
    EXPECT_FALSE(fs::exists(place.folder() / "pictures"));
}

// A file in the way of the home's folder for frames stands for a disk that refuses.
TEST_F(RunPlaceTest, WhatCannotBeBroughtBackIsKeptUntilItCan) {
    write(home / "dump", "in the way");
    fs::path const frame = fs::path("dump") / "frames.100.dump";
    {
        RunPlace place = make_place();
        fs::create_directory(place.folder() / "dump");
        write(place.folder() / frame, "grains");
        write(place.folder() / "checkpoints.txt", "100\n");
        write(place.folder() / ".engine", "");
        try {
            place.bring_back();
            FAIL();
        } catch (core::MissingError const& error) {
            EXPECT_NE(std::string(error.what()).find((scratch / "vibrotrough-kept-").string()),
                      std::string::npos);
        }
    }
    ASSERT_EQ(kept().size(), 1);
    core::TemporaryFolder const next("vibrotrough-scratch", scratch);  // removes what killed runs have left
    EXPECT_THROW(bring_back_kept(home, scratch.string(), home), core::MissingError);
    ASSERT_EQ(kept().size(), 1);
    EXPECT_EQ(read(kept().front() / frame), "grains");
    fs::remove(home / "dump");
    EXPECT_TRUE(bring_back_kept(home, scratch.string(), home));
    EXPECT_EQ(read(home / frame), "grains");
    EXPECT_EQ(read(home / "notes.txt"), "notes.txt");
    EXPECT_TRUE(kept().empty());
    EXPECT_FALSE(bring_back_kept(home, scratch.string(), home));
}

// Another machine may have done the work meanwhile.
TEST_F(RunPlaceTest, WhatIsKeptIsNotBroughtIntoAHomeThatHasMore) {
    write(home / "dump", "in the way");
    {
        RunPlace place = make_place();
        fs::create_directory(place.folder() / "dump");
        write(place.folder() / "dump" / "frames.100.dump", "grains");
        write(place.folder() / "checkpoints.txt", "100\n");
        write(place.folder() / ".engine", "");
        EXPECT_THROW(place.bring_back(), core::MissingError);
    }
    write(home / "checkpoints.txt", "150\n");
    bring_back_kept(home, scratch.string(), home);
    EXPECT_EQ(read(home / "checkpoints.txt"), "150\n");
    EXPECT_TRUE(kept().empty());
}

// In a folder like /tmp anybody may have taken the name.
TEST_F(RunPlaceTest, AFolderThatOthersCanChangeIsNotBroughtBack) {
    write(home / "dump", "in the way");
    {
        RunPlace place = make_place();
        fs::create_directory(place.folder() / "dump");
        write(place.folder() / "dump" / "frames.100.dump", "grains");
        EXPECT_THROW(place.bring_back(), core::MissingError);
    }
    fs::remove(home / "dump");
    fs::permissions(kept().front(), fs::perms::group_write, fs::perm_options::add);
    EXPECT_FALSE(bring_back_kept(home, scratch.string(), home));
    EXPECT_FALSE(fs::exists(home / "dump"));
}

TEST_F(RunPlaceTest, AScratchFolderThatRefusesIsNamedWithReasonAndKey) {
    try {
        RunPlace const place(home, "/proc", home);  // in which not even root makes folders
        FAIL();
    } catch (core::MissingError const& error) {
        std::string const said = error.what();
        for (char const* const part :
             {"run.scratch = \"/proc\"", "cannot make a temporary folder in /proc (No such file"})
            EXPECT_NE(said.find(part), std::string::npos) << said;
        EXPECT_EQ(said.find("TMPDIR"), std::string::npos) << said;
    }
}

}  // namespace
}  // namespace vibrotrough::campaign
