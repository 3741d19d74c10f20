#include "campaign/execute/slurm.hpp"

#include "core/error.hpp"
#include "core/text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <sstream>
#include <vector>

#include <boost/process.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::campaign::slurm {
namespace {

namespace bp = boost::process;

struct Answer {
    int code;
    std::string output;
    std::string errors;
};

/// Runs a command of Slurm's to its end, a minute at most.
Answer call(std::vector<std::string> words) {
    auto const program = bp::search_path(words.front());
    if (program.empty()) {
        throw core::MissingError(fmt::format(
            "there is no {} here; run where Slurm is installed, or write executor = \"local\" under [run]",
            words.front()));
    }
    words.front() = program.string();
    words.insert(words.begin(), "60");
    try {
        boost::asio::io_context context;
        std::future<std::string> output, errors;
        bp::child child(bp::search_path("timeout"), bp::args(words), bp::std_in<bp::null, bp::std_out> output,
                        bp::std_err > errors, context);
        context.run();
        child.wait();
        return {child.exit_code(), output.get(), errors.get()};
    } catch (bp::process_error const& error) {
        throw core::MissingError(fmt::format("cannot start {} ({})", words[1], error.code().message()));
    }
}

std::string first_line(std::string const& text) {
    return core::printable(text.substr(0, text.find('\n')), 300);
}

std::vector<std::string> split(std::string const& line, char separator) {
    std::vector<std::string> parts;
    std::istringstream text(line);
    for (std::string part; std::getline(text, part, separator);) {
        auto const end = part.find_last_not_of(' ');
        parts.push_back(end == std::string::npos ? "" : part.substr(0, end + 1));
    }
    return parts;
}

template <typename Number>
std::optional<Number> parse(std::string_view text) {
    Number number{};
    auto const [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (failure != std::errc() || end != text.data() + text.size()) return {};
    return number;
}

/// "123_4" as (123, 4).
std::optional<std::pair<long, int>> parse_task(std::string const& text) {
    auto const gap = text.find('_');
    if (gap == std::string::npos) return {};
    auto const job = parse<long>(text.substr(0, gap));
    auto const index = parse<int>(text.substr(gap + 1));
    if (!job || !index) return {};
    return std::pair(*job, *index);
}

/// Lines "task|state|reason" into the reports, none of which is replaced.
void read_lines(std::string const& output, Reports& reports) {
    std::istringstream lines(output);
    for (std::string line; std::getline(lines, line);) {
        auto const parts = split(line, '|');
        if (parts.size() < 2) continue;
        auto const task = parse_task(parts[0]);
        // "CANCELLED by 0": the first word is the state.
        std::string const state = parts[1].substr(0, parts[1].find(' '));
        if (task) reports.insert({*task, {state, parts.size() > 2 ? core::printable(parts[2], 60) : ""}});
    }
}

enum class Heard { answer, unknown_job, nothing };

Heard squeue(std::string const& jobs, Reports& reports) {
    Answer const answer = call({"squeue", "-h", "-r", "-t", "all", "-j", jobs, "-o", "%F_%K|%T|%r"});
    if (answer.code == 0) {
        read_lines(answer.output, reports);
        return Heard::answer;
    }
    // A purged id is an error of its own; anything else means that the controller does not answer.
    return answer.errors.find("Invalid job id") != std::string::npos ? Heard::unknown_job : Heard::nothing;
}

/// Fails where there is no accounting; then nothing more is known.
void sacct(std::string const& jobs, Reports& reports) {
    if (bp::search_path("sacct").empty()) return;
    Answer const answer = call({"sacct", "-n", "-P", "-X", "-a", "-j", jobs, "-o", "JobID,State,Reason"});
    if (answer.code == 0) read_lines(answer.output, reports);
}

[[noreturn]] void refuse(Answer const& answer) {
    throw core::MissingError(
        fmt::format("Slurm does not take the job ({}); see [run.slurm] in the campaign file, "
                    "and sinfo for what there is",
                    first_line(answer.errors.empty() ? answer.output : answer.errors)));
}

/// Slurm keeps MaxJobCount jobs, each task of an array counts as one, and one that has ended counts until
/// MinJobAge has passed. sbatch --test-only says the first of these texts, sbatch itself the second.
bool has_no_room(Answer const& answer) {
    return answer.code != 0 && (answer.errors.find("Resource temporarily unavailable") != std::string::npos ||
                                answer.errors.find("temporarily unable to accept job") != std::string::npos);
}

std::vector<std::string> submission(Array const& array) {
    scenario::SlurmSettings const& asked = array.settings;
    std::string indices = fmt::format("0-{}", array.tasks - 1);
    if (asked.concurrent_tasks) indices += fmt::format("%{}", *asked.concurrent_tasks);
    std::vector<std::string> words{"sbatch",
                                   "--parsable",
                                   "--no-requeue",
                                   "--array=" + indices,
                                   "--job-name=" + array.name,
                                   "--chdir=" + std::filesystem::absolute(array.folder).string(),
                                   "--output=" + array.output,
                                   "--nodes=1",
                                   fmt::format("--ntasks={}", array.ranks),
                                   "--cpus-per-task=1"};
    if (asked.partition) words.push_back("--partition=" + asked.partition->str());
    if (asked.account) words.push_back("--account=" + asked.account->str());
    if (asked.minutes) words.push_back(fmt::format("--time={}", *asked.minutes));
    if (asked.memory) words.push_back(fmt::format("--mem={}M", *asked.memory));
    for (scenario::SlurmOption const& option : asked.extra) words.push_back(option.str());
    words.push_back((std::filesystem::absolute(array.folder) / array.script).string());
    return words;
}

/// Slurm's "[days-][[hours:]minutes:]seconds" in minutes, rounded down; nothing for "infinite" and the like.
std::optional<long> parse_minutes(std::string const& text) {
    auto const dash = text.find('-');
    long const days = dash == std::string::npos ? 0 : parse<long>(text.substr(0, dash)).value_or(0);
    long seconds = 0;
    for (std::string const& part : split(dash == std::string::npos ? text : text.substr(dash + 1), ':')) {
        auto const number = parse<long>(part);
        if (!number) return {};
        seconds = 60 * seconds + *number;
    }
    return days * 24 * 60 + seconds / 60;
}

/// Slurm takes a job that is too long for its partition, and lets it wait for ever.
void check_time(scenario::SlurmSettings const& asked) {
    if (!asked.minutes) return;
    std::istringstream lines(call({"sinfo", "-h", "-o", "%P|%l"}).output);
    for (std::string line; std::getline(lines, line);) {
        auto const parts = split(line, '|');
        if (parts.size() != 2) continue;
        bool const is_default = parts[0].ends_with('*');
        std::string const name = parts[0].substr(0, parts[0].size() - (is_default ? 1 : 0));
        if (asked.partition ? asked.partition->str() != name : !is_default) continue;
        auto const limit = parse_minutes(parts[1]);
        if (!limit || *asked.minutes <= *limit) return;
        throw core::MissingError(
            fmt::format("Slurm's partition {} has a limit of {} minutes, and run.slurm.time asks "
                        "for {}{}; ask for less, or for another partition",
                        name, *limit, *asked.minutes,
                        asked.minutes_per_task ? " for the largest task of several packings" : ""));
    }
}

}  // namespace

bool check(Array const& array) {
    check_time(array.settings);
    std::vector<std::string> words = submission(array);
    words.insert(words.begin() + 1, "--test-only");
    Answer const answer = call(words);
    if (has_no_room(answer)) return false;
    if (answer.code != 0) refuse(answer);
    return true;
}

std::optional<long> submit(Array const& array) {
    Answer const answer = call(submission(array));
    auto const job = parse<long>(answer.output.substr(0, answer.output.find_first_of(";\n")));
    if (answer.code == 0 && job) return job;
    if (!has_no_room(answer)) refuse(answer);
    // sbatch tries again by itself, and may have been ended by our time limit just after it succeeded.
    return find_by_name(array.name);
}

int most_array_tasks() {
    Answer const answer = call({"scontrol", "show", "config"});
    auto const at = answer.output.find("MaxArraySize");
    if (answer.code != 0) {
        throw core::MissingError(
            fmt::format("Slurm does not answer ({}); try again when it does", first_line(answer.errors)));
    }
    if (at == std::string::npos) return 1000;
    std::istringstream line(answer.output.substr(at));
    std::string name, equals;
    int size = 0;
    line >> name >> equals >> size;
    return std::clamp(size - 1, 1, 100'000);  // MaxArraySize is one more than the largest index
}

std::optional<Reports> ask(std::set<long> const& jobs) {
    Reports reports;
    if (jobs.empty()) return reports;
    std::string const all = fmt::format("{}", fmt::join(jobs, ","));
    Heard heard = squeue(all, reports);
    if (heard == Heard::unknown_job && jobs.size() > 1) {
        // Whether the other jobs were answered for is not certain: one by one.
        for (long const job : jobs) {
            heard = squeue(std::to_string(job), reports);
            if (heard == Heard::nothing) break;
        }
    }
    if (heard == Heard::nothing) return {};
    sacct(all, reports);
    return reports;
}

std::optional<long> find_by_name(std::string const& name) {
    Answer const answer = call({"squeue", "-h", "-t", "all", "-n", name, "-o", "%F"});
    if (answer.code != 0) {
        throw core::MissingError(
            fmt::format("Slurm does not answer ({}); try again when it does", first_line(answer.errors)));
    }
    return parse<long>(answer.output.substr(0, answer.output.find('\n')));
}

bool is_terminal(std::string const& state) {
    constexpr std::array<std::string_view, 10> states{"COMPLETED", "FAILED",        "CANCELLED", "TIMEOUT",
                                                      "NODE_FAIL", "OUT_OF_MEMORY", "PREEMPTED", "BOOT_FAIL",
                                                      "DEADLINE",  "REVOKED"};
    return std::ranges::find(states, state) != states.end();
}

}  // namespace vibrotrough::campaign::slurm
