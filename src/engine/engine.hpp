#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <boost/asio/io_context.hpp>

namespace vibrotrough::engine {

/// A file of an engine as it was when its digest was taken.
struct EngineFile {
    std::filesystem::path path;            ///< of the program, or of the library that it links
    std::filesystem::file_time_type time;  ///< of the last change
    std::uintmax_t size;                   ///< bytes
};

/// How a file is now. @throws MissingError when it is gone
EngineFile stamp_of(std::filesystem::path const& path);

/// A LIGGGHTS program that has reported its version.
struct Engine {
    std::filesystem::path program;   ///< path of the binary
    std::string version;             ///< as reported by the program, e.g. "LIGGGHTS-PUBLIC 3.8.0, compiled
                                     ///< 2022-01-26-19:42:32 by buildd"
    int ranks = 1;                   ///< number of MPI processes of each run
    std::string certificate = {};    ///< JSON of the binary's Certificate; empty if it was not probed
    std::string binary_sha256 = {};  ///< of the program's file and its library; empty if they were not read
    std::vector<EngineFile> files = {};  ///< that were read for it
};

/// Notices when the files of an engine are replaced, for example by an upgrade in the night: what another
/// binary computes does not belong to the certificate and the version that a campaign was begun with.
/// @throws MissingError when a file is not what it was
void require_unchanged(Engine const& engine);

/// Finds the engine, which is `requested` if given and otherwise `liggghts` on the PATH, and reads its
/// version.
/// @throws MissingError when there is no such program, it cannot be started, or it is not LIGGGHTS
Engine find_engine(std::optional<std::filesystem::path> const& requested);

/// How a process ended.
struct ExitStatus {
    int code;    ///< exit code; 0 if it was killed by a signal
    int signal;  ///< 0 if it exited by itself
    /// s, processor time of the engine on all ranks. When several engines end at the same moment, the first
    /// to be handled is given the time of all of them.
    double core_time = 0;
};

/// The file in the run's folder that receives what the engine prints.
constexpr char const* output_file = "engine.out";

/// The deck and the arguments with which the engine is started.
struct Launch {
    std::string input = "in.liggghts";   ///< the deck, in the run's folder
    std::vector<std::string> arguments;  ///< after the deck, e.g. {"-var", "done", "50"}
};

/// An engine that runs in one deck folder. It dies with the driver (also when the driver is killed) and does
/// not receive Ctrl-C from the terminal. Destroying the object kills the engine. No other engine can start in
/// the folder as long as it, or a process that it has started, lives (sole_writer.hpp).
class EngineProcess {
  public:
    /// Starts `liggghts -in <input>` in `folder`, with mpirun if it has several ranks. `on_exit` is called
    /// once, from `context`, by the thread that runs it. That thread must be the one that constructs this
    /// object, and it must outlive the engine.
    /// @throws MissingError when the process cannot be started, the binary is not what it was
    /// (require_unchanged), or another engine still writes in the folder
    EngineProcess(boost::asio::io_context& context, Engine const& engine, std::filesystem::path const& folder,
                  std::function<void(ExitStatus)> on_exit, Launch const& launch = {});
    ~EngineProcess();
    EngineProcess(EngineProcess const&) = delete;
    EngineProcess& operator=(EngineProcess const&) = delete;

    /// s, processor time so far, of the engine and of the processes that it has started.
    double core_time() const;

    /// Sends SIGTERM to the engine, and kills it if it has not ended after five seconds. LIGGGHTS ends with
    /// exit code 0 after SIGTERM, so the caller must remember that the run was stopped early.
    void terminate();

  private:
    struct State;
    std::shared_ptr<State> state_;
};

}  // namespace vibrotrough::engine
