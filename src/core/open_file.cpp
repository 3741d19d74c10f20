#include "core/open_file.hpp"

#include <cerrno>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace vibrotrough::core {

int open_to_read(std::filesystem::path const& path, Kinds kinds) {
    // Without O_NONBLOCK the opening of a pipe would wait for a writer. It changes nothing for regular files.
    int const wait = kinds == Kinds::regular ? O_NONBLOCK : 0;
    int const opened = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | wait);
    struct stat status {};
    if (opened < 0 || kinds == Kinds::given || ::fstat(opened, &status) != 0 || S_ISREG(status.st_mode) ||
        S_ISDIR(status.st_mode))
        return opened;
    ::close(opened);
    errno = ESPIPE;
    return -1;
}

}  // namespace vibrotrough::core
