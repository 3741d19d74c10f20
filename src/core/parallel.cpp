#include "core/parallel.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <sstream>
#include <system_error>
#include <thread>
#include <vector>

#include <sched.h>

namespace vibrotrough::core {
namespace {

namespace fs = std::filesystem;

/// So many files are asked for at the same time at least: one takes 20 ms on the file system of a busy
/// cluster. Work that waits for nothing takes no longer with more threads than cores.
constexpr std::size_t waiting_threads = 16;

std::string read_or_nothing(fs::path const& path) {
    try {
        return read_file(path, largest_note);
    } catch (MissingError const&) {
        return {};
    }
}

/// What one control group allows: the quota and the period, "max" where there is no limit.
std::optional<double> quota_of(fs::path const& group) {
    std::istringstream file(read_or_nothing(group / "cpu.max"));
    double quota = 0, period = 0;
    return file >> quota >> period && quota > 0 && period > 0 ? std::optional(quota / period) : std::nullopt;
}

int count_cores_of_mask() {
    cpu_set_t mask;
    CPU_ZERO(&mask);
    // A machine with more cores than the mask has bits (1024) refuses to fill it: then they all count.
    if (sched_getaffinity(0, sizeof mask, &mask) != 0)
        return static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    return std::max(1, CPU_COUNT(&mask));
}

}  // namespace

std::optional<double> find_core_quota(fs::path const& mounted, std::string const& groups) {
    auto const start = groups.find("0::/");
    if (start == std::string::npos) return {};
    std::optional<double> least;
    fs::path group = groups.substr(start + 4, groups.find('\n', start) - start - 4);
    // In a container the path may be the host's, and only the root is there.
    for (bool is_root = false; !is_root; group = group.parent_path()) {
        is_root = group.empty();
        if (auto const quota = quota_of(mounted / group)) least = std::min(least.value_or(*quota), *quota);
    }
    return least;
}

int count_available_cores() {
    static auto const quota = find_core_quota("/sys/fs/cgroup", read_or_nothing("/proc/self/cgroup"));
    int const cores = count_cores_of_mask();
    return quota && *quota < cores ? std::max(1, static_cast<int>(*quota)) : cores;
}

void for_each_index(std::size_t count, std::size_t least, std::function<IndexedWork()> const& make_work) {
    std::atomic<std::size_t> next = 0, first_failure = count;
    std::mutex mutex;
    std::exception_ptr failure;
    auto const attempt = [&](IndexedWork const& work, std::size_t i) {
        try {
            work(i);
        } catch (...) {
            std::lock_guard const lock(mutex);
            if (i >= first_failure) return;
            first_failure = i;
            failure = std::current_exception();
        }
    };
    auto const run = [&](IndexedWork const& work) {
        for (std::size_t i = next++; i < first_failure; i = next++) attempt(work, i);
    };
    std::size_t const most = std::max(static_cast<std::size_t>(count_available_cores()), waiting_threads);
    std::size_t const threads = std::min(most, count / std::max<std::size_t>(1, least));
    std::vector<std::jthread> others;
    try {
        while (others.size() + 1 < threads) others.emplace_back([&] { run(make_work()); });
    } catch (std::system_error const&) {
        // The user may have no more threads: fewer do the same work.
    }
    run(make_work());
    others.clear();  // waits for them
    if (failure) std::rethrow_exception(failure);
}

}  // namespace vibrotrough::core
