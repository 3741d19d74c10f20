#include "app/process.hpp"

#include <cerrno>
#include <csignal>
#include <cstdlib>

#include <fcntl.h>
#include <unistd.h>

namespace vibrotrough::app {
namespace {

void open_standard_streams() {
    for (int const stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(stream, F_GETFD) >= 0 || errno != EBADF) continue;
        // Opened for the wrong direction, so that a table that nobody can read is an error and no success.
        // Messages may be lost.
        [[maybe_unused]] int const opened = ::open("/dev/null", stream == STDOUT_FILENO ? O_RDONLY : O_RDWR);
    }
}

/// Boost.Process asks for the locale that the environment names, and throws if it is not installed.
/// LC_ALL is stronger than all others; Python takes C for UTF-8.
void set_locale() {
    ::setenv("LC_ALL", "C", 1);
}

void do_nothing(int /*signal*/) {}

void set_signals() {
    struct sigaction action {};
    action.sa_handler = SIG_DFL;
    ::sigaction(SIGCHLD, &action, nullptr);
    sigset_t child;
    ::sigemptyset(&child);
    ::sigaddset(&child, SIGCHLD);
    ::pthread_sigmask(SIG_UNBLOCK, &child, nullptr);
    // A program that is started has the default again for a signal that is handled, but would inherit one
    // that is ignored.
    action.sa_handler = &do_nothing;
    action.sa_flags = SA_RESTART;
    ::sigaction(SIGXFSZ, &action, nullptr);
}

}  // namespace

void prepare_process() {
    open_standard_streams();
    set_locale();
    set_signals();
}

}  // namespace vibrotrough::app
