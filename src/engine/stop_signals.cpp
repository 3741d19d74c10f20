#include "engine/stop_signals.hpp"

#include <csignal>

namespace vibrotrough::engine {

void add_stop_signals(boost::asio::signal_set& signals) {
    for (int const number : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction before {};
        if (::sigaction(number, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) continue;
        signals.add(number);
    }
}

StopSignals::StopSignals() {
    add_stop_signals(signals_);
    wait();
}

int StopSignals::count() {
    context_.poll();
    return count_;
}

void StopSignals::wait() {
    signals_.async_wait([this](auto const& cancelled, int) {
        if (cancelled) return;
        ++count_;
        wait();
    });
}

}  // namespace vibrotrough::engine
