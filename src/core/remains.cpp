#include "core/remains.hpp"

#include "core/time.hpp"

#include <string_view>

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace vibrotrough::core {
namespace {

constexpr char const* temporary_mark = ".part-";

/// Removes what a killed process left of a temporary file. A process that still writes it holds its lock,
/// whatever its number and on whichever machine.
void remove_remnant(int folder, char const* name) {
    int const file = ::openat(folder, name, O_WRONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) return;
    struct stat status {};
    if (::fstat(file, &status) == 0 && S_ISREG(status.st_mode) && ::flock(file, LOCK_EX | LOCK_NB) == 0)
        ::unlinkat(folder, name, 0);
    ::close(file);
}

/// Whether the rest of a name after ".part-" is that of a temporary file of this program, "machine-number". A
/// person calls a copy .part-mine or .part-backup.
bool is_of_process(std::string_view rest) {
    std::size_t const digits = rest.find_last_not_of("0123456789") + 1;
    return digits > 1 && digits < rest.size() && rest[digits - 1] == '-';
}

}  // namespace

std::string temporary_name(std::string const& name) {
    return name + temporary_mark + host_name().substr(0, 40) + "-" + std::to_string(::getpid());
}

void remove_remains(ParentFolder const& parent) {
    int const copy = ::fcntl(parent.descriptor(), F_DUPFD_CLOEXEC, 0);
    DIR* const stream = copy < 0 ? nullptr : ::fdopendir(copy);
    if (stream == nullptr) {
        if (copy >= 0) ::close(copy);
        return;
    }
    ::rewinddir(stream);
    std::string const begin = std::string(parent.name()) + temporary_mark;
    while (dirent const* const entry = ::readdir(stream)) {
        std::string_view const name = entry->d_name;
        if (name.starts_with(begin) && is_of_process(name.substr(begin.size())))
            remove_remnant(parent.descriptor(), entry->d_name);
    }
    ::closedir(stream);
}

}  // namespace vibrotrough::core
