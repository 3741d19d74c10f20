#include "engine/sole_writer.hpp"

#include "core/error.hpp"
#include "core/limits.hpp"
#include "core/time.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/file.h>
#include <sys/stat.h>
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
    std::istringstream words(
        std::string(text.data(), static_cast<std::size_t>(std::max<ssize_t>(length, 0))));
    std::string host;
    pid_t group = 0;
    if (!(words >> group >> host) || host != core::host_name() || group <= 1) return {};
    return group;
}

/// Whether a process has a file of the folder open for writing: the link in /proc has the mode of the
/// descriptor.
bool writes_below(fs::path const& process, std::string const& folder) {
    std::error_code ended;
    for (auto const& entry : fs::directory_iterator(process / "fd", ended)) {
        struct stat status {};
        fs::path const target = fs::read_symlink(entry.path(), ended);
        if (!ended && target.string().starts_with(folder + "/") &&
            ::lstat(entry.path().c_str(), &status) == 0 && (status.st_mode & S_IWUSR) != 0)
            return true;
    }
    return false;
}

/// Processes of this machine, besides this one, that work in the folder.
std::vector<int> processes_in(fs::path const& folder) {
    std::vector<int> found;
    std::error_code ended;
    std::string const place = fs::canonical(folder, ended).string();
    if (ended) return found;
    for (auto const& process : fs::directory_iterator("/proc", ended)) {
        std::string const name = process.path().filename().string();
        int number = 0;
        auto const [end, failure] = std::from_chars(name.data(), name.data() + name.size(), number);
        if (failure != std::errc() || end != name.data() + name.size() || number == ::getpid()) continue;
        std::error_code none;
        if (fs::read_symlink(process.path() / "cwd", none) == place) found.push_back(number);
    }
    return found;
}

/// Those of them that write there. MPI's ranks close the lock that they inherit, and end some seconds after
/// the program that had started them.
std::vector<int> writers_in(fs::path const& folder) {
    std::vector<int> found = processes_in(folder);
    std::error_code ended;
    std::string const place = fs::canonical(folder, ended).string();
    std::erase_if(found, [&](int number) {
        return ended || !writes_below(fs::path("/proc") / std::to_string(number), place);
    });
    return found;
}

/// Whether a process of the group works in the folder. The number in the file may be that of a group that
/// has ended, and meanwhile belong to a stranger.
bool group_works_in(fs::path const& folder, pid_t group) {
    return std::ranges::any_of(processes_in(folder), [&](int number) { return ::getpgid(number) == group; });
}

[[noreturn]] void refuse(fs::path const& folder) {
    std::vector<int> const writers = writers_in(folder);
    throw core::MissingError(fmt::format(
        "an engine that an earlier run started still writes in {}{}; wait until it has ended, or end it",
        folder.string(), writers.empty() ? "" : fmt::format(" (process {})", fmt::join(writers, ", "))));
}

/// Asks until the answer is yes. @return false when it did not become yes in time
template <typename Question>
bool wait_until(Question const& question) {
    auto const deadline = std::chrono::steady_clock::now() + patience;
    while (!question()) {
        if (std::chrono::steady_clock::now() > deadline) return false;
        std::this_thread::sleep_for(pause);
    }
    return true;
}

/// Takes the lock. Whoever still holds it was started by an engine of this program. Its process group is
/// killed if one of its members works in the folder.
bool take(int descriptor, fs::path const& folder) {
    if (try_lock(descriptor)) return true;
    auto const group = group_in(descriptor);
    if (group && group_works_in(folder, *group)) ::kill(-*group, SIGKILL);
    return wait_until([&] { return try_lock(descriptor); });
}

}  // namespace

void make_sole_writer(fs::path const& folder) {
    core::Descriptor file = open_writer_file(folder, 0);
    if (!file.is_open()) return;  // nobody has written here yet
    bool const taken = take(file.number(), folder);
    file.close();
    if (!taken || !wait_until([&] { return writers_in(folder).empty(); })) refuse(folder);
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
    if (take(file_.number(), folder) || (errno != EWOULDBLOCK && errno != EINTR)) return;
    refuse(folder);
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
