#include "core/temporary_folder.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <mutex>
#include <set>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace vibrotrough::core {
namespace {

namespace fs = std::filesystem;

constexpr int attempts_to_lock = 3;

/// What is removed when a signal ends the process that made it, and not when it ends a child of it.
struct Registered {
    std::atomic<char const*> path = nullptr;
    std::atomic<pid_t> owner = 0;
};

/// A handler may neither allocate nor lock.
std::array<Registered, 64> folders_of_process;

void remove_with_child(char const* path) {
    pid_t const child = ::vfork();
    if (child == 0) {
        ::execl("/bin/rm", "rm", "-rf", "--", path, nullptr);
        ::_exit(127);
    }
    int status = 0;
    while (child > 0 && ::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
}

/// Then the signal does what it would have done: it is blocked until its handler has returned.
void remove_folders(int number) {
    int const kept = errno;
    for (auto const& folder : folders_of_process) {
        char const* const path = folder.path.load();
        if (path != nullptr && folder.owner.load() == ::getpid()) remove_with_child(path);
    }
    std::signal(number, SIG_DFL);
    ::raise(number);
    errno = kept;
}

/// Leaves alone what the program handles itself, and what was ignored when it started (nohup).
void handle_signals() {
    for (int const number : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction action {};
        if (::sigaction(number, nullptr, &action) != 0 || action.sa_handler != SIG_DFL) continue;
        action = {};
        action.sa_handler = &remove_folders;
        ::sigaction(number, &action, nullptr);
    }
}

void remember(char const* path) {
    for (auto& folder : folders_of_process) {
        char const* none = nullptr;
        if (!folder.path.compare_exchange_strong(none, path)) continue;
        folder.owner = ::getpid();
        return;
    }
}

void forget(char const* path) {
    for (auto& folder : folders_of_process) {
        char const* own = path;
        if (folder.path.compare_exchange_strong(own, nullptr)) return;
    }
}

/// Twelve digits of the number that the kernel chose when it started, which all containers of a machine
/// share; empty when it is not known.
std::string boot_id() {
    std::ifstream file("/proc/sys/kernel/random/boot_id");
    std::string id;
    file >> id;
    std::erase(id, '-');
    bool const is_known =
        id.size() == 32 && std::ranges::all_of(id, [](unsigned char c) { return std::isxdigit(c) != 0; });
    return is_known ? id.substr(0, 12) : "";
}

bool is_named(fs::path const& path, int descriptor) {
    struct stat held {
    }, named{};
    return ::fstat(descriptor, &held) == 0 && ::lstat(path.c_str(), &named) == 0 &&
           held.st_ino == named.st_ino && held.st_dev == named.st_dev;
}

int open_folder(fs::path const& path) {
    return ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
}

/// Waits while another process looks whether the folder was left.
bool take_lock(int descriptor) {
    int result = 0;
    do result = ::flock(descriptor, LOCK_EX);
    while (result != 0 && errno == EINTR);
    return result == 0;
}

/// Processes that this user may look into which work below the folder, or name it in their environment: MPI's
/// ranks close the lock that they inherit.
std::vector<int> users_of(fs::path const& path) {
    std::vector<int> found;
    std::error_code failure;
    for (auto const& process : fs::directory_iterator("/proc", failure)) {
        std::string const name = process.path().filename().string();
        int number = 0;
        if (std::from_chars(name.data(), name.data() + name.size(), number).ec != std::errc()) continue;
        std::error_code ended;
        std::string const place = fs::read_symlink(process.path() / "cwd", ended).string() + "/";
        std::ifstream file(process.path() / "environ");
        std::string const environment{std::istreambuf_iterator<char>(file), {}};
        bool const works_there = !ended && place.starts_with(path.string() + "/");
        if (works_there || environment.find(path.string()) != std::string::npos) found.push_back(number);
    }
    return found;
}

/// A folder of this user whose lock is free has no owner. Its owner takes the lock right after making it, and
/// makes another one if it has been removed in between.
bool is_left(fs::path const& path, int descriptor) {
    struct stat status {};
    return ::fstat(descriptor, &status) == 0 && status.st_uid == ::geteuid() &&
           ::flock(descriptor, LOCK_EX | LOCK_NB) == 0 && is_named(path, descriptor) &&
           users_of(path).empty();
}

fs::path parent_of_folders() {
    std::error_code failure;
    fs::path parent = fs::temp_directory_path(failure);
    if (failure) {
        throw MissingError(
            fmt::format("there is no folder for temporary files ({}); set TMPDIR to a folder that exists",
                        failure.message()));
    }
    return parent;
}

void remove_left_folders_once(fs::path const& parent) {
    static std::mutex mutex;
    static std::set<fs::path> seen;
    std::lock_guard const lock(mutex);
    if (seen.insert(parent).second) remove_left_folders(parent);
}

fs::path make_folder_in(fs::path const& parent, std::string_view purpose, std::string const& boot,
                        char const* cure) {
    std::string name =
        (parent / fmt::format("{}-{}{}XXXXXX", purpose, boot, boot.empty() ? "" : "-")).string();
    if (::mkdtemp(name.data()) == nullptr) {
        throw MissingError(fmt::format("cannot make a temporary folder in {} ({}){}", parent.string(),
                                       std::strerror(errno), cure));
    }
    // The owner may use it, whatever the umask says.
    ::chmod(name.c_str(), 0700);
    return name;
}

}  // namespace

TemporaryFolder::TemporaryFolder(std::string_view purpose, fs::path parent) {
    char const* const cure = parent.empty() ? "; set TMPDIR to another folder" : "";
    if (parent.empty()) parent = parent_of_folders();
    remove_left_folders_once(parent);
    handle_signals();
    std::string boot = boot_id();
    for (int attempt = 1;; ++attempt) {
        // Where there are no locks, the name must not promise one.
        if (attempt > attempts_to_lock) boot.clear();
        path_ = make_folder_in(parent, purpose, boot, cure);
        if (boot.empty()) break;
        lock_ = open_folder(path_);
        if (lock_ >= 0 && take_lock(lock_) && is_named(path_, lock_)) break;
        if (lock_ >= 0) ::close(std::exchange(lock_, -1));
        std::error_code ignored;
        fs::remove(path_, ignored);
    }
    remember(path_.c_str());
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
    forget(path_.c_str());
    if (lock_ >= 0) ::close(lock_);
}

bool TemporaryFolder::keep_as(fs::path const& name) {
    if (::rename(path_.c_str(), name.c_str()) != 0) return false;
    forget(path_.c_str());
    path_.clear();
    return true;
}

void TemporaryFolder::keep_in_child() const {
    if (lock_ >= 0) ::fcntl(lock_, F_SETFD, 0);
}

std::vector<int> TemporaryFolder::users() const {
    std::vector<int> found = users_of(path_);
    std::erase(found, ::getpid());
    return found;
}

int remove_left_folders(fs::path const& parent) {
    std::string const boot = boot_id();
    if (boot.empty()) return 0;
    constexpr std::size_t random_letters = 6;
    std::string const middle = fmt::format("-{}-", boot);
    int removed = 0;
    std::error_code failure;
    for (auto const& entry : fs::directory_iterator(parent, failure)) {
        std::string const name = entry.path().filename().string();
        bool const is_ours = name.starts_with("vibrotrough-") &&
                             name.size() >= middle.size() + random_letters &&
                             name.find(middle) == name.size() - middle.size() - random_letters;
        int const descriptor = is_ours ? open_folder(entry.path()) : -1;
        if (descriptor < 0) continue;
        std::error_code ignored;
        if (is_left(entry.path(), descriptor) && fs::remove_all(entry.path(), ignored) > 0) ++removed;
        ::close(descriptor);
    }
    return removed;
}

}  // namespace vibrotrough::core
