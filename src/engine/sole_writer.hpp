#pragma once

#include "core/open_file.hpp"

#include <filesystem>

#include <sys/types.h>

namespace vibrotrough::engine {

/// The file in a run's folder that says which engine writes there. The engine and all processes that it
/// starts hold a lock on it (flock), which the kernel releases when the last of them has ended.
constexpr char const* writer_file = ".engine";

/// Makes sure that no engine of an earlier run still writes in the folder. A driver that was killed may have
/// left one behind: its engine dies with it, but not what a wrapper script had started. Such processes are
/// killed when they belong to this machine and work in the folder, and waited for.
/// @throws MissingError when the lock is still held after ten seconds
void make_sole_writer(std::filesystem::path const& folder);

/// Whether an engine, or something that it started, holds the lock of the folder now.
bool has_writer(std::filesystem::path const& folder);

/// The lock of one run. The driver opens it, the engine inherits it, and the driver closes its own end.
class WriterLock {
  public:
    /// Takes the lock, after make_sole_writer(). @throws MissingError as make_sole_writer()
    explicit WriterLock(std::filesystem::path const& folder);

    /// To be called in the child before it becomes the engine, which then holds the lock.
    void keep_in_child() const;

    /// Notes the engine's process group, so that a later run can end it.
    void note_group(pid_t group) const;

  private:
    core::Descriptor file_;
};

}  // namespace vibrotrough::engine
