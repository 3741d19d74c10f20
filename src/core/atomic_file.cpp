#include "core/atomic_file.hpp"

#include "core/error.hpp"
#include "core/limits.hpp"

#include <algorithm>
#include <cerrno>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace vibrotrough::core {
namespace {

namespace fs = std::filesystem;

/// @return false with errno on failure
bool write_all(int file, std::string_view bytes) {
    while (!bytes.empty()) {
        ssize_t const count = ::write(file, bytes.data(), bytes.size());
        if (count < 0 && errno == EINTR) continue;
        if (count == 0) errno = ENOSPC;
        if (count <= 0) return false;
        bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return true;
}

/// fsync(), which a signal may interrupt. @return false with errno on failure
bool sync_to_disk(int file) {
    int result = 0;
    do {
        result = ::fsync(file);
    } while (result != 0 && errno == EINTR);
    return result == 0;
}

/// Waits while another process holds the lock of the file. Where there are no locks, nothing is waited for.
void lock(int file) {
    while (::flock(file, LOCK_EX) != 0 && errno == EINTR) {
    }
}

bool has_name(int file, fs::path const& path) {
    struct stat held {
    }, named{};
    return ::fstat(file, &held) == 0 && ::stat(path.c_str(), &named) == 0 && held.st_ino == named.st_ino &&
           held.st_dev == named.st_dev;
}

fs::path folder_of(fs::path const& path) {
    return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

[[noreturn]] void refuse_to_write(fs::path const& path, std::string const& reason, char const* cure) {
    throw MissingError(fmt::format("cannot write {} ({}); {}", path.string(), reason, cure));
}

/// Whether there is a pipe or a device of characters, which must not be replaced by a file but can be written
/// into. What can be neither replaced nor written into is refused.
bool is_stream(fs::path const& path) {
    struct stat status {};
    if (::lstat(path.c_str(), &status) != 0) return false;
    if (S_ISLNK(status.st_mode)) {
        std::error_code ignored;
        // /dev/stdout is such a link, wherever the stream leads.
        bool const is_link_to_stream = fs::read_symlink(path, ignored).native().starts_with("/proc/");
        bool const leads_to_file = ::stat(path.c_str(), &status) != 0 || S_ISREG(status.st_mode);
        if (!is_link_to_stream && (leads_to_file || S_ISDIR(status.st_mode))) return false;
        refuse_to_write(path, "it is a link to a device, a pipe or an open file", "name what it leads to");
    }
    if (S_ISSOCK(status.st_mode) || S_ISBLK(status.st_mode))
        refuse_to_write(path, "it is a socket or a disk", "choose another name");
    return !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode);
}

/// A pipe waits for its reader.
void write_into_stream(fs::path const& path, std::string_view content) {
    Descriptor const file(::open(path.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC));
    if (!file.is_open() || !write_all(file.number(), content))
        refuse_to_write(path, reason_of(errno), "choose another name");
}

void write_and_rename(fs::path const& path, std::string_view content, Sync sync) {
    if (is_stream(path)) return write_into_stream(path, content);
    NewFile file(path);
    file.write(content);
    file.finish(sync);
}

[[noreturn]] void refuse_to_read(fs::path const& path, std::string const& reason) {
    throw MissingError(fmt::format("cannot read {} ({})", path.string(), reason));
}

/// The bytes of a file up to its end. Its size is only a hint, as for pipes and files in /proc.
std::string read_to_end(Descriptor const& file, fs::path const& path, std::size_t size, std::size_t limit) {
    std::string content(std::max(size + 1, std::size_t{4096}), '\0');
    std::size_t length = 0;
    while (true) {
        ssize_t const count = ::read(file.number(), content.data() + length, content.size() - length);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) refuse_to_read(path, reason_of(errno));
        if (count == 0) break;
        length += static_cast<std::size_t>(count);
        if (length > limit) refuse_to_read(path, fmt::format("it is larger than {} MB", limit >> 20));
        if (length == content.size()) content.resize(2 * length);
    }
    content.resize(length);
    return content;
}

std::string read_opened(fs::path const& path, Kinds kinds, std::size_t limit) {
    Descriptor const file = open_to_read(path, kinds);
    if (!file.is_open() && errno == ESPIPE)
        refuse_to_read(path, "it is a pipe, a socket or a device, and not a file");
    struct stat status {};
    if (!file.is_open() || ::fstat(file.number(), &status) != 0 || S_ISDIR(status.st_mode)) {
        std::string const reason = file.is_open() || errno == ENOENT || errno == EACCES
                                       ? "no such file, or not readable"
                                       : reason_of(errno);
        throw MissingError(fmt::format("cannot open {} ({})", path.string(), reason));
    }
    auto const size = static_cast<std::size_t>(status.st_size);
    if (size > limit) refuse_to_read(path, fmt::format("it is larger than {} MB", limit >> 20));
    return read_to_end(file, path, size, limit);
}

}  // namespace

NewFile::NewFile(fs::path path) : path_(std::move(path)), temporary_(path_) {
    if (is_stream(path_))
        refuse_to_write(path_, "it is a device or a pipe, and not a file", "choose another name");
    temporary_ += ".part";
    do {
        file_ = Descriptor(::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666));
        if (!file_.is_open()) refuse();
        lock(file_.number());
    } while (!has_name(file_.number(), temporary_));  // until then another process has renamed it
    if (::ftruncate(file_.number(), 0) != 0) refuse();
    struct stat before {};
    if (::stat(path_.c_str(), &before) == 0 && S_ISREG(before.st_mode))
        ::fchmod(file_.number(), before.st_mode & 0777U);
}

NewFile::~NewFile() {
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void NewFile::write(std::string_view bytes) const {
    if (!write_all(file_.number(), bytes)) refuse();
}

void NewFile::finish(Sync sync) {
    // Closed last: with the lock, another process could begin to write the file that is renamed.
    bool const is_renamed = (sync == Sync::no || sync_to_disk(file_.number())) &&
                            ::rename(temporary_.c_str(), path_.c_str()) == 0 && file_.close();
    if (!is_renamed) refuse();
    temporary_.clear();
    if (sync == Sync::no) return;
    Descriptor const folder(::open(folder_of(path_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (folder.is_open() && sync_to_disk(folder.number())) return;
    throw MissingError(fmt::format("cannot sync {} ({}); check the disk", path_.string(), reason_of(errno)));
}

void NewFile::refuse() const {
    int const error = errno;
    if (error == ENOSPC || error == EDQUOT || error == EFBIG)
        throw DiskFullError(fmt::format("cannot write {} ({}); free disk space or choose another folder",
                                        path_.string(), reason_of(error)));
    refuse_to_write(path_, reason_of(error), "correct this or choose another folder");
}

std::string read_file(fs::path const& path, std::size_t limit) {
    return read_opened(path, Kinds::regular, limit);
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

void make_folder(fs::path const& path) {
    std::error_code failure;
    fs::create_directories(path, failure);
    if (!failure && fs::is_directory(path, failure)) return;
    throw MissingError(fmt::format("cannot make the folder {} ({}); correct this or choose another folder",
                                   path.string(),
                                   failure ? failure.message() : "there is a file of this name"));
}

}  // namespace vibrotrough::core
