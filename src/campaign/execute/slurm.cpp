#include "campaign/execute/slurm.hpp"

#include "core/error.hpp"
#include "core/text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <future>
#include <sstream>

#include <boost/process.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::campaign {
namespace {

namespace bp = boost::process;

/// What a command of Slurm answered.
struct Answer {
    int code;
    std::string output, errors;

    bool complains_of(std::string_view text) const { return errors.find(text) != std::string::npos; }
    /// Its first line of errors or, where it has none, of output.
    std::string words() const {
        std::string const& text = errors.empty() ? output : errors;
        return text.substr(0, text.find('\n')).substr(0, 300);
    }
};

/// Runs a command to its end, a minute at most. No shell reads the words.
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
        return {child.exit_code(), core::harmless(output.get()), core::harmless(errors.get())};
    } catch (bp::process_error const& error) {
        throw core::MissingError(fmt::format("cannot start {} ({})", words[1], error.code().message()));
    }
}

/// A question that must be answered.
std::string output_of(std::vector<std::string> words) {
    Answer const answer = call(std::move(words));
    if (answer.code == 0) return answer.output;
    throw core::MissingError(
        fmt::format("Slurm does not answer ({}); try again when it does", answer.words()));
}

/// The lines of a table, split at the separator, without the spaces around the parts.
std::vector<std::vector<std::string>> rows_of(std::string const& table, char separator) {
    std::vector<std::vector<std::string>> rows;
    std::istringstream lines(table);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream text(line);
        auto& parts = rows.emplace_back();
        for (std::string part; std::getline(text, part, separator);) parts.emplace_back(core::trimmed(part));
    }
    return rows;
}

