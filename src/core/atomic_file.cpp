#include "core/atomic_file.hpp"

#include "core/error.hpp"
#include "core/time.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace vibrotrough::core {
namespace {

namespace fs = std::filesystem;

/// An open file that closes itself.
class Descriptor {
  public:
    Descriptor(fs::path const& path, int flags) : number_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
    ~Descriptor() { close(); }
    Descriptor(Descriptor const&) = delete;
    Descriptor& operator=(Descriptor const&) = delete;

    bool is_open() const { return number_ >= 0; }
    int number() const { return number_; }
    bool sync() const { return ::fsync(number_) == 0; }
    bool write(std::string_view bytes) const {
        while (!bytes.empty()) {
            ssize_t const count = ::write(number_, bytes.data(), bytes.size());
            if (count < 0 && errno == EINTR) continue;
            if (count <= 0) return false;
            bytes.remove_prefix(static_cast<std::size_t>(count));
        }
        return true;
    }
    bool close() { return number_ < 0 || ::close(std::exchange(number_, -1)) == 0; }

  private:
    int number_;
};

void sync_to_disk(fs::path const& path, int flags) {
    Descriptor const file(path, flags);
    if (file.is_open() && file.sync()) return;
    throw MissingError(
        fmt::format("cannot sync {} ({}); check the disk", path.string(), std::strerror(errno)));
}

void sync_folder_of(fs::path const& path) {
    sync_to_disk(path.has_parent_path() ? path.parent_path() : fs::path("."), O_RDONLY | O_DIRECTORY);
}

/// `write` makes the temporary file and syncs it if that is wanted; this function only renames it.
void write_and_rename(fs::path const& path, std::function<void(fs::path const&)> const& write) {
    // The host name is needed because machines that share a file system may use the same process number.
    fs::path const temporary =
        path.string() + ".part-" + host_name().substr(0, 40) + "-" + std::to_string(::getpid());
    try {
        write(temporary);
        fs::rename(temporary, path);
    } catch (fs::filesystem_error const& error) {
        std::error_code ignored;
        fs::remove(temporary, ignored);
        throw MissingError(fmt::format("cannot write {} ({})", path.string(), error.code().message()));
    } catch (...) {
        std::error_code ignored;
        fs::remove(temporary, ignored);
        throw;
    }
}

void write_whole(fs::path const& path, fs::path const& temporary, std::string_view content, bool sync) {
    Descriptor file(temporary, O_WRONLY | O_CREAT | O_TRUNC);
    bool const written = file.is_open() && file.write(content) && (!sync || file.sync()) && file.close();
    if (!written) {
        throw MissingError(fmt::format("cannot write {} ({}); free disk space or choose another folder",
                                       path.string(), std::strerror(errno)));
    }
}

}  // namespace

std::string read_file(fs::path const& path) {
    Descriptor const file(path, O_RDONLY);
    struct stat status {};
    if (!file.is_open() || ::fstat(file.number(), &status) != 0 || S_ISDIR(status.st_mode))
        throw MissingError(fmt::format("cannot open {} (no such file, or not readable)", path.string()));
    // The reported size is only a hint: the file may grow meanwhile, and files in /proc report a size of 0.
    std::string content(std::max<std::size_t>(static_cast<std::size_t>(status.st_size) + 1, 4096), '\0');
    std::size_t length = 0;
    while (true) {
        ssize_t const count = ::read(file.number(), content.data() + length, content.size() - length);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0)
            throw MissingError(fmt::format("cannot read {} ({})", path.string(), std::strerror(errno)));
        if (count == 0) break;
        length += static_cast<std::size_t>(count);
        if (length == content.size()) content.resize(2 * length);
    }
    content.resize(length);
    return content;
}

TextFile read_text_file(fs::path const& path) {
    return {path, read_file(path)};
}

void make_folder(fs::path const& path) {
    std::error_code failure;
    fs::create_directories(path, failure);
    if (failure || !fs::is_directory(path)) {
        throw MissingError(
            fmt::format("cannot make the folder {} ({}); correct this or choose another folder",
                        path.string(), failure ? failure.message() : "there is a file of this name"));
    }
}

void write_atomically(fs::path const& path, std::function<void(fs::path const&)> const& write) {
    write_and_rename(path, [&](fs::path const& temporary) {
        write(temporary);
        sync_to_disk(temporary, O_RDONLY);
    });
    sync_folder_of(path);
}

void write_file_atomically(fs::path const& path, std::string_view content) {
    write_and_rename(path, [&](fs::path const& temporary) { write_whole(path, temporary, content, true); });
    sync_folder_of(path);
}

void replace_file(fs::path const& path, std::string_view content) {
    write_and_rename(path, [&](fs::path const& temporary) { write_whole(path, temporary, content, false); });
}

}  // namespace vibrotrough::core
