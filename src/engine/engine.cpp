#include "engine/engine.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/limits.hpp"
#include "core/temporary_folder.hpp"
#include "core/text.hpp"
#include "engine/sole_writer.hpp"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <system_error>
#include <thread>
#include <utility>

#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/process.hpp>
#include <boost/process/extend.hpp>
#include <boost/process/posix.hpp>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace vibrotrough::engine {
namespace {

namespace bp = boost::process;
namespace fs = std::filesystem;
using namespace std::chrono_literals;
using namespace std::string_literals;

/// Runs in the child before the engine starts: leaves the process group of the terminal and asks to be killed
/// when the driver dies. No file of the engine may grow larger than this program reads: an engine that
/// repeats a warning for ever would fill the disk. The child shares the driver's memory (vfork) and must not
/// write to it.
void prepare_child(pid_t driver) {
    ::setpgid(0, 0);
    rlimit size{};
    if (::getrlimit(RLIMIT_FSIZE, &size) == 0 && size.rlim_cur > core::largest_file) {
        size.rlim_cur = core::largest_file;
        ::setrlimit(RLIMIT_FSIZE, &size);
    }
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != driver) ::_exit(1);  // the driver has died in the meantime
}

/// Settings of Open MPI for one rank, which talks to nobody. Without the first, the engine starts a daemon
/// and takes 0.15 s longer, or 5 s if the name of the machine cannot be resolved. Without the second, Open
/// MPI loads every network that it knows, and one of them, PSM, sleeps 0.2 s to calibrate its clock. The
/// third keeps it from looking for networks below that. (Set with env, because the environment class of
/// Boost 1.74 reads beyond its strings.)
constexpr std::array single_rank_settings{"OMPI_MCA_ess_singleton_isolated=1", "OMPI_MCA_pml=ob1",
                                          "OMPI_MCA_btl=self"};

/// The settings that give an engine a folder of its own for what Open MPI keeps while it runs. By default all
/// engines of a user share one below the temporary folder, which goes when the last one ends: an engine that
/// starts at that moment ends with exit code 1 and no message. Open MPI 4 knows the first name, 5 the second.
std::vector<std::string> session_settings(core::TemporaryFolder const& session) {
    std::string const folder = session.path().string();
    return {"OMPI_MCA_orte_tmpdir_base=" + folder, "TMPDIR=" + folder};
}

/// Those of an engine of one rank, which needs no shared memory: Open MPI 5.0 never removes its file, of 16
/// MB with 80 kB in use, from /dev/shm when there is no mpirun to do it.
std::vector<std::string> lone_settings(core::TemporaryFolder const& session) {
    std::vector<std::string> settings = session_settings(session);
    settings.push_back("OMPI_MCA_btl_sm_backing_directory=" + session.path().string());
    settings.insert(settings.end(), single_rank_settings.begin(), single_rank_settings.end());
    return settings;
}

constexpr char const* session_name = "vibrotrough-engine";

fs::path search_program(std::optional<fs::path> const& requested) {
    if (requested) {
        std::error_code failure;
        fs::path const program = fs::absolute(*requested, failure);
        if (!fs::is_regular_file(program, failure)) {
            throw core::MissingError(fmt::format(
                "--liggghts: there is no file {}; give the path of a LIGGGHTS program", requested->string()));
        }
        return program;
    }
    auto const found = bp::search_path("liggghts");
    if (found.empty()) {
        throw core::MissingError(
            "no liggghts on the PATH; install it (apt-get install --no-install-recommends liggghts) or give "
            "its path with --liggghts PATH");
    }
    return found.string();
}

