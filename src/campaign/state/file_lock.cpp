#include "campaign/state/file_lock.hpp"

#include "core/error.hpp"
#include "core/open_file.hpp"
#include "core/own_folder.hpp"

#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace vibrotrough::campaign {
namespace {

bool is_regular(int descriptor) {
    struct stat status {};
    return ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
}

int open_file(std::filesystem::path const& path) {
    // Close-on-exec: the engines must not inherit the lock and hold it after the driver.
    // O_NONBLOCK: what is in its place may be a pipe, which would wait for a reader.
    int const descriptor = core::ParentFolder(path).open(O_RDWR | O_CREAT | O_NONBLOCK);
    if (descriptor < 0) {
        throw core::MissingError(fmt::format("cannot write in {} ({}); choose another folder with --output",
                                             path.parent_path().string(), core::reason_of_errno()));
    }
    if (is_regular(descriptor)) return descriptor;
    ::close(descriptor);
    throw core::MissingError(fmt::format("{} is not a file; remove it", path.string()));
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

std::optional<FileLock> FileLock::take(std::filesystem::path const& path) {
    FileLock mine(open_file(path));
    struct flock lock = whole_file();
    if (::fcntl(mine.descriptor_, F_OFD_SETLK, &lock) == 0) return mine;
    if (errno == EAGAIN || errno == EACCES) return {};
    throw core::MissingError(fmt::format("cannot lock {} ({}); choose a file system that knows locks",
                                         path.string(), std::strerror(errno)));
}

FileLock FileLock::wait_for(std::filesystem::path const& path) {
    FileLock mine(open_file(path));
    struct flock lock = whole_file();
    while (::fcntl(mine.descriptor_, F_OFD_SETLKW, &lock) != 0) {
        if (errno == EINTR) continue;
        throw core::MissingError(fmt::format("cannot lock {} ({}); choose a file system that knows locks",
                                             path.string(), std::strerror(errno)));
    }
    return mine;
}

bool FileLock::is_held(std::filesystem::path const& path) {
    int const descriptor = core::open_to_read(path, core::Kinds::regular);
    if (descriptor < 0) return false;
    struct flock lock = whole_file();
    bool const held = ::fcntl(descriptor, F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
    ::close(descriptor);
    return held;
}

FileLock::~FileLock() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

FileLock::FileLock(FileLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

}  // namespace vibrotrough::campaign
