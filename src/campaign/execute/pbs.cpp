#include "campaign/execute/scheduler.hpp"
#include "campaign/execute/scheduler_call.hpp"
#include "core/text.hpp"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

// PBS Professional and OpenPBS, by their manual pages qsub(1B), qstat(1B), qselect(1B) and qdel(1B). What the
// pages do not say comes from users' reports: an array of one task is refused, and so is one that must not be
// run again.

namespace vibrotrough::campaign {
namespace {

CallAnswer call(std::vector<std::string> words, std::filesystem::path const& folder = {}) {
    return call_scheduler("PBS", std::move(words), folder);
}

/// The number that begins "123.server", "123[].server" and "123[4].server".
std::optional<long> job_number(std::string_view id) {
    return number_in<long>(id.substr(0, id.find_first_not_of("0123456789")));
}

/// The index in "123[4].server"; 0 for "123.server", a job of one task; nothing for "123[].server".
std::optional<int> task_index(std::string_view id) {
    auto const open = id.find('['), close = id.find(']');
    if (open == id.npos) return 0;
    return close == id.npos ? std::nullopt : number_in<int>(id.substr(open + 1, close - open - 1));
}

std::optional<long> find_by_name(std::string const& name) {
    CallAnswer const answer = call_or_throw("PBS", {"qselect", "-N", name});
    return job_number(answer.output);
}

/// What `qstat -f` says of one job or task.
struct Listed {
    std::string id, state, comment;
    std::optional<int> exit_status;
};

/// "Job Id: ID", and then "    NAME = VALUE" in a line each; a line that begins with a tab goes on.
std::vector<Listed> read(std::string const& output) {
    std::vector<Listed> jobs;
    std::istringstream lines(output);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("Job Id: ")) jobs.push_back({line.substr(8), "", "", {}});
        auto const equals = line.find(" = ");
        if (jobs.empty() || !line.starts_with("    ") || equals == line.npos) continue;
        std::string_view const name = core::trimmed(std::string_view(line).substr(0, equals));
        std::string const value = line.substr(equals + 3);
        if (name == "job_state") jobs.back().state = value;
        if (name == "comment") jobs.back().comment = value;
        if (name == "Exit_status") jobs.back().exit_status = number_in<int>(value);
    }
    return jobs;
}

TaskReport report_of(Listed const& job) {
    using enum core::Outcome;
    if (job.state != "F" && job.state != "X") {
        bool const runs = job.state == "R" || job.state == "E" || job.state == "S" || job.state == "U";
        return {runs ? TaskReport::running : TaskReport::waiting, interrupted,
                runs || job.comment.empty() ? "" : "waits in PBS: " + job.comment};
    }
    int const status = job.exit_status.value_or(0);
    // JOB_EXEC_KILL_WALLTIME; _KILL_VMEM and _KILL_MEM
    auto const outcome = status == -29                    ? time_limit
                         : status == -26 || status == -27 ? out_of_memory
                                                          : interrupted;
    std::string const code = job.exit_status ? fmt::format(" (Exit_status {})", status) : "";
    return {TaskReport::ended, outcome, fmt::format("PBS says {}{} of task {}", job.state, code, job.id)};
}

/// @return whether the server answered for each job, if only that it does not know it
bool take_in(CallAnswer const& answer, std::map<long, std::string> const& names, TaskReports& reports) {
    for (Listed const& job : read(answer.output)) {
        auto const number = job_number(job.id);
        auto const index = task_index(job.id);
        if (number && index && names.contains(*number))
            reports.insert({{names.at(*number), *index}, report_of(job)});
    }
    return answer.code == 0 || answer.complains_only_of({"Unknown Job Id", "Job has finished"});
}

std::optional<TaskReports> ask(std::vector<SubmittedArray>& arrays) {
    auto const names = name_by_id(arrays, find_by_name);
    TaskReports reports;
    if (names.empty()) return reports;
    std::vector<std::string> words{"qstat", "-f", "-t"};
    for (SubmittedArray const& array : arrays) {
        if (array.job) words.push_back(fmt::format("{}{}", *array.job, array.tasks > 1 ? "[]" : ""));
    }
    CallAnswer const now = call(words);
    if (!take_in(now, names, reports)) return {};
    // A server that keeps no history refuses -x.
    if (!now.complains_of({"Job has finished"})) return reports;
    words.insert(words.begin() + 1, "-x");
    return take_in(call(words), names, reports) ? std::optional(reports) : std::nullopt;
}

std::vector<std::string> submission(JobArray const& array) {
    scenario::BatchSettings const& asked = array.settings;
    std::vector<std::string> words{"qsub", "-N", array.name, "-r", "y", "-j", "oe", "-o"};
    words.push_back(array.files + (array.tasks > 1 ? "/task-^array_index^.out" : "/task-0.out"));
    if (array.tasks > 1) words.insert(words.end(), {"-J", fmt::format("0-{}", array.tasks - 1)});
    if (array.tasks > 1 && asked.concurrent_tasks)
        words.insert(words.end(), {"-W", fmt::format("max_run_subjobs={}", *asked.concurrent_tasks)});
    std::string chunk = fmt::format("select=1:ncpus={0}:mpiprocs={0}", array.cores);
    if (asked.memory) chunk += fmt::format(":mem={}mb", *asked.memory);
    words.insert(words.end(), {"-l", chunk});
    if (asked.minutes)
        words.insert(words.end(),
                     {"-l", fmt::format("walltime={}:{:02}:00", *asked.minutes / 60, *asked.minutes % 60)});
    if (asked.partition) words.insert(words.end(), {"-q", asked.partition->str()});
    if (asked.account) words.insert(words.end(), {"-A", asked.account->str()});
    for (scenario::BatchOption const& option : asked.extra) words.push_back(option.str());
    words.push_back(array.files + "/job.sh");
    return words;
}

Submission submit(JobArray const& array) {
    CallAnswer const answer = call(submission(array), array.folder);
    if (auto const job = job_number(answer.output); answer.code == 0 && job) return {job, {}};
    // max_array_size of the server or the queue, which is asked for by trying.
    if (answer.complains_of({"Array job exceeds server or queue size limit"})) return {{}, array.tasks / 2};
    if (answer.complains_of({"would exceed", "Maximum number of jobs already in queue"})) return {};
    constexpr int was_ended = 124;  // by our own limit, perhaps just after it succeeded
    if (answer.code == was_ended) return {find_by_name(array.name), {}};
    throw refusal("PBS", answer, "[run.pbs] in the campaign file, and qstat -Q for the queues");
}

void cancel(SubmittedArray const& array, std::vector<int> const& tasks) {
    if (!array.job) return;
    std::vector<std::string> words{"qdel"};
    for (int const index : tasks)
        words.push_back(array.tasks > 1 ? fmt::format("{}[{}]", *array.job, index)
                                        : std::to_string(*array.job));
    call(words);
}

}  // namespace

constinit Scheduler const pbs{"pbs", "PBS", "${PBS_ARRAY_INDEX:-0}", "${PBS_JOBID%%[!0-9]*}", {}, submit,
                              ask,   cancel};

}  // namespace vibrotrough::campaign
