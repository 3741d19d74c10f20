#include "core/atomic_file.hpp"

#include "core/error.hpp"
#include "core/temporary_folder.hpp"

#include <csignal>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

namespace vibrotrough {
namespace {

namespace fs = std::filesystem;

class AtomicFile : public testing::Test {
  protected:
    core::TemporaryFolder const own_folder;
    fs::path folder = own_folder.path();
};

TEST_F(AtomicFile, WritesAndReplaces) {
    core::write_file_atomically(folder / "a", "one");
    core::write_file_atomically(folder / "a", std::string_view("t\0wo", 4));
    EXPECT_EQ(core::read_file(folder / "a"), std::string("t\0wo", 4));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
}

TEST_F(AtomicFile, KeepsTheOldFileWhenTheNewOneCannotBeWritten) {
    core::write_file_atomically(folder / "a", "old");
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    rlimit const smaller{1000, before.rlim_max};
    std::signal(SIGXFSZ, SIG_IGN);
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &smaller), 0);
    EXPECT_THROW(core::write_file_atomically(folder / "a", std::string(5000, 'x')), core::MissingError);
    EXPECT_THROW(core::replace_file(folder / "a", std::string(5000, 'x')), core::MissingError);
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
    EXPECT_EQ(core::read_file(folder / "a"), "old");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
}

TEST_F(AtomicFile, FailsOnPathsThatCannotBeUsed) {
    auto const write = [&] { core::write_file_atomically(folder / "no_such" / "x", "content"); };
    EXPECT_THROW(write(), core::MissingError);
    EXPECT_THROW(core::read_file(folder / "none"), core::MissingError);
    EXPECT_THROW(core::read_file(folder), core::MissingError);
    core::write_file_atomically(folder / "file", "");
    EXPECT_THROW(core::make_folder(folder / "file" / "below"), core::MissingError);
}

TEST_F(AtomicFile, HandsOnTheModeOfTheFileThatItReplaces) {
    for (mode_t const mode : {0600, 0640, 0755, 0444}) {
        core::write_file_atomically(folder / "a", "one");
        ASSERT_EQ(::chmod((folder / "a").c_str(), mode), 0);
        core::write_file_atomically(folder / "a", "two");
        struct stat status {};
        ASSERT_EQ(::stat((folder / "a").c_str(), &status), 0);
        EXPECT_EQ(status.st_mode & 07777U, mode);
        EXPECT_EQ(core::read_file(folder / "a"), "two");
        fs::remove(folder / "a");
    }
}

TEST_F(AtomicFile, WritesIntoAPipeAndRefusesALinkToIt) {
    fs::path const pipe = folder / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    int const reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
    ASSERT_GE(reader, 0);
    core::write_file_atomically(pipe, "content");
    char bytes[16];
    EXPECT_EQ(::read(reader, bytes, sizeof bytes), 7);
    ::close(reader);
    EXPECT_TRUE(fs::is_fifo(pipe));
    fs::create_symlink(pipe, folder / "link");
    EXPECT_THROW(core::write_file_atomically(folder / "link", ""), core::MissingError);
    EXPECT_TRUE(fs::is_symlink(folder / "link"));
}

TEST_F(AtomicFile, OnlyRegularFilesOfBoundedSizeAreRead) {
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    EXPECT_THROW(core::read_file(folder / "pipe"), core::MissingError);
    EXPECT_THROW(core::read_file("/dev/zero"), core::MissingError);
    core::write_file_atomically(folder / "sparse", "");
    fs::resize_file(folder / "sparse", std::uintmax_t{10} << 30);  // needs no space on the disk
    EXPECT_THROW(core::read_file(folder / "sparse"), core::MissingError);
    EXPECT_THROW(core::read_given_file("/dev/zero"), core::MissingError);
    core::write_file_atomically(folder / "small", "12345");
    EXPECT_EQ(core::read_file(folder / "small", 5), "12345");
    EXPECT_THROW(core::read_file(folder / "small", 4), core::MissingError);
}

// What a killed process left is longer than the next file.
TEST_F(AtomicFile, WhatAKilledProcessLeftIsReplaced) {
    std::ofstream(folder / "a.part") << std::string(1000, 'x');
    core::write_file_atomically(folder / "a", "whole");
    EXPECT_EQ(core::read_file(folder / "a"), "whole");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
}

TEST_F(AtomicFile, TwoWritersOfAFileDoNotMixTheirBytes) {
    std::vector<std::jthread> writers;
    for (char const letter : {'a', 'b', 'c', 'd'}) {
        writers.emplace_back([this, letter] {
            for (int i = 0; i < 50; ++i) core::replace_file(folder / "a", std::string(20'000, letter));
        });
    }
    writers.clear();
    std::string const text = core::read_file(folder / "a");
    EXPECT_EQ(text, std::string(20'000, text.front()));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
}

TEST_F(AtomicFile, AFileThatIsNotFinishedLeavesNothing) {
    core::write_file_atomically(folder / "a", "old");
    {
        core::NewFile file(folder / "a");
        file.write("half");
        EXPECT_EQ(core::read_file(folder / "a"), "old");
    }
    EXPECT_EQ(core::read_file(folder / "a"), "old");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
}

}  // namespace
}  // namespace vibrotrough
