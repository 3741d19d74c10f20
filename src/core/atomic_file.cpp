#include "core/atomic_file.hpp"

#include "core/error.hpp"
#include "core/open_file.hpp"
#include "core/own_place.hpp"
#include "core/remains.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace vibrotrough::core {
namespace {

namespace fs = std::filesystem;

/// An open file that closes itself.
class Descriptor {
  public:
    explicit Descriptor(int number) : number_(number) {}
    ~Descriptor() { close(); }
    Descriptor(Descriptor const&) = delete;
    Descriptor& operator=(Descriptor const&) = delete;

    bool is_open() const { return number_ >= 0; }
    int number() const { return number_; }
    bool sync() const { return sync_to_disk(number_); }
    bool write(std::string_view bytes) const {
        while (!bytes.empty()) {
            ssize_t const count = ::write(number_, bytes.data(), bytes.size());
            if (count < 0 && errno == EINTR) continue;
            if (count == 0) errno = ENOSPC;
            if (count <= 0) return false;
            bytes.remove_prefix(static_cast<std::size_t>(count));
        }
        return true;
    }
    bool close() { return number_ < 0 || ::close(std::exchange(number_, -1)) == 0; }

    /// fsync(), which a signal may interrupt.
    static bool sync_to_disk(int number) {
        int result = 0;
        do {
            result = ::fsync(number);
        } while (result != 0 && errno == EINTR);
        return result == 0;
    }

  private:
    int number_;
};

enum class Sync { yes, no };

/// Opens a new file, which is locked until it is closed: see remains.hpp.
int open_new(int folder, std::string const& name) {
    constexpr int flags = O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC;
    for (int i = 0; i < 3; ++i) {
        int const opened = ::openat(folder, name.c_str(), flags, 0666);
        if (opened < 0 && errno != EEXIST) return -1;
        struct stat status {};
        if (opened >= 0) {
            ::flock(opened, LOCK_EX);
            if (::fstat(opened, &status) == 0 && status.st_nlink > 0) return opened;
            ::close(opened);  // another process took it for a remnant before it was locked
            continue;
        }
        // Of an earlier process of the same number, or planted: it is removed and not written into.
        ::unlinkat(folder, name.c_str(), 0);
    }
    errno = EEXIST;
    return -1;
}

/// Gives a file the mode and the owner of the one that it is about to replace, so that a private file stays
/// private. An owner that this user may not give away remains another, and then the mode lets nobody else in
/// who could not read the file before.
void take_owner_and_mode(Descriptor const& file, ParentFolder const& parent) {
    struct stat before {};
    if (::fstatat(parent.descriptor(), parent.name(), &before, AT_SYMLINK_NOFOLLOW) != 0 ||
        !S_ISREG(before.st_mode))
        return;
    struct stat now {};
    if (::fstat(file.number(), &now) != 0) return;
    mode_t mode = before.st_mode & 0777U;
    bool const has_other_owner = before.st_uid != now.st_uid || before.st_gid != now.st_gid;
    if (has_other_owner && ::fchown(file.number(), before.st_uid, before.st_gid) != 0) mode &= ~070U;
    ::fchmod(file.number(), mode);
}

bool write_whole(ParentFolder const& parent, std::string const& name, std::string_view content, Sync sync) {
    Descriptor file(open_new(parent.descriptor(), name));
    if (!file.is_open()) return false;
    take_owner_and_mode(file, parent);
    return file.write(content) && (sync == Sync::no || file.sync()) && file.close();
}

[[noreturn]] void refuse_to_write(fs::path const& path, std::string const& reason, char const* cure) {
    throw MissingError(fmt::format("cannot write {} ({}); {}", path.string(), reason, cure));
}

/// Writes into a pipe or a device, which must not be replaced by a file. A pipe waits for its reader.
/// @return whether `path` is one
bool write_into_special_file(fs::path const& path, std::string_view content) {
    struct stat status {};
    if (::lstat(path.c_str(), &status) != 0) return false;
    if (S_ISLNK(status.st_mode)) {
        std::error_code ignored;
        // /dev/stdout is such a link, wherever the stream leads.
        bool const is_stream = fs::read_symlink(path, ignored).native().starts_with("/proc/");
        bool const leads_to_file = ::stat(path.c_str(), &status) != 0 || S_ISREG(status.st_mode);
        if (!is_stream && (leads_to_file || S_ISDIR(status.st_mode))) return false;
        refuse_to_write(path, "it is a link to a device, a pipe or an open file", "name what it leads to");
    }
    if (S_ISREG(status.st_mode) || S_ISDIR(status.st_mode)) return false;
    if (S_ISSOCK(status.st_mode) || S_ISBLK(status.st_mode))
        refuse_to_write(path, "it is a socket or a disk", "choose another name");
    Descriptor const file(::open(path.c_str(), O_WRONLY | O_NOFOLLOW | O_NOCTTY | O_CLOEXEC));
    if (!file.is_open() || !file.write(content))
        refuse_to_write(path, reason_of_errno(), "choose another name");
    return true;
}

void write_and_rename(fs::path const& path, std::string_view content, Sync sync) {
    bool const is_own = lies_in_own_folder(path);
    if (!is_own && write_into_special_file(path, content)) return;
    ParentFolder const parent(path);
    std::string const temporary = temporary_name(path.filename().string());
    int const folder = parent.descriptor();
    if (parent.is_open() && is_own) remove_remains(parent);
    bool const written = parent.is_open() && write_whole(parent, temporary, content, sync) &&
                         ::renameat(folder, temporary.c_str(), folder, parent.name()) == 0;
    if (written) {
        if (sync == Sync::no || Descriptor::sync_to_disk(folder)) return;
        throw MissingError(
            fmt::format("cannot sync {} ({}); check the disk", path.string(), reason_of_errno()));
    }
    int const error = errno;
    std::string const reason = reason_of_errno();
    if (parent.is_open()) ::unlinkat(folder, temporary.c_str(), 0);
    if (error == ENOSPC || error == EDQUOT || error == EFBIG)
        throw DiskFullError(fmt::format("cannot write {} ({}); free disk space or choose another folder",
                                        path.string(), reason));
    refuse_to_write(path, reason, "correct this or choose another folder");
}

[[noreturn]] void refuse_to_read(fs::path const& path, std::string const& reason) {
    throw MissingError(fmt::format("cannot read {} ({})", path.string(), reason));
}

[[noreturn]] void refuse_kind(fs::path const& path) {
    refuse_to_read(path, "it is a pipe, a socket or a device, and not a file");
}

/// Reads what the file had when it was opened: to the end without another question after it. Where the size
/// is 0 it is only a hint, as for pipes and files in /proc.
void read_to_end(Descriptor const& file, fs::path const& path, std::size_t size, std::size_t limit,
                 std::string& content) {
    std::size_t length = 0;
    while (true) {
        ssize_t const count = ::read(file.number(), content.data() + length, content.size() - length);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) refuse_to_read(path, reason_of_errno());
        if (count == 0) break;
        length += static_cast<std::size_t>(count);
        if (length > limit) refuse_to_read(path, fmt::format("it is larger than {} MB", limit >> 20));
        if (length == size) break;
        if (length == content.size()) content.resize(2 * length);
    }
    content.resize(length);
}