/// The whole text as a number; nothing when it is not one.
std::optional<long> number_in(std::string_view text) {
    long number = 0;
    auto const [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (failure != std::errc() || end != text.data() + text.size()) return {};
    return number;
}

/// "[days-][[hours:]minutes:]seconds"; any other text means that there is no limit.
std::optional<long> minutes_in(std::string const& text) {
    auto const dash = text.find('-');
    long const days = dash == std::string::npos ? 0 : number_in(text.substr(0, dash)).value_or(0);
    long seconds = 0;
    auto const rows = rows_of(dash == std::string::npos ? text : text.substr(dash + 1), ':');
    for (std::string const& part : rows.empty() ? std::vector<std::string>{""} : rows.front()) {
        auto const number = number_in(part);
        if (!number) return {};
        seconds = 60 * seconds + *number;
    }
    return days * 24 * 60 + seconds / 60;
}

std::optional<long> find_by_name(std::string const& name) {
    std::string const output = output_of({"squeue", "-h", "-t", "all", "-n", name, "-o", "%F"});
    return number_in(output.substr(0, output.find('\n')));
}

TaskReport report_of(std::string const& state, std::string const& reason, std::string const& task) {
    using enum core::Outcome;
    constexpr std::array<std::string_view, 10> ends{"COMPLETED", "FAILED",        "CANCELLED", "TIMEOUT",
                                                    "NODE_FAIL", "OUT_OF_MEMORY", "PREEMPTED", "BOOT_FAIL",
                                                    "DEADLINE",  "REVOKED"};
    bool const has_reason = !reason.empty() && reason != "None";
    if (std::ranges::find(ends, state) == ends.end()) {
        bool const waits = state == "PENDING" || state == "CONFIGURING";
        return {waits ? TaskReport::waiting : TaskReport::running, interrupted,
                has_reason ? "waits in Slurm: " + reason : ""};
    }
    bool const is_late = state == "TIMEOUT" || state == "DEADLINE";
    return {TaskReport::ended,
            is_late ? time_limit : (state == "OUT_OF_MEMORY" ? out_of_memory : interrupted),
            fmt::format("Slurm says {}{} of task {}", state, has_reason ? " (" + reason + ")" : "", task)};
}

/// Lines "JOB_INDEX|state|reason" into the reports, none of which is replaced.
void read(std::string const& output, std::map<long, std::string> const& names, TaskReports& reports) {
    for (auto const& row : rows_of(output, '|')) {
        if (row.size() < 2) continue;
        auto const gap = std::min(row[0].find('_'), row[0].size());
        auto const job = number_in(row[0].substr(0, gap));
        auto const index = number_in(row[0].substr(std::min(gap + 1, row[0].size())));
        if (!job || !index || !names.contains(*job)) continue;
        // "CANCELLED by 0": the first word is the state.
        std::string const state = row[1].substr(0, row[1].find(' '));
        std::string const reason = row.size() > 2 ? row[2] : "";
        reports.insert({{names.at(*job), static_cast<int>(*index)}, report_of(state, reason, row[0])});
    }
}

std::string ids_of(std::map<long, std::string> const& names) {
    std::vector<long> ids;
    for (auto const& [id, name] : names) ids.push_back(id);
    return fmt::format("{}", fmt::join(ids, ","));
}

/// @return whether the controller answers
bool squeue(std::map<long, std::string> const& names, TaskReports& reports) {
    Answer const answer = call({"squeue", "-h", "-r", "-t", "all", "-j", ids_of(names), "-o", "%F_%K|%T|%r"});
    if (answer.code == 0) read(answer.output, names, reports);
    if (answer.code == 0) return true;
    // A purged id is an error of its own; anything else means that the controller does not answer.
    if (!answer.complains_of("Invalid job id")) return false;
    // Whether the other jobs were answered for is not certain: one by one.
    return names.size() == 1 || std::ranges::all_of(names, [&](auto& one) { return squeue({one}, reports); });
}

std::vector<std::string> submission(JobArray const& array) {
    scenario::BatchSettings const& asked = array.settings;
    std::string indices = fmt::format("0-{}", array.tasks - 1);
    if (asked.concurrent_tasks) indices += fmt::format("%{}", *asked.concurrent_tasks);
    std::vector<std::string> words{"sbatch", "--parsable", "--no-requeue", "--array=" + indices};
    words.push_back("--job-name=" + array.name);
    words.push_back("--chdir=" + array.folder.string());
    words.insert(words.end(), {"--open-mode=append", fmt::format("--output={}/task-%a.out", array.files)});
    words.insert(words.end(), {"--nodes=1", fmt::format("--ntasks={}", array.cores), "--cpus-per-task=1"});
    if (asked.partition) words.push_back("--partition=" + asked.partition->str());
    if (asked.account) words.push_back("--account=" + asked.account->str());
    if (asked.minutes) words.push_back(fmt::format("--time={}", *asked.minutes));
    if (asked.memory) words.push_back(fmt::format("--mem={}M", *asked.memory));
    for (scenario::BatchOption const& option : asked.extra) words.push_back(option.str());
    words.push_back((array.folder / array.files / "job.sh").string());
    return words;
}

/// Slurm takes a job that is too long for its partition, and lets it wait for ever.
void check_time(scenario::BatchSettings const& asked) {
    for (auto const& row : rows_of(call({"sinfo", "-h", "-o", "%P|%l"}).output, '|')) {
        if (row.size() != 2) continue;
        bool const is_default = row[0].ends_with('*');
        std::string const name = row[0].substr(0, row[0].size() - (is_default ? 1 : 0));
        if (!(asked.partition ? asked.partition->str() == name : is_default)) continue;
        auto const most = minutes_in(row[1]);
        if (!asked.minutes || !most || *asked.minutes <= *most) continue;
        throw core::MissingError(fmt::format(
            "Slurm's partition {} has a limit of {} minutes, and run.slurm.time asks for {}{}; ask for less, "
            "or for another partition",
            name, *most, *asked.minutes,
            asked.minutes_per_task ? " for the largest task of several packings" : ""));
    }
}

int most_array_tasks() {
    for (auto const& row : rows_of(output_of({"scontrol", "show", "config"}), '=')) {
        // MaxArraySize is one more than the largest index.
        if (row.size() == 2 && row[0] == "MaxArraySize")
            return static_cast<int>(std::clamp(number_in(row[1]).value_or(1001) - 1, 1L, 100'000L));
    }
    return 1000;
}

}  // namespace

std::optional<TaskReports> ask_slurm(std::vector<SubmittedArray>& arrays) {
    std::map<long, std::string> names;
    for (SubmittedArray& array : arrays) {
        if (!array.job) array.job = find_by_name(array.name);
        if (array.job) names.emplace(*array.job, array.name);
    }
    TaskReports reports;
    if (names.empty()) return reports;
    if (!squeue(names, reports)) return {};
    if (bp::search_path("sacct").empty()) return reports;
    // Fails where there is no accounting; then nothing more is known.
    Answer const past =
        call({"sacct", "-n", "-P", "-X", "-a", "-j", ids_of(names), "-o", "JobID,State,Reason"});
    if (past.code == 0) read(past.output, names, reports);
    return reports;
}

Submission submit_to_slurm(JobArray const& array) {
    if (int const most = most_array_tasks(); array.tasks > most) return {{}, most};
    check_time(array.settings);
    std::vector<std::string> words = submission(array);
    words.insert(words.begin() + 1, "--test-only");
    Answer answer = call(words);
    bool const is_taken = answer.code == 0;
    words.erase(words.begin() + 1);
    if (is_taken) answer = call(words);
    auto const job = number_in(answer.output.substr(0, answer.output.find_first_of(";\n")));
    if (is_taken && answer.code == 0 && job) return {job, {}};
    // Slurm keeps MaxJobCount jobs, each task of an array counts as one, and one that has ended counts until
    // MinJobAge has passed. sbatch --test-only says the first of these texts, sbatch itself the second. It
    // tries again by itself, and may have been ended by our time limit just after it succeeded.
    if (answer.complains_of("Resource temporarily unavailable") ||
        answer.complains_of("temporarily unable to accept job"))
        return {is_taken ? find_by_name(array.name) : std::nullopt, {}};
    throw core::MissingError(
        fmt::format("Slurm does not take the job ({}); see [run.slurm] in the campaign "
                    "file, and sinfo for what there is",
                    answer.words()));
}

void cancel_in_slurm(SubmittedArray const& array, std::vector<int> const& tasks) {
    if (array.job)
        call({"scancel", "--state=PENDING", fmt::format("{}_[{}]", *array.job, fmt::join(tasks, ","))});
}

}  // namespace vibrotrough::campaign
