#include "core/atomic_file.hpp"

#include "core/error.hpp"
#include "core/time.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace vibrotrough {
namespace {

namespace fs = std::filesystem;

void sync_to_disk(fs::path const& path, int flags) {
    int const descriptor = ::open(path.c_str(), flags);
    bool const failed = descriptor < 0 || ::fsync(descriptor) != 0;
    int const reason = errno;
    if (descriptor >= 0) ::close(descriptor);
    if (failed) {
        throw MissingError(
            fmt::format("cannot sync {} ({}); check the disk", path.string(), std::strerror(reason)));
    }
}

void write_and_rename(fs::path const& path, std::function<void(fs::path const&)> const& write, bool sync) {
    // Machines that share a file system may have processes with the same number.
    fs::path const temporary =
        path.string() + ".part-" + host_name().substr(0, 40) + "-" + std::to_string(::getpid());
    try {
        write(temporary);
        if (sync) sync_to_disk(temporary, O_RDONLY);
        fs::rename(temporary, path);
        if (sync)
            sync_to_disk(path.has_parent_path() ? path.parent_path() : fs::path("."), O_RDONLY | O_DIRECTORY);
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

void write_whole(fs::path const& path, fs::path const& temporary, std::string_view content) {
    std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
    file.write(content.data(), static_cast<std::streamsize>(content.size()));
    file.close();
    if (!file) {
        throw MissingError(fmt::format("cannot write {} ({}); free disk space or choose another folder",
                                       path.string(), std::strerror(errno)));
    }
}

}  // namespace

std::string read_file(fs::path const& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file || fs::is_directory(path)) {
        throw MissingError(fmt::format("cannot open {} (no such file, or not readable)", path.string()));
    }
    std::string content;
    std::array<char, 1 << 16> block;
    while (file.read(block.data(), block.size()), file.gcount() > 0)
        content.append(block.data(), static_cast<std::size_t>(file.gcount()));
    if (file.bad())
        throw MissingError(fmt::format("cannot read {} ({})", path.string(), std::strerror(errno)));
    return content;
}

TextFile read_text_file(fs::path const& path) {
    return {path, read_file(path)};
}

void make_folder(fs::path const& path) {
    std::error_code failure;
    fs::create_directories(path, failure);
    if (failure || !fs::is_directory(path)) {
        throw MissingError(fmt::format("cannot make the folder {} ({}); choose another place or free it",
                                       path.string(), failure ? failure.message() : "a file is in the way"));
    }
}

void write_atomically(fs::path const& path, std::function<void(fs::path const&)> const& write) {
    write_and_rename(path, write, true);
}

void write_file_atomically(fs::path const& path, std::string_view content) {
    write_atomically(path, [&](fs::path const& temporary) { write_whole(path, temporary, content); });
}

void replace_file(fs::path const& path, std::string_view content) {
    write_and_rename(
        path, [&](fs::path const& temporary) { write_whole(path, temporary, content); }, false);
}

}  // namespace vibrotrough
