#include "core/limits.hpp"

#include <cerrno>
#include <cstring>

#include <fmt/format.h>
#include <sys/resource.h>

namespace vibrotrough::core {
namespace {

std::string limit_text(__rlimit_resource resource, char const* format, rlim_t unit) {
    rlimit limit{RLIM_INFINITY, RLIM_INFINITY};
    ::getrlimit(resource, &limit);
    if (limit.rlim_cur == RLIM_INFINITY) return {};
    return fmt::format(fmt::runtime(format), limit.rlim_cur / unit);
}

}  // namespace

std::string reason_of(int error) {
    std::string limit;
    if (error == EMFILE) {
        limit = limit_text(RLIMIT_NOFILE, "; the limit is {} open files, raise it with ulimit -n", 1);
    } else if (error == EFBIG) {
        limit = limit_text(RLIMIT_FSIZE, "; the limit is {} KB for a file, raise it with ulimit -f", 1024);
    } else if (error == EAGAIN) {
        limit =
            limit_text(RLIMIT_NPROC, "; the limit is {} processes of this user, raise it with ulimit -u", 1);
    }
    return std::strerror(error) + limit;
}

}  // namespace vibrotrough::core
