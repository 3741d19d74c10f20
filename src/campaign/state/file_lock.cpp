#include "campaign/state/file_lock.hpp"

#include "core/error.hpp"
#include "core/limits.hpp"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>

namespace vibrotrough::campaign {
namespace {

core::Descriptor open_file(std::filesystem::path const& path) {
    // Close-on-exec: the engines must not inherit the lock and hold it after the driver.
    core::Descriptor file(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
    if (file.is_open()) return file;
    throw core::MissingError(fmt::format("cannot write in {} ({}); choose another folder with --output",
                                         path.parent_path().string(), core::reason_of(errno)));
}

/// A write lock on the whole file, bound to the open file as flock() is, but one that can be asked for
/// without taking it: a look at the lock must not keep a driver from starting.
struct flock whole_file() {
    struct flock lock {};
    lock.l_type = F_WRLCK;
    lock.l_whence = SEEK_SET;
    return lock;
}

[[noreturn]] void refuse(std::filesystem::path const& path) {
    throw core::MissingError(fmt::format("cannot lock {} ({}); choose a file system that knows locks",
                                         path.string(), std::strerror(errno)));
}

}  // namespace

std::optional<FileLock> FileLock::take(std::filesystem::path const& path) {
    FileLock mine(open_file(path));
    struct flock lock = whole_file();
    if (::fcntl(mine.file_.number(), F_OFD_SETLK, &lock) == 0) return mine;
    if (errno == EAGAIN || errno == EACCES) return {};
    refuse(path);
}

FileLock FileLock::wait_for(std::filesystem::path const& path) {
    FileLock mine(open_file(path));
    struct flock lock = whole_file();
    while (::fcntl(mine.file_.number(), F_OFD_SETLKW, &lock) != 0)
        if (errno != EINTR) refuse(path);
    return mine;
}

bool FileLock::is_held(std::filesystem::path const& path) {
    core::Descriptor const file = core::open_to_read(path, core::Kinds::regular);
    struct flock lock = whole_file();
    return file.is_open() && ::fcntl(file.number(), F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
}

FileLock lock_campaign(std::filesystem::path const& folder) {
    if (auto lock = FileLock::take(folder / ".lock")) return std::move(*lock);
    throw core::MissingError(
        fmt::format("another vibrotrough is running the campaign in {}; wait for it, or stop it with "
                    "Ctrl-C in its terminal",
                    folder.string()));
}

bool has_driver(std::filesystem::path const& folder) {
    return FileLock::is_held(folder / ".lock");
}

}  // namespace vibrotrough::campaign
