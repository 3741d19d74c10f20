#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace vibrotrough::scenario {

/// A name that is safe in any command line and any file: 1 to 64 letters, digits, '.', '_' or '-', beginning
/// with a letter or a digit. Names that go to Slurm are of this type, so that none can be anything else.
class PlainName {
  public:
    /// Nothing when the text is no such name.
    static std::optional<PlainName> from(std::string_view text);
    std::string const& str() const { return text_; }
    bool operator==(PlainName const&) const = default;

  private:
    explicit PlainName(std::string_view text) : text_(text) {}
    std::string text_;
};

/// What is asked of Slurm for every packing. What is not set is left to Slurm's own defaults.
struct SlurmSettings {
    std::optional<PlainName> partition;
    std::optional<PlainName> account;
    std::optional<int> minutes;           ///< wall clock
    std::optional<std::int64_t> memory;   ///< MiB
    std::optional<int> concurrent_tasks;  ///< at most so many of one array at a time
};

/// How a campaign is run. No part of what its cases are: it does not enter their ids.
struct RunSettings {
    std::string executor = "local";    ///< who runs the packings: a name of the table of executors
    int retries = 0;                   ///< of a packing, after an end that may not come again
    std::optional<int> ranks;          ///< MPI ranks of every engine; else chosen from the number of grains
    std::optional<double> time_limit;  ///< s of wall clock for a packing
    SlurmSettings slurm;
};

}  // namespace vibrotrough::scenario
