#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vibrotrough::scenario {

/// Whether the text has no other characters than letters, digits, '.', '_' and '-'.
bool is_plain_text(std::string_view text);

/// A name that is safe in any command line and any file: 1 to 64 letters, digits, '.', '_' or '-', beginning
/// with a letter or a digit. Names that are passed to a scheduler have this type, so that they cannot be
/// anything else.
class PlainName {
  public:
    /// The text as a name, or nullopt when it is not such a name.
    static std::optional<PlainName> from(std::string_view text);
    std::string const& str() const { return text_; }    ///< The name as a text.
    bool operator==(PlainName const&) const = default;  ///< Whether the texts are equal.

  private:
    explicit PlainName(std::string_view text) : text_(text) {}
    std::string text_;
};

/// An option of the command that submits a job, such as "--qos=short". Only options that ask for resources
/// are allowed, and only values without a space, quote or slash: a campaign file must not name files that a
/// scheduler writes, or variables that a task sees.
class BatchOption {
  public:
    std::string const& str() const { return text_; }      ///< The option as one word of the command line.
    bool operator==(BatchOption const&) const = default;  ///< Whether the texts are equal.

  private:
    friend struct SlurmOption;
    explicit BatchOption(std::string_view text) : text_(text) {}
    std::string text_;
};

/// Options of sbatch.
struct SlurmOption {
    /// The text as an option, or nullopt when it is not an allowed one.
    static std::optional<BatchOption> from(std::string_view text);
    /// The names that are allowed, for messages.
    static std::string names();
};

/// What is requested from a scheduler for every packing. Its own defaults apply to members without a value.
struct BatchSettings {
    std::optional<PlainName> partition;  ///< name of the partition or queue
    std::optional<PlainName> account;    ///< account to which the time is charged
    std::optional<int> minutes;          ///< wall-clock time of a packing
    std::optional<std::int64_t> memory;  ///< MiB, of a packing
    std::optional<int>
        concurrent_tasks;  ///< largest number of packings of one array that run at the same time
    std::optional<int> minutes_per_task;  ///< that a task should take; none: one packing per task
    std::optional<int> cores_per_task;    ///< that a task keeps busy; none: those of one engine
    std::vector<BatchOption> extra;       ///< further options of the command that submits
    std::vector<std::string>
        setup;  ///< lines of the shell that a task runs first; run only when the user allows it
};

/// How a campaign is run. This does not change what its cases are and is not part of their ids.
struct RunSettings {
    std::string executor = "local";  ///< a name in the table of executors
    int retries = 0;           ///< how often a packing is run again where the table of outcomes allows it
    std::optional<int> ranks;  ///< MPI ranks of each engine; otherwise chosen from the number of grains
    std::optional<double> time_limit;  ///< largest wall-clock time of a packing, s
    BatchSettings slurm;               ///< only for the executor "slurm"

    /// What is asked of the scheduler with this name; of one without keys: nothing.
    BatchSettings const& batch(std::string_view scheduler) const;
};

}  // namespace vibrotrough::scenario
