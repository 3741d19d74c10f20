#include "app/python.hpp"

#include "app/script_folder.hpp"
#include "core/error.hpp"
#include "core/limits.hpp"
#include "core/own_program.hpp"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace vibrotrough::app {
namespace {

namespace fs = std::filesystem;

/// Runs a program of the PATH in `folder` and returns its exit code, 127 when it cannot be started, or
/// 128 + n when signal n ended it.
int run_program(std::vector<std::string> words, fs::path const& folder, bool silent) {
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
    bool const has_output = (::fcntl(STDOUT_FILENO, F_GETFL) & O_ACCMODE) != O_RDONLY;
    for (int const stream : {STDOUT_FILENO, STDERR_FILENO}) {
        if (silent || (stream == STDOUT_FILENO && !has_output))
            posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_WRONLY, 0);
    }
    // Standard output that was closed: the script does all of its work, and main() finds that nobody could
    // read what it said.
    if (!silent && !has_output) std::fputc('\n', stdout);
    std::fflush(stdout);
    pid_t child = 0;
    int const failure = ::posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failure == EAGAIN || failure == EMFILE) {
        throw core::MissingError(
            fmt::format("cannot start {} ({})", words.front(), core::reason_of(failure)));
    }
    if (failure != 0) return 127;
    int status = 0;
    while (::waitpid(child, &status, 0) < 0) {
        if (errno != EINTR) return 127;
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// The path that the user gave, which is relative to the folder that the user is in. A name without a slash
/// is looked for on the PATH.
std::string absolute_program(std::string const& given) {
    return given.find('/') == std::string::npos ? given : fs::absolute(given).string();
}

std::string find_python(std::string const& python, std::vector<std::string> const& modules) {
    // NumPy would start a thread for each core, and hangs where the user may have no more.
    ::setenv("OPENBLAS_NUM_THREADS", "1", 0);
    core::require_processes(2, "Python needs");
    std::string const imports = fmt::format("import {}", fmt::join(modules, ", "));
    static std::map<std::string, std::string> known;  // by what it must import: a command may run two scripts
    if (auto const found = known.find(imports); found != known.end()) return found->second;
    std::vector<std::string> const candidates = python.empty()
                                                    ? std::vector<std::string>{"/usr/bin/python3", "python3"}
                                                    : std::vector{absolute_program(python)};
    for (std::string const& candidate : candidates) {
        if (run_program({candidate, "-c", imports}, script_folder(), true) == 0)
            return known[imports] = candidate;
    }
    std::string packages;
    for (std::string const& module : modules) packages += " python3-" + module;
    throw core::MissingError(fmt::format(
        "{} does not have all of the modules {}; install them (Debian: apt-get install{}), or give "
        "a Python that has them with --python",
        fmt::join(candidates, " or "), fmt::join(modules, ", "), packages));
}

}  // namespace

fs::path script_folder() {
    std::error_code failure;
    fs::path const program = core::own_program();
    // An installed program has its scripts in ../share. A program in its build folder uses those of the
    // sources.
    fs::path const installed = program.parent_path().parent_path() / installed_scripts;
    for (fs::path const& folder : {installed, (program.parent_path() / source_scripts).lexically_normal()}) {
        if (fs::exists(folder / "figures.py", failure)) return folder;
    }
    throw core::MissingError(fmt::format(
        "the scripts that draw figures are not in {}; install Vibrotrough again", installed.string()));
}

int script_exit_code(std::string const& script, std::vector<std::string> const& arguments,
                     std::string const& python, std::vector<std::string> const& modules) {
    fs::path const path = script_folder() / script;
    // -B: no __pycache__, because the folder may be read-only, and the sources must stay clean.
    std::vector<std::string> words{find_python(python, modules), "-B", path.string()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    // Python imports modules from the folder that it is started in, and matplotlib reads its settings there:
    // it is started in the scripts' own folder, because anybody may have put anything into the user's.
    return run_program(words, script_folder(), false);
}

void run_script(std::string const& script, std::vector<std::string> const& arguments,
                std::string const& python, std::vector<std::string> const& modules) {
    int const code = script_exit_code(script, arguments, python, modules);
    if (code == 130 || code == 128 + 2)
        throw core::MissingError(fmt::format("{} was interrupted; run the command again", script));
    if (code != 0) {
        throw core::MissingError(
            fmt::format("{} ended with exit code {}; the reason is in its messages above", script, code));
    }
}

}  // namespace vibrotrough::app
