#include "campaign/state/file_lock.hpp"

#include "campaign_folder.hpp"
#include "core/error.hpp"

#include <atomic>
#include <thread>

#include <sys/wait.h>

namespace vibrotrough::campaign {
namespace {

class CampaignLock : public CampaignFolder {
  protected:
    CampaignLock() { std::filesystem::create_directories(folder); }
};

TEST_F(CampaignLock, SecondDriverIsRefused) {
    EXPECT_FALSE(has_driver(folder));
    {
        FileLock const lock = lock_campaign(folder);
        EXPECT_THROW(lock_campaign(folder), core::MissingError);
        EXPECT_TRUE(has_driver(folder)) << "the refused one must not free the first";
    }
    EXPECT_FALSE(has_driver(folder));
}

TEST_F(CampaignLock, IsHeldByAnotherProcessUntilItDies) {
    int to_parent[2];
    ASSERT_EQ(::pipe(to_parent), 0);
    pid_t const child = ::fork();
    if (child == 0) {
        FileLock const lock = lock_campaign(folder);
        [[maybe_unused]] auto const told = ::write(to_parent[1], "x", 1);
        ::pause();
    }
    char answer = 0;
    ASSERT_EQ(::read(to_parent[0], &answer, 1), 1);
    EXPECT_TRUE(has_driver(folder));
    EXPECT_THROW(lock_campaign(folder), core::MissingError);
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    EXPECT_FALSE(has_driver(folder));
    EXPECT_NO_THROW(lock_campaign(folder));
    ::close(to_parent[0]);
    ::close(to_parent[1]);
}

TEST_F(CampaignLock, LookingDoesNotDisturb) {
    std::atomic<bool> over = false;
    std::thread looking([&] {
        while (!over) has_driver(folder);
    });
    for (int i = 0; i < 5000; ++i)
        EXPECT_NO_THROW(lock_campaign(folder)) << "'vibrotrough status' kept a driver from starting";
    over = true;
    looking.join();
}

TEST_F(CampaignLock, FolderThatIsNotThere) {
    std::filesystem::remove_all(folder);
    EXPECT_FALSE(has_driver(folder));
    EXPECT_THROW(lock_campaign(folder), core::MissingError);
}

}  // namespace
}  // namespace vibrotrough::campaign
