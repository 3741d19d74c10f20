#pragma once

#include "campaign/execute/executor.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vibrotrough::campaign {

/// What one task of a cluster simulates: packings, in this order.
using Task = std::vector<PackingId>;

/// Reads one line of a task list: "<case id> <packing>" once or several times.
/// @throws core::InputError when there is no such line, or when it is damaged
Task read_task(std::filesystem::path const& task_list, int index);

/// Reads a whole list; nothing when a line is damaged.
/// @throws core::MissingError when the file cannot be read
std::optional<std::vector<Task>> read_task_list(std::filesystem::path const& task_list);

/// The text of a list, a line per task, which read_task() reads.
std::string write_task_list(std::vector<Task> const& tasks);

/// How many packings a task takes.
struct TaskSize {
    std::optional<double> duration;  ///< s, that a task should take; none: one packing per task
    double speed;                    ///< grain-steps per second of one core, expected
    int ranks;                       ///< MPI ranks of each engine
    int engines = 1;                 ///< that the task runs at the same time
};

/// Seconds that a packing will probably take.
double expected_time(PackingOrder const& order, TaskSize const& size);

/// Puts packings into tasks, in their order: a task takes further packings as long as it is expected to end
/// within the duration asked for, and at most most_packings_per_task of them. A task takes at least one
/// packing for each engine that it runs at the same time, as far as there are any.
std::vector<Task> make_tasks(std::vector<PackingOrder> const& orders, TaskSize const& size);

/// A task is not larger than this, however short its packings are.
constexpr std::size_t most_packings_per_task = 1000;

}  // namespace vibrotrough::campaign