std::string ask_version(fs::path const& program) {
    core::TemporaryFolder const session(session_name);
    std::string version, first_line;
    int code = 0;
    try {
        bp::ipstream output;
        // A program that is no LIGGGHTS may do anything, such as never end.
        std::vector<std::string> words = lone_settings(session);
        for (std::string const& word : {"timeout"s, "10"s, program.string(), "-log"s, "none"s, "-h"s}) {
            words.push_back(word);
        }
        bp::child child(bp::search_path("env"), bp::args(words), (bp::std_out & bp::std_err) > output,
                        bp::std_in < bp::null);
        for (std::string line; std::getline(output, line);) {
            auto const start = line.find("(Version ");
            if (version.empty() && line.starts_with("LIGGGHTS") && start != std::string::npos) {
                version = line.substr(start + 9, line.rfind(')') - start - 9);
            }
            if (first_line.empty()) first_line = core::harmless(line.substr(0, 300));
        }
        child.wait();
        code = child.exit_code();
    } catch (bp::process_error const& error) {
        throw core::MissingError(fmt::format("{} cannot be started ({})", program.string(),
                                             core::reason_of(error.code().value())));
    }
    if (!version.empty()) return version;
    throw core::MissingError(fmt::format(
        "{} does not identify itself as LIGGGHTS (it ended with exit code {}{}); give another program with "
        "--liggghts PATH",
        program.string(), code,
        first_line.empty() ? " and printed nothing" : fmt::format(": '{}'", first_line)));
}

/// The command line of a run. Line-buffered, so that an error message is not lost with the buffer.
std::vector<std::string> run_words(Engine const& engine, Launch const& launch,
                                   core::TemporaryFolder const& session) {
    std::vector<std::string> words = engine.ranks > 1 ? session_settings(session) : lone_settings(session);
    if (engine.ranks > 1) {
        if (bp::search_path("mpirun").empty()) {
            throw core::MissingError(
                "more than one MPI rank needs mpirun, which is not on the PATH; install openmpi-bin, or set "
                "ranks = 1 under [run]");
        }
        // mpirun would bind every run to the first cores; as root it wants to be told twice.
        for (std::string const& word : {"OMPI_MCA_mpi_yield_when_idle=1"s, "OMPI_ALLOW_RUN_AS_ROOT=1"s,
                                        "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1"s, "mpirun"s, "--bind-to"s, "none"s,
                                        "--oversubscribe"s, "-np"s, std::to_string(engine.ranks)}) {
            words.push_back(word);
        }
    }
    // The ranks die with mpirun, which dies with the driver: they close the lock of the folder.
    if (engine.ranks > 1) words.insert(words.end(), {"setpriv", "--pdeathsig", "KILL"});
    words.insert(words.end(), {"stdbuf", "-oL"});
    words.push_back(engine.program.string());
    for (std::string const& word : {std::string("-in"), launch.input}) words.push_back(word);
    words.insert(words.end(), launch.arguments.begin(), launch.arguments.end());
    return words;
}

/// A new file for what the engine prints.
std::unique_ptr<std::FILE, int (*)(std::FILE*)> open_output(fs::path const& folder) {
    fs::path const path = folder / output_file;
    std::FILE* const file = std::fopen(path.c_str(), "we");
    if (file == nullptr) {
        throw core::MissingError(fmt::format("cannot write {} ({})", path.string(), core::reason_of(errno)));
    }
    return {file, &std::fclose};
}

ExitStatus decode(int native, double core_time) {
    if (WIFSIGNALED(native)) return {0, WTERMSIG(native), core_time};
    return {WEXITSTATUS(native), 0, core_time};
}

