#include "core/parallel.hpp"

#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

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

// Few items are not worth a thread: the state of the work is made once.
TEST(Parallel, FewItemsInOneThread) {
    std::atomic<int> made = 0;
    for_each_index(63, 64, [&] { return ++made, [](std::size_t) {}; });
    EXPECT_EQ(made, 1);
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
