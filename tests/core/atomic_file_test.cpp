#include "core/atomic_file.hpp"

#include "core/error.hpp"
#include "core/temporary_folder.hpp"

#include <gtest/gtest.h>

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

TEST_F(AtomicFile, KeepsTheOldFileWhenTheWriterThrows) {
    core::write_file_atomically(folder / "a", "old");
    auto const half = [](fs::path const& temporary) {
        core::write_file_atomically(temporary, "half");
        throw std::runtime_error("power cut");
    };
    EXPECT_THROW(core::write_atomically(folder / "a", half), std::runtime_error);
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
