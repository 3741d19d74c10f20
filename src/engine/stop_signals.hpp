#pragma once

#include <boost/asio/signal_set.hpp>

namespace vibrotrough::engine {

/// Adds the signals that ask the program to stop: SIGINT, SIGTERM and SIGHUP. A signal that was ignored when
/// the program started stays ignored: with nohup a user asks for that, and a shell does it for programs in
/// the background.
void add_stop_signals(boost::asio::signal_set& signals);

}  // namespace vibrotrough::engine
