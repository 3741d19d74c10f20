#pragma once

#include "core/own_folder.hpp"
#include "core/temporary_folder.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace vibrotrough::campaign {

/// The folder of this machine that a value of run.scratch names. A variable of the environment at its
/// beginning is replaced; where TMPDIR is not set, it means /tmp, as for any program.
/// @throws core::MissingError when there is no such variable or folder here
std::filesystem::path scratch_here(std::string const& scratch);

/// Where an engine works: in the folder of its packing, the home, or in a private folder of this machine, to
/// which the files of the home are copied and from which they are brought back. Each file comes back whole,
/// and the seal of a checkpoint after all that belongs to it, so that the home is at every moment that of a
/// run which was killed: when the machine dies, only what was not brought back is lost.
class RunPlace {
  public:
    /// @param home     must be there with the files that the engine needs
    /// @param scratch  the value of run.scratch; empty: the engine works in the home
    /// @throws core::MissingError when the private folder cannot be made or filled
    RunPlace(std::filesystem::path home, std::string const& scratch);

    /// In which the engine works.
    std::filesystem::path const& folder() const { return scratch_ ? scratch_->path() : home_; }

    /// Copies what has changed in the private folder back to the home, and removes there what a run removed
    /// here: older checkpoints and what it wrote after the one from which it went on. Does nothing when the
    /// engine works in the home.
    /// @throws core::MissingError when the disk refuses, or the private folder or files in it are gone, as
    /// after a purge; then nothing is changed in the home
    void bring_back();

  private:
    using Stamp = std::pair<std::uintmax_t, std::filesystem::file_time_type>;  ///< size and time of a change
    void take(std::filesystem::path const& name);

    std::filesystem::path home_;
    std::optional<core::TemporaryFolder> scratch_;
    std::optional<core::OwnFolder> own_;            ///< of the private folder: no link in it is followed
    std::map<std::filesystem::path, Stamp> known_;  ///< what the home has, by its name below the folder
    std::set<std::filesystem::path> needed_;  ///< what a run never removes: without it the folder was purged
};

}  // namespace vibrotrough::campaign
