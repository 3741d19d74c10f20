#include "core/limits.hpp"

#include "core/error.hpp"

#include <cerrno>
#include <cstring>
#include <latch>
#include <system_error>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <sys/resource.h>

namespace vibrotrough::core {
namespace {

/// The limit that holds for this process.
rlim_t limit_of(__rlimit_resource resource) {
    rlimit limit{RLIM_INFINITY, RLIM_INFINITY};
    ::getrlimit(resource, &limit);
    return limit.rlim_cur;
}

std::string limit_text(__rlimit_resource resource, char const* format, rlim_t unit) {
    rlim_t const limit = limit_of(resource);
    if (limit == RLIM_INFINITY) return {};
    return fmt::format(fmt::runtime(format), limit / unit);
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

void require_open_files(unsigned long least, std::string_view what) {
    rlim_t const limit = limit_of(RLIMIT_NOFILE);
    if (limit >= least) return;
    throw MissingError(
        fmt::format("{} {} open files, and the limit of this process is {}; raise it with ulimit -n", what,
                    least, limit));
}

void require_processes(int count, std::string_view what) {
    std::latch all_tried(1);
    std::vector<std::jthread> threads;  // which count like processes
    int error = 0;
    try {
        while (static_cast<int>(threads.size()) < count) threads.emplace_back([&] { all_tried.wait(); });
    } catch (std::system_error const& failure) {
        error = failure.code().value();
    }
    all_tried.count_down();
    if (error == 0) return;
    throw MissingError(fmt::format("{} {} further processes or threads, and only {} can be started ({})",
                                   what, count, threads.size(), reason_of(error)));
}

}  // namespace vibrotrough::core
