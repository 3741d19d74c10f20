#include "core/temporary_folder.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

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
    {
        // The folder itself is replaced by a link.
        TemporaryFolder const folder;
        fs::remove(folder.path());
        fs::create_directory_symlink(outside.path(), folder.path());
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

/// Another process, which makes a temporary folder in `parent` and waits for a signal.
class Owner {
  public:
    explicit Owner(fs::path const& parent, std::function<void(TemporaryFolder const&)> const& also = {}) {
        std::array<int, 2> ends{};
        if (::pipe2(ends.data(), O_CLOEXEC) != 0) std::abort();
        process_ = ::fork();
        if (process_ == 0) {
            for (int const number : {SIGINT, SIGTERM, SIGHUP}) std::signal(number, SIG_DFL);
            ::setenv("TMPDIR", parent.c_str(), 1);
            TemporaryFolder const folder("vibrotrough-test");
            std::ofstream(folder.path() / "file") << "text";
            if (also) also(folder);
            std::string const path = folder.path().string();
            if (::write(ends[1], path.data(), path.size()) < 0) std::abort();
            ::close(ends[1]);
            while (true) ::pause();
        }
        ::close(ends[1]);
        std::array<char, 4096> text{};
        ssize_t const length = ::read(ends[0], text.data(), text.size());
        ::close(ends[0]);
        folder_ = std::string(text.data(), static_cast<std::size_t>(std::max<ssize_t>(length, 0)));
    }
    ~Owner() {
        if (process_ > 0) end(SIGKILL);
    }
    Owner(Owner const&) = delete;
    Owner& operator=(Owner const&) = delete;

    /// The signal that ended it.
    int end(int number) {
        ::kill(process_, number);
        int status = 0;
        ::waitpid(std::exchange(process_, 0), &status, 0);
        return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    }
    fs::path const& folder() const { return folder_; }

  private:
    pid_t process_ = 0;
    fs::path folder_;
};

TEST(TemporaryFolder, IsRemovedByASignalThatEndsTheProcess) {
    TemporaryFolder const parent;
    for (int const number : {SIGINT, SIGTERM, SIGHUP}) {
        Owner owner(parent.path());
        ASSERT_TRUE(fs::exists(owner.folder() / "file"));
        EXPECT_EQ(owner.end(number), number);
        EXPECT_FALSE(fs::exists(owner.folder())) << number;
    }
}

TEST(LeftFolders, AreRemovedWhenTheirOwnerIsDead) {
    TemporaryFolder const parent;
    Owner dead(parent.path());
    Owner const living(parent.path());
    EXPECT_EQ(remove_left_folders(parent.path()), 0);
    dead.end(SIGKILL);
    EXPECT_TRUE(fs::exists(dead.folder()));
    EXPECT_EQ(remove_left_folders(parent.path()), 1);
    EXPECT_FALSE(fs::exists(dead.folder()));
    EXPECT_TRUE(fs::exists(living.folder() / "file"));
}

// The engine inherits the lock: a folder is in use until it has ended, too.
TEST(LeftFolders, StayWhileAChildOfTheirOwnerLives) {
    TemporaryFolder const parent;
    std::array<int, 2> ends{};
    ASSERT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0);
    Owner dead(parent.path(), [&](TemporaryFolder const& folder) {
        if (::fork() != 0) return;
        folder.keep_in_child();
        ::dup2(ends[0], STDIN_FILENO);
        ::execl("/bin/cat", "cat", nullptr);  // ends when the test closes the pipe
        ::_exit(127);
    });
    dead.end(SIGKILL);
    EXPECT_EQ(remove_left_folders(parent.path()), 0);
    ::close(ends[1]);
    int removed = 0;
    for (int attempt = 0; attempt < 1000 && removed == 0; ++attempt, ::usleep(10'000))
        removed = remove_left_folders(parent.path());
    EXPECT_EQ(removed, 1);
    ::close(ends[0]);
}

TEST(LeftFolders, StayWhileAProcessWorksInThem) {
    TemporaryFolder const parent;
    Owner dead(parent.path());
    dead.end(SIGKILL);
    fs::path const before = fs::current_path();
    fs::create_directory(dead.folder() / "below");
    fs::current_path(dead.folder() / "below");
    EXPECT_EQ(remove_left_folders(parent.path()), 0);
    fs::current_path(before);
    EXPECT_EQ(remove_left_folders(parent.path()), 1);
}

TEST(LeftFolders, OfOthersStay) {
    TemporaryFolder const parent, outside;
    Owner dead(parent.path());
    dead.end(SIGKILL);
    std::string const name = dead.folder().filename().string();
    std::ofstream(outside.path() / "kept") << "text";
    // Another machine or an earlier boot, an older version of the program, another program, a link.
    std::string other_boot = name;
    char& digit = other_boot.at(std::string("vibrotrough-test-").size());
    digit = digit == '0' ? '1' : '0';
    for (std::string const& kept : {other_boot, std::string("vibrotrough-engine-a1B2c3"), "other" + name})
        fs::create_directory(parent.path() / kept);
    fs::remove_all(dead.folder());
    fs::create_directory_symlink(outside.path(), dead.folder());
    EXPECT_EQ(remove_left_folders(parent.path()), 0);
    EXPECT_TRUE(fs::exists(outside.path() / "kept"));
    EXPECT_TRUE(fs::is_symlink(dead.folder()));
    EXPECT_TRUE(fs::exists(parent.path() / other_boot));
    fs::remove(dead.folder());
    fs::create_directory(dead.folder());
    if (::geteuid() == 0) {
        ASSERT_EQ(::chown(dead.folder().c_str(), 65534, 65534), 0);
        EXPECT_EQ(remove_left_folders(parent.path()), 0);
        ASSERT_EQ(::chown(dead.folder().c_str(), 0, 0), 0);
    }
    EXPECT_EQ(remove_left_folders(parent.path()), 1);
}

}  // namespace
}  // namespace vibrotrough::core
