#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace vibrotrough::core {

/// The cores that this process may use: those of its CPU affinity mask, which a cluster's task, a container
/// or taskset may have made smaller than the machine, and no more than its quota of processor time allows
/// (rounded down, because a thread that is held up makes the others wait); at least 1.
/// std::thread::hardware_concurrency() counts the machine's.
int count_available_cores();

/// The quota of processor time of a control group and of those above it, in cores: that of a container
/// (--cpus), of systemd (CPUQuota) or of a cluster's task. None where nothing limits it, or nothing can be
/// read. Of version 2 of the kernel's control groups.
/// @param mounted  where control groups are mounted, usually /sys/fs/cgroup
/// @param groups   the process's own, as /proc/self/cgroup lists them
std::optional<double> find_core_quota(std::filesystem::path const& mounted, std::string const& groups);

/// What is done with item i.
using IndexedWork = std::function<void(std::size_t i)>;

/// Does work with items 0 ... count - 1 on all cores that this process may use, each item once and in any
/// order. The items must not depend on one another. There are at least 16 threads, as far as the items are
/// worth them, because most items wait for files.
/// @param least      items that are worth a thread of their own
/// @param make_work  is called once in each thread, so that each has its own state; it must not throw
/// @throws what the work on an item throws: of the first item by number, whichever thread was faster
void for_each_index(std::size_t count, std::size_t least, std::function<IndexedWork()> const& make_work);

}  // namespace vibrotrough::core
