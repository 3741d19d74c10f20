#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>

namespace vibrotrough::engine {

/// Adds the signals that ask the program to stop: SIGINT, SIGTERM and SIGHUP. A signal that was ignored when
/// the program started stays ignored: with nohup a user asks for that, and a shell does it for programs in
/// the background.
void add_stop_signals(boost::asio::signal_set& signals);

/// Notices these signals, which then no longer end the process.
class StopSignals {
  public:
    StopSignals();  ///< From now on.
    /// How many have come so far.
    int count();

  private:
    void wait();

    boost::asio::io_context context_;
    boost::asio::signal_set signals_{context_};
    int count_ = 0;
};

}  // namespace vibrotrough::engine
