#include "core/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace vibrotrough::core {

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
    std::size_t const cores = std::max(1u, std::thread::hardware_concurrency());
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
