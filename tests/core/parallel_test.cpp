#include "core/parallel.hpp"

#include "core/temporary_folder.hpp"

#include <atomic>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sched.h>

namespace vibrotrough::core {
namespace {

// Each item is worked on once, whatever the number of items and of threads.
TEST(Parallel, EachItemOnce) {
    for (std::size_t const count : {0u, 1u, 7u, 10'000u}) {
        std::vector<std::atomic<int>> done(count);
        for_each_index(count, 1, [&] { return [&](std::size_t i) { ++done[i]; }; });
        for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(done[i], 1) << i << " of " << count;
    }
}

// A task of a cluster may use the cores that were given to it, not all of the node's.
TEST(Parallel, OnlyTheCoresOfTheAffinityMask) {
    cpu_set_t before, one;
    ASSERT_EQ(sched_getaffinity(0, sizeof before, &before), 0);
    EXPECT_EQ(count_available_cores(), CPU_COUNT(&before));
    CPU_ZERO(&one);
    for (int core = 0; CPU_COUNT(&one) == 0; ++core)
        if (CPU_ISSET(core, &before)) CPU_SET(core, &one);
    ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
    EXPECT_EQ(count_available_cores(), 1);
    ASSERT_EQ(sched_setaffinity(0, sizeof before, &before), 0);
}

// A container's --cpus, also where a group above has the lower limit. The
// path that a process is told may be the host's, of which the container sees the root only.
TEST(Parallel, QuotaOfProcessorTime) {
    TemporaryFolder const folder;
    auto const write = [&](std::string const& name, std::string const& content) {
        std::filesystem::create_directories((folder.path() / name).parent_path());
        std::ofstream(folder.path() / name) << content;
    };
    write("two/cpu.max", "max 100000\n");
    write("two/job/cpu.max", "250000 100000\n");
    write("two/job/step/cpu.max", "max 100000\n");
    EXPECT_EQ(find_core_quota(folder.path() / "two", "0::/\n"), std::nullopt);
    EXPECT_EQ(find_core_quota(folder.path() / "two", "0::/job\n"), 2.5);
    EXPECT_EQ(find_core_quota(folder.path() / "two", "0::/job/step\n"), 2.5);
    write("own/cpu.max", "150000 100000\n");
    EXPECT_EQ(find_core_quota(folder.path() / "own", "0::/system.slice/of-the-host\n"), 1.5);
    write("odd/cpu.max", "many few\n");
    EXPECT_EQ(find_core_quota(folder.path() / "odd", "0::/\nno line of this kind\n"), std::nullopt);
    EXPECT_EQ(find_core_quota(folder.path() / "nowhere", "0::/\n"), std::nullopt);
}

// Few items are not worth a thread: the state of the work is made once.
TEST(Parallel, FewItemsInOneThread) {
    std::atomic<int> made = 0;
    for_each_index(127, 64, [&] { return ++made, [](std::size_t) {}; });
    EXPECT_EQ(made, 1);
    for_each_index(6400, 64, [&] { return ++made, [](std::size_t) {}; });
    EXPECT_GE(made, 17);
}

// The error is that of the first item by number, in every run.
TEST(Parallel, TheFirstErrorCounts) {
    for (int run = 0; run < 100; ++run) {
        try {
            for_each_index(1000, 1, [] {
                return [](std::size_t i) {
                    if (i % 100 == 42) throw std::runtime_error(std::to_string(i));
                };
            });
            FAIL();
        } catch (std::runtime_error const& error) {
            ASSERT_STREQ(error.what(), "42");
        }
    }
}

}  // namespace
}  // namespace vibrotrough::core
