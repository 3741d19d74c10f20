#pragma once

#include <cstddef>
#include <functional>

namespace vibrotrough::core {

/// The cores that this process may use: those of its CPU affinity mask, which a cluster's task, a container or taskset may
/// have made smaller than the machine; at least 1. std::thread::hardware_concurrency() counts the machine's.
int count_available_cores();

/// What is done with item i.
using IndexedWork = std::function<void(std::size_t i)>;

/// Does work with items 0 ... count - 1 on all cores that this process may use, each item once and in any order. The
/// items must not depend on one another.
/// @param least      items that are worth a thread of their own
/// @param make_work  is called once in each thread, so that each has its own state; it must not throw
/// @throws what the work on an item throws: of the first item by number, whichever thread was faster
void for_each_index(std::size_t count, std::size_t least, std::function<IndexedWork()> const& make_work);

}  // namespace vibrotrough::core
