#include "engine/sole_writer.hpp"

#include "core/error.hpp"
#include "core/limits.hpp"
#include "core/time.hpp"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <string>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

namespace vibrotrough::engine {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr std::chrono::seconds patience = 10s;
constexpr std::chrono::milliseconds pause = 50ms;

core::Descriptor open_writer_file(fs::path const& folder, int flags) {
    return core::Descriptor(::open((folder / writer_file).c_str(), flags | O_RDWR | O_CLOEXEC, 0666));
}

bool try_lock(int descriptor) {
    return ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
}

/// The process group that the file names, if it was started on this machine.
std::optional<pid_t> group_in(int descriptor) {
    std::array<char, 400> text{};
    ssize_t const length = ::pread(descriptor, text.data(), text.size() - 1, 0);
    std::istringstream words(std::string(text.data(), static_cast<std::size_t>(length < 0 ? 0 : length)));
    std::string host;
    pid_t group = 0;
    if (!(words >> group >> host) || host != core::host_name() || group <= 1) return {};
    return group;
}

/// Whether a process of the group, besides this one, works in the folder. The number in the file may be that
/// of a group that has ended, and meanwhile belong to a stranger.
bool group_works_in(fs::path const& folder, pid_t group) {
    std::error_code ended;
    fs::path const place = fs::canonical(folder, ended);
    for (auto const& process : fs::directory_iterator("/proc", ended)) {
        pid_t const number = std::atoi(process.path().filename().c_str());
        std::error_code none;
        if (number > 0 && number != ::getpid() && ::getpgid(number) == group &&
            fs::read_symlink(process.path() / "cwd", none) == place)
            return true;
    }
    return false;
}

[[noreturn]] void refuse(fs::path const& folder) {
    throw core::MissingError(
        fmt::format("an engine that an earlier run started still writes in {}; wait until it has ended, or "
                    "end it ('fuser -v {}' shows its number)",
                    folder.string(), (folder / writer_file).string()));
}

/// Takes the lock. Whoever still holds it was started by an engine of this program. Its process group is
/// killed if one of its members works in the folder.
/// @return false with errno when it is still held after ten seconds, or the file system knows no locks
bool take(int descriptor, fs::path const& folder) {
    if (try_lock(descriptor)) return true;
    auto const group = group_in(descriptor);
    if (group && group_works_in(folder, *group)) ::kill(-*group, SIGKILL);
    auto const deadline = std::chrono::steady_clock::now() + patience;
    while (!try_lock(descriptor)) {
        if (errno != EWOULDBLOCK || std::chrono::steady_clock::now() > deadline) return false;
        std::this_thread::sleep_for(pause);
    }
    return true;
}

}  // namespace

void make_sole_writer(fs::path const& folder) {
    core::Descriptor const file = open_writer_file(folder, 0);
    if (file.is_open() && !take(file.number(), folder) && errno == EWOULDBLOCK) refuse(folder);
}

bool has_writer(fs::path const& folder) {
    core::Descriptor const file = open_writer_file(folder, 0);
    return file.is_open() && !try_lock(file.number()) && errno == EWOULDBLOCK;
}

WriterLock::WriterLock(fs::path const& folder) : file_(open_writer_file(folder, O_CREAT)) {
    if (!file_.is_open()) {
        throw core::MissingError(fmt::format("cannot write {} ({}); choose another folder",
                                             (folder / writer_file).string(), core::reason_of(errno)));
    }
    // A file system that knows no locks must not keep anybody from simulating.
    if (!take(file_.number(), folder) && errno == EWOULDBLOCK) refuse(folder);
}

void WriterLock::keep_in_child() const {
    ::fcntl(file_.number(), F_SETFD, 0);
}

void WriterLock::note_group(pid_t group) const {
    std::string const text = fmt::format("{} {}\n", group, core::host_name());
    if (::ftruncate(file_.number(), 0) != 0) return;
    [[maybe_unused]] ssize_t const written = ::pwrite(file_.number(), text.data(), text.size(), 0);
}

}  // namespace vibrotrough::engine
