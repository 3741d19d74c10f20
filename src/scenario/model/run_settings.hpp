#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace vibrotrough::scenario {

/// Whether the text has no other characters than letters, digits, '.', '_' and '-'.
bool is_plain_text(std::string_view text);

/// A name that is safe in any command line and any file: 1 to 64 letters, digits, '.', '_' or '-', beginning
/// with a letter or a digit. Names that are passed to Slurm have this type, so that they cannot be anything
/// else.
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

/// What is requested from Slurm for every packing. Slurm's own defaults apply to members without a value.
struct SlurmSettings {
    std::optional<PlainName> partition;  ///< name of the partition
    std::optional<PlainName> account;    ///< account to which the time is charged
    std::optional<int> minutes;          ///< wall-clock time of a packing
    std::optional<std::int64_t> memory;  ///< MiB, of a packing
    std::optional<int>
        concurrent_tasks;  ///< largest number of packings of one array that run at the same time
};

/// How a campaign is run. This does not change what its cases are and is not part of their ids.
struct RunSettings {
    std::string executor = "local";  ///< a name in the table of executors
    int retries = 0;           ///< how often a packing is run again where the table of outcomes allows it
    std::optional<int> ranks;  ///< MPI ranks of each engine; otherwise chosen from the number of grains
    std::optional<double> time_limit;  ///< largest wall-clock time of a packing, s
    SlurmSettings slurm;               ///< only for the executor "slurm"
};

}  // namespace vibrotrough::scenario
