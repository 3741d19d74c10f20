#include "campaign/execute/run_place.hpp"

#include "core/error.hpp"
#include "core/temporary_folder.hpp"

#include <fstream>
#include <iterator>

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

    core::TemporaryFolder const folder;
    fs::path home = folder.path() / "home", scratch = folder.path() / "scratch";
};

// A site's purge removes files and leaves the folder: what the home has stays as it is.
TEST_F(RunPlaceTest, APurgeOfTheScratchFolderTakesNothingFromTheHome) {
    RunPlace place(home, scratch.string());
    for (auto const& entry : fs::directory_iterator(place.folder()))
        if (entry.is_regular_file()) fs::remove(entry.path());
    write(place.folder() / "checkpoint.100.restart", "new");
    EXPECT_THROW(place.bring_back(), core::MissingError);
    for (char const* const name : {"in.liggghts", "cycles.csv", "checkpoint.50.restart", "notes.txt"})
        EXPECT_EQ(read(home / name), name);
    EXPECT_FALSE(fs::exists(home / "checkpoint.100.restart"));
}

TEST_F(RunPlaceTest, WhatARunReplacesAndRemovesIsReplacedAndRemovedInTheHome) {
    RunPlace place(home, scratch.string());
    write(place.folder() / "checkpoint.100.restart", "new");
    fs::remove(place.folder() / "checkpoint.50.restart");
    write(place.folder() / "cycles.csv", "longer than before");
    place.bring_back();
    EXPECT_EQ(read(home / "checkpoint.100.restart"), "new");
    EXPECT_FALSE(fs::exists(home / "checkpoint.50.restart"));
    EXPECT_EQ(read(home / "cycles.csv"), "longer than before");
    EXPECT_EQ(read(home / "notes.txt"), "notes.txt");
}

}  // namespace
}  // namespace vibrotrough::campaign
