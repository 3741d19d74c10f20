#include "campaign/execute/scheduler.hpp"
#include "campaign/execute/scheduler_call.hpp"
#include "core/text.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::campaign {
namespace {

CallAnswer call(std::vector<std::string> words) {
    return call_scheduler("Slurm", std::move(words));
}

std::optional<long> find_by_name(std::string const& name) {
    CallAnswer const answer = call_or_throw("Slurm", {"squeue", "-h", "-t", "all", "-n", name, "-o", "%F"});
    return number_in<long>(answer.output.substr(0, answer.output.find('\n')));
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
        auto const job = number_in<long>(row[0].substr(0, gap));
        auto const index = number_in<int>(row[0].substr(std::min(gap + 1, row[0].size())));
        if (!job || !index || !names.contains(*job)) continue;
        // "CANCELLED by 0": the first word is the state.
        std::string const state = row[1].substr(0, row[1].find(' '));
        std::string const reason = row.size() > 2 ? row[2] : "";
        reports.insert({{names.at(*job), *index}, report_of(state, reason, row[0])});
    }
}

/// @return whether the controller answers
bool squeue(std::map<long, std::string> const& names, TaskReports& reports) {
    std::string const jobs = ids_of(names);
    CallAnswer const answer = call({"squeue", "-h", "-r", "-t", "all", "-j", jobs, "-o", "%F_%K|%T|%r"});
    if (answer.code == 0) read(answer.output, names, reports);
    if (answer.code == 0) return true;
    // A purged id is an error of its own; anything else means that the controller does not answer.
    if (!answer.complains_of({"Invalid job id"})) return false;
    // Whether the other jobs were answered for is not certain: one by one.
    return names.size() == 1 || std::ranges::all_of(names, [&](auto& one) { return squeue({one}, reports); });
}

std::optional<TaskReports> ask(std::vector<SubmittedArray>& arrays) {
    auto const names = name_by_id(arrays, find_by_name);
    TaskReports reports;
    if (names.empty()) return reports;
    if (!squeue(names, reports)) return {};
    if (!has_command("sacct")) return reports;
    std::string const jobs = ids_of(names);
    // Fails where there is no accounting; then nothing more is known.
    CallAnswer const past = call({"sacct", "-n", "-P", "-X", "-a", "-j", jobs, "-o", "JobID,State,Reason"});
    if (past.code == 0) read(past.output, names, reports);
    return reports;
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
        if (asked.partition ? asked.partition->str() == name : is_default)
            check_time_limit("run.slurm", "Slurm's partition " + name, row[1], asked);
    }
}

int most_array_tasks() {
    for (auto const& row : rows_of(call_or_throw("Slurm", {"scontrol", "show", "config"}).output, '=')) {
        if (row.size() != 2 || row[0] != "MaxArraySize") continue;
        // MaxArraySize is one more than the largest index.
        return std::clamp(number_in<int>(core::trimmed(row[1])).value_or(1001) - 1, 1, 100'000);
    }
    return 1000;
}

Submission submit(JobArray const& array) {
    if (int const most = most_array_tasks(); array.tasks > most) return {{}, most};
    check_time(array.settings);
    // Slurm keeps MaxJobCount jobs, each task of an array counts as one, and one that has ended counts until
    // MinJobAge has passed. sbatch --test-only says the first of these texts, sbatch itself the second.
    auto const has_no_room = [](CallAnswer const& answer) {
        return answer.complains_of({"Resource temporarily unavailable", "temporarily unable to accept job"});
    };
    std::vector<std::string> words = submission(array);
    words.insert(words.begin() + 1, "--test-only");
    CallAnswer answer = call(words);
    bool const is_taken = answer.code == 0;
    words.erase(words.begin() + 1);
    if (is_taken) answer = call(words);
    auto const job = number_in<long>(answer.output.substr(0, answer.output.find_first_of(";\n")));
    if (is_taken && answer.code == 0 && job) return {job, {}};
    // sbatch tries again by itself, and may have been ended by our time limit just after it succeeded.
    if (has_no_room(answer)) return {is_taken ? find_by_name(array.name) : std::nullopt, {}};
    throw refusal("Slurm", answer, "[run.slurm] in the campaign file, and sinfo for what there is");
}

void cancel(SubmittedArray const& array, std::vector<int> const& tasks) {
    if (array.job)
        call({"scancel", "--state=PENDING", fmt::format("{}_[{}]", *array.job, fmt::join(tasks, ","))});
}

/// -D: also what a task took before it was queued again.
std::optional<double> count_core_time(std::vector<SubmittedArray>& arrays) {
    auto const names = name_by_id(arrays, find_by_name);
    if (names.empty()) return 0;
    if (!has_command("sacct")) return {};
    CallAnswer const answer =
        call({"sacct", "-n", "-P", "-X", "-a", "-D", "-j", ids_of(names), "-o", "JobID,JobName,CPUTimeRAW"});
    if (answer.code != 0) return {};
    std::optional<double> sum;
    std::set<std::string> known;
    for (auto const& row : rows_of(answer.output, '|')) {
        if (row.size() != 3) continue;
        // Numbers of jobs may begin anew, so that a job of somebody else may have had the same one.
        auto const job = number_in<long>(row[0].substr(0, row[0].find('_')));
        auto const name = job ? names.find(*job) : names.end();
        if (name == names.end() || name->second != row[1]) continue;
        sum = sum.value_or(0) + static_cast<double>(number_in<long>(row[2]).value_or(0));
        known.insert(row[1]);
    }
    for (SubmittedArray& array : arrays) array.is_counted = known.contains(array.name);
    return sum;
}

}  // namespace

constexpr Requeueing again{"--requeue", "--signal=B:USR1@", "scontrol requeue ${SLURM_ARRAY_JOB_ID}_$index"};
constinit Scheduler const slurm{
    "slurm", "Slurm",        "${SLURM_ARRAY_TASK_ID:?}", "$SLURM_ARRAY_JOB_ID", again, submit, ask,
    cancel,  count_core_time};

}  // namespace vibrotrough::campaign
