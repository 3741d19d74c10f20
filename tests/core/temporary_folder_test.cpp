#include "core/temporary_folder.hpp"

#include "core/error.hpp"

#include <cstdlib>
#include <fstream>
#include <optional>
#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace vibrotrough::core {
namespace {

namespace fs = std::filesystem;

TEST(TemporaryFolder, IsPrivateAndHasAUniqueName) {
    TemporaryFolder const one("some-purpose"), other("some-purpose");
    EXPECT_NE(one.path(), other.path());
    EXPECT_TRUE(one.path().filename().string().starts_with("some-purpose-"));
    EXPECT_TRUE(fs::is_directory(one.path()));
    EXPECT_EQ(fs::status(one.path()).permissions(), fs::perms::owner_all);
}

TEST(TemporaryFolder, IsRemovedWithItsContent) {
    fs::path path;
    {
        TemporaryFolder const folder;
        path = folder.path();
        fs::create_directories(path / "a" / "b");
        std::ofstream(path / "a" / "b" / "file") << "text";
        EXPECT_TRUE(fs::exists(path / "a" / "b" / "file"));
    }
    EXPECT_FALSE(fs::exists(path));
}

TEST(TemporaryFolder, RemovesNothingThroughALink) {
    TemporaryFolder const outside;
    std::ofstream(outside.path() / "kept") << "text";
    {
        TemporaryFolder const folder;
        fs::create_directory_symlink(outside.path(), folder.path() / "link");
        fs::create_symlink(outside.path() / "kept", folder.path() / "link_to_file");
    }
    EXPECT_TRUE(fs::exists(outside.path() / "kept"));
}

TEST(TemporaryFolder, MayHaveBeenRemovedBefore) {
    std::optional<TemporaryFolder> folder(std::in_place);
    fs::remove(folder->path());
    EXPECT_NO_THROW(folder.reset());
}

TEST(TemporaryFolder, FailsWhereNoFolderCanBeMade) {
    TemporaryFolder const folder;
    char const* const before = std::getenv("TMPDIR");
    std::string const kept = before == nullptr ? "" : before;
    ::setenv("TMPDIR", (folder.path() / "none").c_str(), 1);
    EXPECT_THROW(TemporaryFolder{}, MissingError);
    ::setenv("TMPDIR", folder.path().c_str(), 1);
    EXPECT_EQ(TemporaryFolder().path().parent_path(), folder.path());
    EXPECT_THROW(TemporaryFolder("no/such"), MissingError);
    before == nullptr ? ::unsetenv("TMPDIR") : ::setenv("TMPDIR", kept.c_str(), 1);
}

}  // namespace
}  // namespace vibrotrough::core
