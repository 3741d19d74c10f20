#include "core/atomic_file.hpp"

#include "core/error.hpp"
#include "core/temporary_folder.hpp"

#include <csignal>

#include <gtest/gtest.h>
#include <sys/resource.h>

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

}  // namespace
}  // namespace vibrotrough
