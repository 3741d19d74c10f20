#include "app/python.hpp"

#include "app/script_folder.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/limits.hpp"
#include "core/own_program.hpp"
#include "core/temporary_folder.hpp"
#include "core/time.hpp"
#include "core/version.hpp"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace vibrotrough::app {
namespace {

namespace fs = std::filesystem;

/// With which a script's Python ends that has not all modules.
constexpr int missing_modules = 97;

/// Runs Python in `folder`. Its exit code, or 128 + n when signal n ended it; nothing when the program could
/// not be started, or has not all modules.
std::optional<int> run_python(std::vector<std::string> words, fs::path const& folder) {
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
    std::fflush(stdout);
    pid_t child = 0;
    int const failure = ::posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    int status = 0;
    bool ended = failure == 0;
    while (ended && ::waitpid(child, &status, 0) < 0) ended = errno == EINTR;
    if (failure == EAGAIN || failure == EMFILE) {
        throw core::MissingError(
            fmt::format("cannot start {} ({})", words.front(), core::reason_of(failure)));
    }
    bool const has_modules = !WIFEXITED(status) || WEXITSTATUS(status) != missing_modules;
    if (!ended || !has_modules) return {};
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// The path that the user gave, which is relative to the folder that the user is in. A name without a slash
/// is looked for on the PATH.
std::string absolute_program(std::string const& given) {
    return given.find('/') == std::string::npos ? given : fs::absolute(given).string();
}

/// Python that imports the modules and then runs the script whose name and arguments follow, as `python3 -m`
/// does. One start does both, because the imports take as long as many a script.
std::string starter(std::vector<std::string> const& modules) {
    return fmt::format(R"(import os, runpy, sys
try:
    import {}
except Exception:
    sys.exit({})
del sys.argv[0]
if sys.path[:1] == [""]:
    del sys.path[0]
sys.path.insert(0, os.getcwd())
runpy.run_module(sys.argv[0], run_name="__main__", alter_sys=True)
)",
                       fmt::join(modules, ", "), missing_modules);
}

}  // namespace

fs::path script_folder() {
    std::error_code failure;
    fs::path const program = core::own_program();
    // An installed program has its scripts in ../share. A program in its build folder uses those of the
    // sources.
    fs::path const installed = program.parent_path().parent_path() / installed_scripts;
    for (fs::path const& folder : {installed, (program.parent_path() / source_scripts).lexically_normal()}) {
        if (fs::exists(folder / "vibrotrough/__init__.py", failure)) return folder;
    }
    throw core::MissingError(fmt::format(
        "the Python package vibrotrough is not in {}; install Vibrotrough again", installed.string()));
}

int script_exit_code(std::string const& script, std::vector<std::string> const& arguments,
                     std::string const& python, std::vector<std::string> const& modules) {
    // NumPy would start a thread for each core, and hangs where the user may have no more.
    ::setenv("OPENBLAS_NUM_THREADS", "1", 0);
    ::setenv("MPLBACKEND", "Agg", 1);  // all figures are files
    ::unsetenv("PYTHONOPTIMIZE");      // with 2 a function has no docstring, which says what it measures
    std::vector<std::string> const candidates = python.empty()
                                                    ? std::vector<std::string>{"/usr/bin/python3", "python3"}
                                                    : std::vector{absolute_program(python)};
    for (std::string const& candidate : candidates) {
        // -B: no __pycache__, because the folder may be read-only, and the sources must stay clean.
        std::vector<std::string> words{candidate, "-B", "-c", starter(modules), script};
        words.insert(words.end(), arguments.begin(), arguments.end());
        // Python imports modules from the folder that it is started in, and matplotlib reads its settings
        // there: it is started in the scripts' own folder, because anybody may have put anything into the
        // user's.
        if (std::optional<int> const code = run_python(words, script_folder())) return *code;
    }
    std::string packages;
    for (std::string const& module : modules) packages += " python3-" + module;
    throw core::MissingError(fmt::format(
        "{} does not have all of the modules {}; install them (Debian: apt-get install{}), or give "
        "a Python that has them with --python",
        fmt::join(candidates, " or "), fmt::join(modules, ", "), packages));
}

void run_script(std::string const& script, std::vector<std::string> const& arguments,
                std::string const& python, std::vector<std::string> const& modules) {
    check_script(script, script_exit_code(script, arguments, python, modules));
}

void check_script(std::string const& script, int code) {
    if (code == 130 || code == 128 + 2)
        throw core::MissingError(fmt::format("{} was interrupted; run the command again", script));
    if (code != 0) {
        throw core::MissingError(
            fmt::format("{} ended with exit code {}; the reason is in its messages above", script, code));
    }
}

void write_decision_page(nlohmann::ordered_json data, std::string const& kind, std::string const& file,
                         std::string const& python) {
    data["kind"] = kind;
    data["made"] = {{"program_version", core::program_version()},
                    {"git_commit", core::program_commit()},
                    {"written", core::utc_now()}};
    core::TemporaryFolder const folder("vibrotrough-page");
    auto const path = folder.path() / "decision.json";
    core::write_file_atomically(path, data.dump());
    run_script("vibrotrough.report.decision",
               {path.string(), "--output", std::filesystem::absolute(file).string()}, python,
               {"numpy", "matplotlib", "jinja2"});
}

}  // namespace vibrotrough::app