/// Reads a file that was opened, and closes it.
void read_descriptor(int opened, fs::path const& path, Kinds kinds, std::size_t limit, std::string& content) {
    Descriptor const file(opened);
    if (!file.is_open() && errno == ESPIPE) refuse_kind(path);
    struct stat status {};
    if (!file.is_open() || ::fstat(file.number(), &status) != 0 || S_ISDIR(status.st_mode)) {
        std::string const reason = file.is_open() || errno == ENOENT || errno == EACCES
                                       ? "no such file, or not readable"
                                       : reason_of_errno();
        throw MissingError(fmt::format("cannot open {} ({})", path.string(), reason));
    }
    if (kinds == Kinds::regular && !S_ISREG(status.st_mode)) refuse_kind(path);
    auto const size = static_cast<std::size_t>(status.st_size);
    if (size > limit) refuse_to_read(path, fmt::format("it is larger than {} MB", limit >> 20));
    content.resize(size > 0 ? size : std::max(content.capacity(), std::size_t{4096}));
    read_to_end(file, path, size, limit, content);
}

std::string read_opened(fs::path const& path, Kinds kinds, std::size_t limit) {
    std::string content;
    read_descriptor(open_to_read(path, kinds), path, kinds, limit, content);
    return content;
}

}  // namespace

std::string read_own_file(fs::path const& path, std::size_t limit) {
    ParentFolder const parent(path);
    int const opened = parent.open(O_RDONLY | O_NONBLOCK);
    if (opened < 0 && (errno == ELOOP || errno == EXDEV || errno == ENOTDIR))
        refuse_to_read(path, "it is a symbolic link, or there is one on the way");
    std::string content;
    read_descriptor(opened, path, Kinds::regular, limit, content);
    return content;
}

std::string read_file(fs::path const& path, std::size_t limit) {
    return read_opened(path, Kinds::regular, limit);
}

void read_file_into(fs::path const& path, std::string& content, std::size_t limit) {
    read_descriptor(open_to_read(path, Kinds::regular), path, Kinds::regular, limit, content);
}

std::string read_given_file(fs::path const& path, std::size_t limit) {
    return read_opened(path, Kinds::given, limit);
}

TextFile read_text_file(fs::path const& path) {
    return {path, read_file(path)};
}

void write_file_atomically(fs::path const& path, std::string_view content) {
    write_and_rename(path, content, Sync::yes);
}

void replace_file(fs::path const& path, std::string_view content) {
    write_and_rename(path, content, Sync::no);
}

void remove_remains_of(fs::path const& path) {
    if (!lies_in_own_folder(path)) return;
    ParentFolder const parent(path);
    if (parent.is_open()) remove_remains(parent);
}

}  // namespace vibrotrough::core
