#include "core/parallel.hpp"

#include <sched.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace vibrotrough::core {

int count_available_cores() {
    cpu_set_t mask;
    CPU_ZERO(&mask);
    // A machine with more cores than the mask has bits (1024) refuses to fill it: then they all count.
    if (sched_getaffinity(0, sizeof mask, &mask) != 0)
        return static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    return std::max(1, CPU_COUNT(&mask));
}

void for_each_index(std::size_t count, std::size_t least, std::function<IndexedWork()> const& make_work) {
    std::atomic<std::size_t> next = 0, first_failure = count;
    std::mutex mutex;
    std::exception_ptr failure;
    auto const run = [&] {
        IndexedWork const work = make_work();
        for (std::size_t i = next++; i < first_failure; i = next++) {
            try {
                work(i);
            } catch (...) {
                std::lock_guard const lock(mutex);
                if (i >= first_failure) continue;
                first_failure = i;
                failure = std::current_exception();
            }
        }
    };
    auto const cores = static_cast<std::size_t>(count_available_cores());
    std::vector<std::jthread> others;
    try {
        while (others.size() + 1 < std::min(cores, count / std::max<std::size_t>(1, least)))
            others.emplace_back(run);
    } catch (std::system_error const&) {
        // The user may have no more threads: fewer do the same work.
    }
    run();
    others.clear();  // waits for them
    if (failure) std::rethrow_exception(failure);
}

}  // namespace vibrotrough::core
