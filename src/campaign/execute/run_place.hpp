#pragma once

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

/// Brings back what RunPlace has kept on this machine, unless the home has gone on without it, and removes it
/// from the scratch folder. Nobody else may work for the home.
/// @param home, scratch, name  as for RunPlace
/// @return whether there was something to bring back
/// @throws core::MissingError when the disk still refuses; then all of it stays
bool bring_back_kept(std::filesystem::path const& home, std::string const& scratch,
                     std::filesystem::path const& name);

/// Where an engine works: in the folder of its packing, the home, or in a private folder of this machine, to
/// which the files of the run are copied and from which they are brought back. Each file comes back whole,
/// and the seal of a checkpoint after all that belongs to it, so that the home is at every moment that of a
/// run which was killed: when the machine dies, only what was not brought back is lost.
///
/// When the home takes no more, the private folder stays, and the next run on this machine brings it back.
class RunPlace {
  public:
    /// @param home     must be there with the files that the engine needs; of other files, which are a
    ///                 person's, only those are copied that the decks in it name
    /// @param scratch  the value of run.scratch; empty: the engine works in the home
    /// @param name     under which a later run looks for what was kept; that of the home, if it has the same
    /// @throws core::MissingError when the private folder cannot be made or filled
    RunPlace(std::filesystem::path home, std::string const& scratch, std::filesystem::path name);
    ~RunPlace();
    RunPlace(RunPlace const&) = delete;
    RunPlace& operator=(RunPlace const&) = delete;

    /// In which the engine works.
    std::filesystem::path const& folder() const { return scratch_ ? scratch_->path() : home_; }

    /// Copies what has changed in the private folder back to the home, and removes there what a run removed
    /// here: older checkpoints, and frames after the one from which it went on. Does nothing when the
    /// engine works in the home.
    /// @throws core::MissingError when the home's disk refuses, a DiskFullError when it is full: all of it is
    /// brought back by the next call, or kept when there is none; the message says where
    /// @throws core::MissingError when the private folder or files in it are gone, as after a purge; then
    /// nothing is changed in the home
    void bring_back();

  private:
    using Stamp = std::pair<std::uintmax_t, std::filesystem::file_time_type>;  ///< size and time of a change
    void take(std::filesystem::path const& name);

    std::filesystem::path home_;
    std::filesystem::path kept_;  ///< the private folder's name when it is kept
    bool is_behind_ = false;      ///< the home is not what the last call should have made of it
    std::optional<core::TemporaryFolder> scratch_;
    std::map<std::filesystem::path, Stamp> known_;  ///< what the home has, by its name below the folder
    std::set<std::filesystem::path> needed_;  ///< what a run never removes: without it the folder was purged
};

}  // namespace vibrotrough::campaign