/// s, processor time of the processes that have ended since the last call, with their own children.
double time_of_ended_processes() {
    static double known = 0;  // every engine is started and awaited by one thread
    rusage usage{};
    ::getrusage(RUSAGE_CHILDREN, &usage);
    auto const seconds = [](timeval const& time) {
        return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    double const total = seconds(usage.ru_utime) + seconds(usage.ru_stime);
    return total - std::exchange(known, total);
}

/// s, processor time of a process that runs; 0 when it does not.
double time_of_process(pid_t process) {
    clockid_t clock = 0;
    timespec time{};
    if (::clock_getcpuclockid(process, &clock) != 0 || ::clock_gettime(clock, &time) != 0) return 0;
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Waits, for 2 s at most, until a killed process has ended, and leaves its status to whoever asks for it.
/// Until then it may still make files in its session folder, which could not be removed whole.
void await_end(pid_t process) {
    auto const until = std::chrono::steady_clock::now() + 2s;
    siginfo_t info{};
    while (::waitid(P_PID, static_cast<id_t>(process), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
           info.si_pid == 0 && std::chrono::steady_clock::now() < until) {
        std::this_thread::sleep_for(2ms);
    }
}

}  // namespace

EngineFile stamp_of(fs::path const& path) {
    std::error_code failure;
    EngineFile file{path, fs::last_write_time(path, failure), 0};
    if (!failure) file.size = fs::file_size(path, failure);
    if (!failure) return file;
    throw core::MissingError(fmt::format(
        "the engine {} is gone; put it back, or name another with --liggghts PATH", path.string()));
}

void require_unchanged(Engine const& engine) {
    for (EngineFile const& file : engine.files) {
        EngineFile const now = stamp_of(file.path);
        if (now.time == file.time && now.size == file.size) continue;
        throw core::MissingError(
            fmt::format("the engine's file {} was replaced after this run had begun; what it has computed "
                        "since is not used. Run the same command again, which tests the new engine",
                        file.path.string()));
    }
}

Engine find_engine(std::optional<fs::path> const& requested) {
    fs::path const program = search_program(requested);
    return {program, ask_version(program)};
}

struct EngineProcess::State {
    explicit State(boost::asio::io_context& context) : patience(context) {}

    void signal(int number) const {
        if (!ended && process.valid()) ::kill(-process.id(), number);
    }

    core::TemporaryFolder session{session_name};
    bp::child process;
    boost::asio::steady_timer patience;
    std::function<void(ExitStatus)> on_exit;
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    int ranks = 1;
    double core_time = 0;
    bool ended = false;
};

EngineProcess::EngineProcess(boost::asio::io_context& context, Engine const& engine, fs::path const& folder,
                             std::function<void(ExitStatus)> on_exit, Launch const& launch)
    : state_(std::make_shared<State>(context)) {
    state_->on_exit = std::move(on_exit);
    state_->ranks = engine.ranks;
    // The exit handler owns the state; a destroyed EngineProcess no longer has a handler. The handler is
    // posted, because Boost 1.74 iterates over its list of children while it calls handlers and must not find
    // a new child there. The number that Boost passes may be an exit code or a signal; only the process
    // status tells which.
    auto const ended = [state = state_, &context](int, std::error_code const&) {
        state->ended = true;
        state->core_time = time_of_ended_processes();
        state->patience.cancel();
        boost::asio::post(context, [state] {
            if (state->on_exit)
                std::exchange(state->on_exit,
                              nullptr)(decode(state->process.native_exit_code(), state->core_time));
        });
    };
    require_unchanged(engine);
    WriterLock const lock(folder);
    auto const output = open_output(folder);
    try {
        state_->process =
            bp::child(bp::search_path("env"), bp::args(run_words(engine, launch, state_->session)),
                      bp::start_dir(folder.string()), (bp::std_out & bp::std_err) > output.get(),
                      bp::std_in < bp::null, context, bp::on_exit(ended), bp::posix::use_vfork,
                      bp::extend::on_exec_setup([driver = ::getpid(), &lock](auto&) {
                          prepare_child(driver);
                          lock.keep_in_child();
                      }),
                      // With use_vfork Boost 1.74 does not throw when there is no new process; nobody would
                      // ever see it end.
                      bp::extend::on_error([](auto&, std::error_code const& failure) {
                          throw bp::process_error(failure, "no new process");
                      }));
        lock.note_group(state_->process.id());
    } catch (bp::process_error const& error) {
        // Boost 1.74 does not notice that /dev/null could not be opened, only that the process cannot use it.
        int const reason = error.code().value() == EBADF ? EMFILE : error.code().value();
        throw core::MissingError(fmt::format("cannot start {} in {} ({})", engine.program.string(),
                                             folder.string(), core::reason_of(reason)));
    }
}

EngineProcess::~EngineProcess() {
    state_->on_exit = nullptr;
    if (state_->ended || !state_->process.valid()) return;
    state_->signal(SIGKILL);
    await_end(state_->process.id());
}

double EngineProcess::core_time() const {
    if (state_->ended) return state_->core_time;
    if (state_->ranks == 1) return time_of_process(state_->process.id());
    // mpirun does not know the time of ranks that still run; they do not wait for anything else.
    std::chrono::duration<double> const elapsed = std::chrono::steady_clock::now() - state_->start;
    return elapsed.count() * state_->ranks;
}

void EngineProcess::terminate() {
    state_->signal(SIGTERM);
    state_->patience.expires_after(5s);
    state_->patience.async_wait([state = state_](boost::system::error_code const& cancelled) {
        if (!cancelled) state->signal(SIGKILL);
    });
}

}  // namespace vibrotrough::engine
