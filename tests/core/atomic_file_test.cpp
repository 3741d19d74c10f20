#include "core/atomic_file.hpp"

#include "core/error.hpp"
#include "core/temporary_folder.hpp"

#include <csignal>
#include <fstream>
#include <string>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
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

// A user who may not give the new file to the old one's group must not hand it to a group of their own: only
// the rights of the owner and of everybody stay.
TEST_F(AtomicFile, ShutsOutTheGroupWhereTheOwnerCannotBeKept) {
    if (::geteuid() != 0) GTEST_SKIP() << "needs a file of somebody else";
    constexpr uid_t nobody = 65534;
    std::ofstream(folder / "a") << "old";
    ASSERT_EQ(::chmod((folder / "a").c_str(), 0664), 0);
    ASSERT_EQ(::chown(folder.c_str(), nobody, nobody), 0);
    ASSERT_EQ(::setegid(nobody), 0);
    ASSERT_EQ(::seteuid(nobody), 0);
    EXPECT_NO_THROW(core::write_file_atomically(folder / "a", "new"));
    ASSERT_EQ(::seteuid(0), 0);
    ASSERT_EQ(::setegid(0), 0);
    struct stat status {};
    ASSERT_EQ(::stat((folder / "a").c_str(), &status), 0);
    EXPECT_EQ(status.st_uid, nobody);
    EXPECT_EQ(status.st_mode & 0777U, 0604U);
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

// A temporary file belongs to whoever holds its lock. The number in its name may be that of a living process
// (this one), and the machine another.
TEST_F(AtomicFile, RemovesWhatAKilledProcessLeftOfAFile) {
    std::string const number = std::to_string(::getpid());
    for (std::string const& name :
         std::vector<std::string>{"a.part-elsewhere-1", "a.part-here-" + number, "b.part-elsewhere-1"})
        std::ofstream(folder / name) << "half";
    core::write_file_atomically(folder / "a", "whole");
    EXPECT_TRUE(fs::exists(folder / "a.part-elsewhere-1")) << "in a folder that is not ours, it is a user's";
    core::OwnFolder const own(folder);
    int const living = ::open((folder / "a.part-living-1").c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, 0600);
    ASSERT_EQ(::flock(living, LOCK_EX), 0);
    fs::create_symlink(folder / "b.part-elsewhere-1", folder / "a.part-link");
    core::replace_file(folder / "a", "whole");
    EXPECT_FALSE(fs::exists(folder / "a.part-elsewhere-1"));
    EXPECT_FALSE(fs::exists(folder / ("a.part-here-" + number)));
    EXPECT_TRUE(fs::exists(folder / "a.part-living-1")) << "somebody still writes it";
    EXPECT_TRUE(fs::is_symlink(folder / "a.part-link"));
    EXPECT_EQ(core::read_file(folder / "b.part-elsewhere-1"), "half") << "it is another file's";
    ::close(living);
    core::write_file_atomically(folder / "a", "whole");
    EXPECT_FALSE(fs::exists(folder / "a.part-living-1"));
    EXPECT_EQ(core::read_file(folder / "a"), "whole");
    core::remove_remains_of(folder / "b");
    EXPECT_FALSE(fs::exists(folder / "b.part-elsewhere-1")) << "without writing b, which is not there";
    EXPECT_FALSE(fs::exists(folder / "b"));
}

TEST_F(AtomicFile, LeavesRemainsOutsideOfAnOwnFolder) {
    std::ofstream(folder / "a.part-elsewhere-1") << "half";
    core::remove_remains_of(folder / "a");
    EXPECT_TRUE(fs::exists(folder / "a.part-elsewhere-1"));
}

}  // namespace
}  // namespace vibrotrough
