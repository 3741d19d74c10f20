#include "core/parallel.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"

#include <algorithm>
#include <atomic>
#include <ctime>
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

std::string read_or_nothing(fs::path const& path) {
    try {
        return read_file(path, largest_note);
    } catch (MissingError const&) {
        return {};
    }
}

/// What one control group allows. Version 2 has both numbers in one file, "max" where there is no limit;
/// version 1 has two files, and -1 where there is no limit.
std::optional<double> quota_of(fs::path const& group) {
    std::istringstream both(read_or_nothing(group / "cpu.max"));
    std::istringstream first(read_or_nothing(group / "cpu.cfs_quota_us"));
    std::istringstream second(read_or_nothing(group / "cpu.cfs_period_us"));
    double quota = 0, period = 0;
    bool const is_read = (both >> quota >> period) || (first >> quota && second >> period);
    return is_read && quota > 0 && period > 0 ? std::optional(quota / period) : std::nullopt;
}

/// How long the first item took, and how much of that it waited.
class Stopwatch {
  public:
    /// One thread for each core. Where an item waits, for the file system, as many more as keep the cores at
    /// work: what a single thread asks of a file system that takes 20 ms for each answer, it waits for alone.
    std::size_t threads_for(std::size_t count, std::size_t least) const {
        constexpr double worth_a_thread = 2e-3;  // s; a thread costs some 1e-5
        constexpr double much = 4;               // times what it worked or wanted to
        constexpr std::size_t most = 64;
        double const elapsed = seconds(CLOCK_MONOTONIC) - start_;
        double const factor = elapsed / std::max(1e-6, busy_time() - busy_start_);
        auto const cores = static_cast<std::size_t>(count_available_cores());
        if (elapsed < worth_a_thread || factor < much)
            return std::min(cores, count / std::max<std::size_t>(1, least));
        return std::min({most, count, static_cast<std::size_t>(static_cast<double>(cores) * factor)});
    }

  private:
    static double seconds(clockid_t clock) {
        timespec time{};
        ::clock_gettime(clock, &time);
        return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    }

    /// s that this thread has worked, or would have if other programs had not had the core.
    static double busy_time() {
        std::istringstream words(read_or_nothing("/proc/thread-self/schedstat"));
        double worked = 0, waited_for_core = 0;  // ns; the first is late by some milliseconds
        if (!(words >> worked >> waited_for_core)) return seconds(CLOCK_MONOTONIC);  // nothing is known
        return seconds(CLOCK_THREAD_CPUTIME_ID) + 1e-9 * waited_for_core;
    }

    double start_ = seconds(CLOCK_MONOTONIC), busy_start_ = busy_time();
};

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
    std::optional<double> least;
    std::istringstream lines(groups);
    for (std::string line; std::getline(lines, line);) {  // number:controllers:path
        auto const first = line.find(':'), second = line.find(':', first + 1);
        if (second == std::string::npos) continue;
        std::string const controllers = "," + line.substr(first + 1, second - first - 1) + ",";
        bool const is_second_version = controllers == ",,";
        if (!is_second_version && controllers.find(",cpu,") == std::string::npos) continue;
        fs::path const root = is_second_version ? mounted : mounted / "cpu";
        // In a container the path may be the host's, and only the root is there.
        for (fs::path group = fs::path(line.substr(second + 1)).relative_path();;
             group = group.parent_path()) {
            if (auto const quota = quota_of(root / group)) least = std::min(least.value_or(*quota), *quota);
            if (group.empty()) break;
        }
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
    IndexedWork const own = make_work();
    Stopwatch const watch;
    if (count > 0) attempt(own, next++);
    std::size_t const threads = watch.threads_for(count, least);
    std::vector<std::jthread> others;
    try {
        while (others.size() + 1 < threads) others.emplace_back([&] { run(make_work()); });
    } catch (std::system_error const&) {
        // The user may have no more threads: fewer do the same work.
    }
    run(own);
    others.clear();  // waits for them
    if (failure) std::rethrow_exception(failure);
}

}  // namespace vibrotrough::core
