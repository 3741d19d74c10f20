#include "core/open_file.hpp"

#include <cerrno>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace vibrotrough::core {

Descriptor::~Descriptor() {
    int const kept = errno;
    close();
    errno = kept;
}

bool Descriptor::close() {
    return number_ < 0 || ::close(std::exchange(number_, -1)) == 0;
}

Descriptor open_to_read(std::filesystem::path const& path, Kinds kinds) {
    // Without O_NONBLOCK the opening of a pipe would wait for a writer. It changes nothing for regular files.
    int const wait = kinds == Kinds::regular ? O_NONBLOCK : 0;
    Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | wait));
    struct stat status {};
    if (!file.is_open() || kinds == Kinds::given || ::fstat(file.number(), &status) != 0 ||
        S_ISREG(status.st_mode) || S_ISDIR(status.st_mode))
        return file;
    file.close();
    errno = ESPIPE;
    return file;
}

}  // namespace vibrotrough::core
