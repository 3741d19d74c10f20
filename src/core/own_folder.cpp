#include "core/own_folder.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/limits.hpp"
#include "core/own_place.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <mutex>
#include <optional>
#include <shared_mutex>
#include <utility>
#include <vector>

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <linux/openat2.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace vibrotrough::core {

namespace fs = std::filesystem;

struct OwnFolder::Root {
    Root(int open_folder, std::vector<std::string> paths)
        : descriptor(open_folder), names(std::move(paths)) {}
    ~Root() { ::close(descriptor); }
    Root(Root const&) = delete;
    Root& operator=(Root const&) = delete;

    int descriptor;
    std::vector<std::string> names;  ///< paths that lead to it, without a slash at the end
};

namespace {

constexpr int folder_flags = O_RDONLY | O_DIRECTORY | O_CLOEXEC;

/// The own folders of this process. Few, and rarely changed.
struct Registry {
    std::shared_mutex mutex;
    std::vector<std::shared_ptr<OwnFolder::Root>> roots;
};

Registry& registry() {
    static Registry instance;
    return instance;
}

std::string without_final_slash(fs::path const& path) {
    std::string text = path.lexically_normal().string();
    while (text.size() > 1 && text.back() == '/') text.pop_back();
    return text;
}

/// A path below an own folder.
struct Place {
    std::shared_ptr<OwnFolder::Root> root;
    fs::path relative;  ///< "." for the folder itself
};

/// What is left of `path` below `name`; none when it is not below.
std::optional<fs::path> remainder(std::string const& path, std::string const& name) {
    if (!path.starts_with(name)) return {};
    if (path.size() == name.size()) return fs::path(".");
    if (path[name.size()] != '/') return {};
    return fs::path(path.substr(name.size() + 1));
}

/// The innermost own folder that holds the path; none when there is none.
std::optional<Place> find_place(fs::path const& path) {
    std::shared_lock const lock(registry().mutex);
    auto const& roots = registry().roots;
    if (roots.empty()) return {};
    std::string const text = without_final_slash(path);
    std::optional<Place> best;
    for (auto const& root : roots) {
        for (std::string const& name : root->names) {
            auto rest = name == "." && path.is_relative() && !text.starts_with("..")
                            ? std::optional<fs::path>(text)
                            : remainder(text, name);
            if (rest && (!best || rest->native().size() < best->relative.native().size()))
                best = Place{root, std::move(*rest)};
        }
    }
    return best;
}

/// An open file or folder that closes itself.
class Handle {
  public:
    explicit Handle(int number) : number_(number) {}
    ~Handle() {
        int const kept = errno;
        if (number_ >= 0) ::close(number_);
        errno = kept;
    }
    Handle(Handle const&) = delete;
    Handle& operator=(Handle const&) = delete;
    Handle(Handle&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(number_, other.number_);
        return *this;
    }
    bool is_open() const { return number_ >= 0; }
    int number() const { return number_; }
    int release() { return std::exchange(number_, -1); }

  private:
    int number_;
};

[[noreturn]] void refuse(char const* verb, fs::path const& path) {
    throw MissingError(fmt::format("cannot {} {} ({})", verb, path.string(), reason_of_errno()));
}

int open_folder(fs::path const& path, int flags) {
    if (auto const place = find_place(path))
        return open_beneath(place->root->descriptor, place->relative, flags);
    return ::open(path.empty() ? "." : path.c_str(), flags | O_CLOEXEC);
}

/// The names in an open folder, without "." and "..".
std::optional<std::vector<std::string>> entries_of(int folder) {
    Handle copy(::fcntl(folder, F_DUPFD_CLOEXEC, 0));
    DIR* const stream = copy.is_open() ? ::fdopendir(copy.number()) : nullptr;
    if (stream == nullptr) return {};
    copy.release();  // the stream closes it
    ::rewinddir(stream);
    std::vector<std::string> names;
    while (dirent const* const entry = ::readdir(stream)) {
        std::string name = entry->d_name;
        if (name != "." && name != "..") names.push_back(std::move(name));
    }
    ::closedir(stream);
    return names;
}

bool remove_below(int folder, char const* name);

bool empty_folder(int folder) {
    auto const names = entries_of(folder);
    if (!names) return false;
    return std::ranges::all_of(*names,
                               [&](std::string const& name) { return remove_below(folder, name.c_str()); });
}

bool is_gone(int result) {
    return result == 0 || errno == ENOENT;
}

/// Removes an entry with all its content. @return false with errno on failure
bool remove_below(int folder, char const* name) {
    if (is_gone(::unlinkat(folder, name, 0))) return true;
    if (errno != EISDIR && errno != EPERM) return false;
    Handle const below(::openat(folder, name, folder_flags | O_NOFOLLOW));
    if (!below.is_open() || !empty_folder(below.number())) return errno == ENOENT;
    return is_gone(::unlinkat(folder, name, AT_REMOVEDIR));
}

void make_folder_below(Place const& place, fs::path const& path) {
    // Mostly it is there.
    if (Handle(open_beneath(place.root->descriptor, place.relative, folder_flags)).is_open()) return;
    Handle folder(::openat(place.root->descriptor, ".", folder_flags));
    for (fs::path const& name : place.relative) {
        if (name == "." || name.empty()) continue;
        if (::mkdirat(folder.number(), name.c_str(), 0777) != 0 && errno != EEXIST)
            refuse("make the folder", path);
        Handle next(::openat(folder.number(), name.c_str(), folder_flags | O_NOFOLLOW));
        if (!next.is_open()) refuse("make the folder", path);
        folder = std::move(next);
    }
    if (!folder.is_open()) refuse("make the folder", path);
}

}  // namespace

bool lies_in_own_folder(fs::path const& path) {
    return find_place(path.has_parent_path() ? path.parent_path() : fs::path(".")).has_value();
}

OwnFolder::OwnFolder(fs::path const& folder) {
    Handle opened(open_folder(folder, folder_flags));
    if (!opened.is_open()) {
        throw MissingError(fmt::format("cannot open the folder {} ({})", folder.string(), reason_of_errno()));
    }
    std::error_code ignored;
    std::string const absolute = without_final_slash(fs::absolute(folder, ignored));
    root_ = std::make_shared<Root>(opened.release(), std::vector{without_final_slash(folder), absolute});
    std::unique_lock const lock(registry().mutex);
    registry().roots.push_back(root_);
}

OwnFolder::~OwnFolder() {
    std::unique_lock const lock(registry().mutex);
    std::erase(registry().roots, root_);
}

ParentFolder::ParentFolder(fs::path const& path) : name_(path.filename().string()), descriptor_(-1) {
    fs::path const parent = path.parent_path();
    // A file named by a relative path without a folder may lie in an own folder ".".
    descriptor_ = open_folder(parent.empty() ? fs::path(".") : parent, O_RDONLY | O_DIRECTORY);
}

ParentFolder::~ParentFolder() {
    int const kept = errno;
    if (descriptor_ >= 0) ::close(descriptor_);
    errno = kept;
}

int ParentFolder::open(int flags) const {
    if (!is_open()) return -1;
    return ::openat(descriptor_, name_.c_str(), flags | O_NOFOLLOW | O_CLOEXEC, 0666);
}

void make_folder(fs::path const& path) {
    if (auto const place = find_place(path)) return make_folder_below(*place, path);
    std::error_code failure;
    fs::create_directories(path, failure);
    if (failure || !fs::is_directory(path)) {
        throw MissingError(
            fmt::format("cannot make the folder {} ({}); correct this or choose another folder",
                        path.string(), failure ? failure.message() : "there is a file of this name"));
    }
}

void remove_file(fs::path const& path) {
    ParentFolder const parent(path);
    bool const gone =
        parent.is_open() ? is_gone(::unlinkat(parent.descriptor(), parent.name(), 0)) : errno == ENOENT;
    if (!gone) refuse("remove", path);
}

void remove_tree(fs::path const& path) {
    ParentFolder const parent(path);
    bool const gone = parent.is_open() ? remove_below(parent.descriptor(), parent.name()) : errno == ENOENT;
    if (!gone) refuse("remove", path);
}

void remove_if_empty(fs::path const& folder) {
    ParentFolder const parent(folder);
    if (parent.is_open()) ::unlinkat(parent.descriptor(), parent.name(), AT_REMOVEDIR);
}

void rename_entry(fs::path const& from, fs::path const& to) {
    ParentFolder const before(from), after(to);
    if (!before.is_open() || !after.is_open() ||
        ::renameat(before.descriptor(), before.name(), after.descriptor(), after.name()) != 0)
        refuse(fmt::format("rename {} to", from.string()).c_str(), to);
}

void link_or_copy(fs::path const& from, fs::path const& to) {
    ParentFolder const before(from), after(to);
    if (!before.is_open() || !after.is_open() || !remove_below(after.descriptor(), after.name()))
        refuse("write", to);
    if (::linkat(before.descriptor(), before.name(), after.descriptor(), after.name(), 0) == 0) return;
    replace_file(to, read_file(from));
}

void check_own_file(fs::path const& path) {
    ParentFolder const parent(path);
    struct stat status {};
    if (!parent.is_open() ||
        ::fstatat(parent.descriptor(), parent.name(), &status, AT_SYMLINK_NOFOLLOW) != 0) {
        if (errno == ENOENT) return;
        refuse("look at", path);
    }
    if (!S_ISREG(status.st_mode)) {
        throw MissingError(fmt::format(
            "{} is {}, through which nothing is written; remove it, and look who put it there", path.string(),
            S_ISLNK(status.st_mode) ? "a symbolic link" : "neither a file nor a folder"));
    }
    if (status.st_nlink > 1) replace_file(path, read_file(path));
}

bool is_link(fs::path const& path) {
    std::error_code ignored;
    return fs::symlink_status(path, ignored).type() == fs::file_type::symlink;
}

std::string reason_of_errno() {
    if (errno == ELOOP || errno == EXDEV)
        return "a symbolic link is on the way, and nothing is written or removed through one; remove the "
               "link";
    if (errno == ENOTDIR) return "there is a file or a symbolic link where a folder should be";
    return reason_of(errno);
}

int open_beneath_stepwise(int folder, fs::path const& relative, int flags) {
    Handle current(::openat(folder, ".", folder_flags));
    std::vector<fs::path> const names(relative.begin(), relative.end());
    for (std::size_t i = 0; i < names.size() && current.is_open(); ++i) {
        if (names[i] == ".." || names[i].is_absolute()) {
            errno = EXDEV;
            return -1;
        }
        bool const is_last = i + 1 == names.size();
        current = Handle(::openat(current.number(), names[i].empty() ? "." : names[i].c_str(),
                                  (is_last ? flags | O_CLOEXEC : folder_flags) | O_NOFOLLOW, 0666));
    }
    return current.release();
}

int open_beneath(int folder, fs::path const& relative, int flags) {
    open_how how{};
    how.flags = static_cast<unsigned>(flags | O_CLOEXEC);
    how.mode = (flags & O_CREAT) != 0 ? 0666 : 0;
    how.resolve = RESOLVE_BENEATH | RESOLVE_NO_SYMLINKS;
    long const opened = ::syscall(SYS_openat2, folder, relative.c_str(), &how, sizeof how);
    // EPERM: an old container may forbid a call that it does not know.
    if (opened >= 0 || (errno != ENOSYS && errno != EPERM)) return static_cast<int>(opened);
    return open_beneath_stepwise(folder, relative, flags);
}

}  // namespace vibrotrough::core
