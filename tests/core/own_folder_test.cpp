#include "core/own_folder.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/temporary_folder.hpp"

#include <functional>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

namespace vibrotrough {
namespace {

namespace fs = std::filesystem;

/// A campaign's folder, and beside it a folder of somebody else with one letter in it.
class OwnFolder : public testing::Test {
  protected:
    OwnFolder() {
        fs::create_directories(folder / "cases");
        fs::create_directory(precious);
        core::write_file_atomically(precious / "letter", "dear");
    }

    void expect_untouched() const {
        EXPECT_EQ(core::read_file(precious / "letter"), "dear");
        EXPECT_EQ(std::distance(fs::directory_iterator(precious), {}), 1);
    }

    core::TemporaryFolder const temporary;
    fs::path folder = temporary.path() / "campaign";
    fs::path precious = temporary.path() / "precious";
};

TEST_F(OwnFolder, NothingIsWrittenThroughALinkedFolder) {
    core::OwnFolder const own(folder);
    fs::create_directory_symlink(precious, folder / "cases" / "a");
    EXPECT_THROW(core::write_file_atomically(folder / "cases" / "a" / "x", "y"), core::MissingError);
    EXPECT_THROW(core::replace_file(folder / "cases" / "a" / "letter", "y"), core::MissingError);
    EXPECT_THROW(core::make_folder(folder / "cases" / "a" / "b"), core::MissingError);
    EXPECT_THROW(core::make_folder(folder / "cases" / "a"), core::MissingError);
    EXPECT_THROW(core::remove_file(folder / "cases" / "a" / "letter"), core::MissingError);
    EXPECT_THROW(core::remove_tree(folder / "cases" / "a" / "letter"), core::MissingError);
    core::remove_if_empty(folder / "cases" / "a");
    EXPECT_THROW(core::rename_entry(folder / "cases" / "a" / "letter", folder / "x"), core::MissingError);
    EXPECT_THROW(core::link_or_copy(folder / "cases" / "a" / "letter", folder / "x"), core::MissingError);
    expect_untouched();
}

TEST_F(OwnFolder, ALinkIsReplacedOrRemovedAndNotFollowed) {
    core::OwnFolder const own(folder);
    for (char const* name : {"a", "b", "c"}) fs::create_symlink(precious / "letter", folder / name);
    fs::create_directory_symlink(precious, folder / "d");
    core::write_file_atomically(folder / "a", "mine");
    core::link_or_copy(folder / "a", folder / "b");
    core::remove_file(folder / "c");
    core::remove_tree(folder / "d");
    EXPECT_EQ(core::read_file(folder / "a"), "mine");
    EXPECT_EQ(core::read_file(folder / "b"), "mine");
    EXPECT_FALSE(fs::exists(fs::symlink_status(folder / "c")));
    EXPECT_FALSE(fs::exists(fs::symlink_status(folder / "d")));
    expect_untouched();
}

// No link leads from one file system to another: the content is copied instead.
TEST_F(OwnFolder, WhatCannotBeLinkedIsCopied) {
    struct stat here {
    }, there{};
    fs::path const memory = "/dev/shm";
    ASSERT_EQ(::stat(folder.c_str(), &here), 0);
    if (::stat(memory.c_str(), &there) != 0 || ::access(memory.c_str(), W_OK) != 0 ||
        here.st_dev == there.st_dev)
        GTEST_SKIP() << "needs a second file system";
    fs::path const source = memory / temporary.path().filename();
    core::write_file_atomically(source, "far");
    core::link_or_copy(source, folder / "copy");
    fs::remove(source);
    EXPECT_EQ(core::read_file(folder / "copy"), "far");
}

TEST_F(OwnFolder, ATreeIsRemovedWithItsLinksAndWithoutTheirTargets) {
    core::OwnFolder const own(folder);
    core::make_folder(folder / "cases" / "a" / "b" / "c");
    core::write_file_atomically(folder / "cases" / "a" / "b" / "x", "y");
    fs::create_directory_symlink(precious, folder / "cases" / "a" / "b" / "d");
    core::remove_if_empty(folder / "cases");
    EXPECT_TRUE(fs::exists(folder / "cases"));
    core::remove_tree(folder / "cases");
    EXPECT_FALSE(fs::exists(folder / "cases"));
    core::remove_tree(folder / "cases");
    core::remove_file(folder / "cases" / "none");
    expect_untouched();
}

TEST_F(OwnFolder, ATemporaryFileThatIsThereAlreadyIsNotWrittenInto) {
    // The name is host and process number, which anybody can guess.
    char host[300] = {};
    ASSERT_EQ(::gethostname(host, sizeof host - 1), 0);
    std::string const name =
        std::string("a.part-") + std::string(host).substr(0, 40) + "-" + std::to_string(::getpid());
    fs::create_symlink(precious / "letter", folder / name);
    core::write_file_atomically(folder / "a", "mine");
    EXPECT_EQ(core::read_file(folder / "a"), "mine");
    expect_untouched();
}

TEST_F(OwnFolder, TheWayToTheFolderIsTheUsersOwnChoice) {
    fs::create_directory_symlink(folder, temporary.path() / "link");
    core::OwnFolder const own(temporary.path() / "link");
    core::write_file_atomically(temporary.path() / "link" / "cases" / "x", "mine");
    EXPECT_EQ(core::read_file(folder / "cases" / "x"), "mine");
}

TEST_F(OwnFolder, AFolderThatWasRemovedIsNotMadeAgain) {
    core::OwnFolder const own(folder);
    fs::remove_all(folder);
    EXPECT_THROW(core::make_folder(folder / "cases" / "a"), core::MissingError);
    EXPECT_THROW(core::write_file_atomically(folder / "x", "y"), core::MissingError);
    EXPECT_FALSE(fs::exists(folder));
}

TEST_F(OwnFolder, IsFoundUnderItsRelativeAndItsAbsolutePath) {
    fs::path const before = fs::current_path();
    fs::current_path(folder);
    fs::create_directory_symlink(precious, folder / "cases" / "a");
    {
        core::OwnFolder const own(".");
        EXPECT_THROW(core::write_file_atomically("cases/a/x", "y"), core::MissingError);
        EXPECT_THROW(core::write_file_atomically("./cases/a/x", "y"), core::MissingError);
        EXPECT_THROW(core::write_file_atomically(folder / "cases" / "." / "a" / "x", "y"),
                     core::MissingError);
        core::write_file_atomically("x", "mine");
    }
    {
        core::OwnFolder const own("cases");
        EXPECT_THROW(core::write_file_atomically("cases/a/x", "y"), core::MissingError);
    }
    fs::current_path(before);
    EXPECT_EQ(core::read_file(folder / "x"), "mine");
    expect_untouched();
}

TEST_F(OwnFolder, FilesOfAnotherProgramAreCheckedBeforeItWritesThem) {
    core::OwnFolder const own(folder);
    core::check_own_file(folder / "none");
    fs::create_symlink(precious / "letter", folder / "link");
    EXPECT_THROW(core::check_own_file(folder / "link"), core::MissingError);
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    EXPECT_THROW(core::check_own_file(folder / "pipe"), core::MissingError);
    // A second name of the same file: what is written afterwards does not change the other.
    fs::create_hard_link(precious / "letter", folder / "second");
    core::check_own_file(folder / "second");
    EXPECT_EQ(core::read_file(folder / "second"), "dear");
    EXPECT_EQ(fs::hard_link_count(precious / "letter"), 1);
}

/// Both ways to open below a folder refuse the same and open the same.
TEST_F(OwnFolder, WorksWithAndWithoutTheKernelsHelp) {
    fs::create_directory_symlink(precious, folder / "cases" / "a");
    fs::create_symlink(precious / "letter", folder / "link");
    core::write_file_atomically(folder / "cases" / "x", "mine");
    int const root = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY);
    using Open = std::function<int(int, fs::path const&, int)>;
    for (Open const& open : {Open(core::open_beneath), Open(core::open_beneath_stepwise)}) {
        for (char const* outside :
             {"cases/a/letter", "link", "../precious/letter", "cases/../../precious/letter", "/etc/passwd"})
            EXPECT_LT(open(root, outside, O_RDONLY), 0) << outside;
        for (char const* inside : {"cases/x", "./cases/x", "cases", "."}) {
            int const opened = open(root, inside, O_RDONLY);
            EXPECT_GE(opened, 0) << inside;
            ::close(opened);
        }
        int const made = open(root, "cases/y", O_WRONLY | O_CREAT | O_EXCL);
        EXPECT_GE(made, 0);
        ::close(made);
        ASSERT_EQ(::unlinkat(root, "cases/y", 0), 0);
    }
    ::close(root);
}

TEST_F(OwnFolder, OnlyRegularFilesOfBoundedSizeAreRead) {
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

}  // namespace
}  // namespace vibrotrough
