#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <boost/asio/io_context.hpp>

namespace vibrotrough::engine {

/// A LIGGGHTS that answered when asked for its version.
struct Engine {
    std::filesystem::path program;  ///< path of the executable
    std::string version;  ///< as it names itself, e.g. "LIGGGHTS-PUBLIC 3.8.0, compiled 2022-01-26-19:42:32
                          ///< by buildd"
    int ranks = 1;        ///< MPI processes of every run
    std::string certificate = {};  ///< JSON of the binary's Certificate; empty when it was not probed
};

/// Finds the engine: `asked` when given, else `liggghts` on the PATH, and asks it for its version.
/// @throws MissingError when there is none, it does not start, or it is no LIGGGHTS
Engine find_engine(std::optional<std::filesystem::path> const& asked);

/// How a process ended.
struct ExitStatus {
    int code;    ///< exit code; 0 when it was killed by a signal
    int signal;  ///< 0 when it exited by itself
};

/// The file in the run's folder that receives what the engine prints.
constexpr char const* output_file = "engine.out";

/// What the engine is started on.
struct Launch {
    std::string input = "in.liggghts";   ///< the deck, in the run's folder
    std::vector<std::string> arguments;  ///< after the deck, e.g. {"-var", "done", "50"}
};

/// A running engine on one deck folder. It dies with the driver (also when that is killed) and does not
/// share the terminal's Ctrl-C. Destroying the object kills the engine.
class EngineProcess {
  public:
    /// Starts `liggghts -in <input>` in `folder`, under mpirun when it has several ranks. `on_exit` is called
    /// once, from `context`, by the thread
    /// that runs it; that thread must be the one that constructs this object and must outlive the engine.
    /// @throws MissingError when the process cannot be started
    EngineProcess(boost::asio::io_context& context, Engine const& engine, std::filesystem::path const& folder,
                  std::function<void(ExitStatus)> on_exit, Launch const& launch = {});
    ~EngineProcess();
    EngineProcess(EngineProcess const&) = delete;
    EngineProcess& operator=(EngineProcess const&) = delete;

    /// Asks the engine to end (SIGTERM) and kills it when it has not after five seconds. LIGGGHTS answers the
    /// signal with exit code 0, so whoever calls this must remember that the run was cut.
    void terminate();

  private:
    struct State;
    std::shared_ptr<State> state_;
};

}  // namespace vibrotrough::engine
