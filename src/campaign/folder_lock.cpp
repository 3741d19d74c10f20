#include "campaign/folder_lock.hpp"

#include "core/error.hpp"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace vibrotrough::campaign {
namespace {

int open_lock(std::filesystem::path const& folder) {
    // Close-on-exec: the engines must not inherit the lock and hold it after the driver.
    return ::open((folder / ".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
}

/// A write lock on the whole file, bound to the open file as flock() is, but one that can be asked for
/// without taking it: a look at the lock must not keep a driver from starting.
struct flock whole_file() {
    struct flock lock {};
    lock.l_type = F_WRLCK;
    lock.l_whence = SEEK_SET;
    return lock;
}

}  // namespace

FolderLock::FolderLock(std::filesystem::path const& folder) : descriptor_(open_lock(folder)) {
    if (descriptor_ < 0) {
        throw MissingError(fmt::format("cannot write in {} ({}); choose another folder with --output",
                                       folder.string(), std::strerror(errno)));
    }
    struct flock lock = whole_file();
    if (::fcntl(descriptor_, F_OFD_SETLK, &lock) != 0) {
        ::close(descriptor_);
        throw MissingError(
            fmt::format("another vibrotrough is running the campaign in {}; wait for it, or stop it with "
                        "Ctrl-C in its terminal",
                        folder.string()));
    }
}

FolderLock::~FolderLock() {
    ::close(descriptor_);
}

bool FolderLock::is_held(std::filesystem::path const& folder) {
    int const descriptor = ::open((folder / ".lock").c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) return false;
    struct flock lock = whole_file();
    bool const held = ::fcntl(descriptor, F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
    ::close(descriptor);
    return held;
}

}  // namespace vibrotrough::campaign
