#include "app/standard_streams.hpp"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <ctime>

namespace vibrotrough::app {

void tell_text(std::string_view text) noexcept {
    sigset_t pipe, before;
    ::sigemptyset(&pipe);
    ::sigaddset(&pipe, SIGPIPE);
    ::pthread_sigmask(SIG_BLOCK, &pipe, &before);
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
    std::clearerr(stderr);
    // The signal of a pipe that nobody reads is taken away before it can end the process.
    timespec const at_once{};
    while (::sigtimedwait(&pipe, nullptr, &at_once) < 0 && errno == EINTR) {
    }
    ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

}  // namespace vibrotrough::app
