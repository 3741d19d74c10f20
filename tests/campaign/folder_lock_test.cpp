#include "campaign/state/folder_lock.hpp"

#include "campaign_folder.hpp"
#include "core/error.hpp"

#include <atomic>
#include <optional>
#include <thread>

#include <sys/wait.h>

namespace vibrotrough::campaign {
namespace {

class FolderLockTest : public CampaignFolder {
  protected:
    FolderLockTest() { std::filesystem::create_directories(folder); }
};

TEST_F(FolderLockTest, SecondDriverIsRefused) {
    FolderLock const lock(folder);
    try {
        FolderLock const second(folder);
        FAIL() << "the second lock was given";
    } catch (core::MissingError const& error) {
        std::string const message = error.what();
        EXPECT_NE(message.find("another vibrotrough is running the campaign in " + folder.string()),
                  std::string::npos)
            << message;
    }
    EXPECT_TRUE(FolderLock::is_held(folder)) << "the refused one must not free the first";
}

TEST_F(FolderLockTest, IsFreeAgainAfterItsEnd) {
    EXPECT_FALSE(FolderLock::is_held(folder));
    for (int i = 0; i < 3; ++i) {
        FolderLock const lock(folder);
        EXPECT_TRUE(FolderLock::is_held(folder));
    }
    EXPECT_FALSE(FolderLock::is_held(folder));
}

TEST_F(FolderLockTest, IsHeldByAnotherProcessUntilItDies) {
    int to_parent[2];
    ASSERT_EQ(::pipe(to_parent), 0);
    pid_t const child = ::fork();
    if (child == 0) {
        FolderLock const lock(folder);
        [[maybe_unused]] auto const told = ::write(to_parent[1], "x", 1);
        ::pause();
    }
    char answer = 0;
    ASSERT_EQ(::read(to_parent[0], &answer, 1), 1);
    EXPECT_TRUE(FolderLock::is_held(folder));
    EXPECT_THROW(FolderLock{folder}, core::MissingError);
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    EXPECT_FALSE(FolderLock::is_held(folder));
    EXPECT_NO_THROW(FolderLock{folder});
    ::close(to_parent[0]);
    ::close(to_parent[1]);
}

TEST_F(FolderLockTest, LookingDoesNotDisturb) {
    std::atomic<bool> over = false;
    std::thread looking([&] {
        while (!over) FolderLock::is_held(folder);
    });
    int refused = 0;
    for (int i = 0; i < 5000; ++i) {
        try {
            FolderLock const lock(folder);
        } catch (core::MissingError const&) {
            ++refused;
        }
    }
    over = true;
    looking.join();
    EXPECT_EQ(refused, 0) << "'vibrotrough status' kept a driver from starting";
}

TEST_F(FolderLockTest, FolderThatIsNotThere) {
    std::filesystem::remove_all(folder);
    EXPECT_FALSE(FolderLock::is_held(folder));
    EXPECT_THROW(FolderLock{folder}, core::MissingError);
}

}  // namespace
}  // namespace vibrotrough::campaign
