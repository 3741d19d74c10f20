#include "campaign/execute/batch.hpp"

#include "campaign/state/campaign_folder.hpp"
#include "campaign/state/notes.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/parallel.hpp"
#include "core/shell.hpp"
#include "core/time.hpp"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace vibrotrough::campaign {
namespace {

namespace fs = std::filesystem;
using core::note::Json;

std::optional<Batch> read_batch(fs::path const& folder) {
    try {
        BatchNote const note = parse_batch(core::read_file(folder / "batch.json", core::largest_note));
        Batch batch{folder, note.name, note.job, {}};
        auto tasks = read_task_list(folder / "tasks.txt");
        if (!tasks) return {};
        batch.tasks = std::move(*tasks);
        return batch;
    } catch (core::Error const&) {
        return {};
    }
}

/// The lines of the key setup, and what ends the task when one of them fails. A login shell knows `module`.
std::string setup_lines(std::vector<std::string> const& lines) {
    std::string text;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        text += fmt::format(
            "{}\n"
            "code=$?; [ \"$code\" = 0 ] || {{ echo \"line {} of run.slurm.setup ended with exit code $code\" "
            ">&2;\n"
            "    mark \"task-$index.ended\" \"$code\"; exit \"$code\"; }}\n",
            lines[i], i + 1);
    }
    return text;
}

/// Runs `work` as often as engines are to run at the same time. All go through the same list: the lock of a
/// packing, which only one process gets, says who takes it, and whoever is done takes the next. `wait` ends
/// early when a signal comes; where the process has ended by then, a second `wait` has its exit code (127
/// where the first one had it already).
///
/// A task that is warned hands the warning on: each engine ends its cycle and writes a checkpoint. Then the
/// task is queued again, without a marker that it ended.
std::string work_lines(std::string const& work, JobScript const& job) {
    if (job.engines == 1 && !job.is_warned) return work + "\ncode=$?\n";
    std::string lines = fmt::format(
        "code=0\n"
        "warned=\n"
        "set --\n"
        "trap 'warned=yes; kill -TERM \"$@\" 2>/dev/null' USR1\n"
        "while [ $# -lt {} ]; do {} & set -- \"$@\" $!; done\n"
        "[ -z \"$warned\" ] || kill -TERM \"$@\" 2>/dev/null\n"  // warned before it knew whom to tell
        "for process; do\n"
        "    while wait \"$process\"; one=$?; kill -0 \"$process\" 2>/dev/null; do :; done\n"
        "    wait \"$process\" 2>/dev/null; last=$?; [ \"$last\" = 127 ] || one=$last\n"
        "    [ \"$one\" -le \"$code\" ] || code=$one\n"
        "done\n",
        job.engines, work);
    if (job.is_warned) {
        // The scheduler ends the task that it queues again, and with it the command that asked for this,
        // which then would count as refused: the command inherits that the signal is ignored.
        lines +=
            "trap '' TERM\n"
            "if [ -n \"$warned\" ] && [ \"$code\" = 130 ] &&\n"
            "    scontrol requeue ${SLURM_ARRAY_JOB_ID}_$index; then exit 0; fi\n"
            "trap : TERM\n";
    }
    return lines;
}

/// Only numbers, paths of this machine as words of the shell, and Slurm's own variables enter the script; and
/// the lines of the key setup, which the user has allowed.
std::string job_script(Batch const& batch, JobScript const& job) {
    std::string options = fmt::format("--ranks {} --retries {}", job.ranks, job.retries);
    if (job.allow_extra) options += " --allow-extra";
    if (job.is_learning) options += " --learning";
    if (job.time_limit) options += fmt::format(" --time-limit {:.0f}", *job.time_limit);
    std::string const files = "slurm/" + batch.folder.filename().string();
    std::string const work = fmt::format("{} work . --task-list {}/tasks.txt --index \"$index\" {}",
                                         core::shell_word(job.program), files, options);
    return fmt::format(
        "{first}\n"
        "# A task of a job array of Slurm: packings of a campaign. Made by vibrotrough run.\n"
        "# The files task-* say how far it came.\n"
        "trap : TERM INT USR1\n"
        "cd {folder} || exit 3\n"
        "index=${{SLURM_ARRAY_TASK_ID:?}}\n"
        "mark() {{ printf '%s\\n' \"$2\" > \"{files}/.$1\" && mv -f \"{files}/.$1\" \"{files}/$1\"; }}\n"
        "[ -f {files}/tasks.txt ] || {{ echo \"$PWD is not the campaign's folder\" >&2; exit 3; }}\n"
        "rm -f \"{files}/task-$index.ended\"\n"  // when it is queued again
        "mark \"task-$index.started\" \"$(uname -n) $SLURM_ARRAY_JOB_ID\"\n"
        "{setup}"
        "{work}"
        "mark \"task-$index.ended\" \"$code\"\n"
        "exit \"$code\"\n",
        fmt::arg("first", job.setup.empty() ? "#!/bin/sh" : "#!/bin/bash -l"),
        fmt::arg("folder", core::shell_word(batch.folder.parent_path().parent_path())),
        fmt::arg("files", files), fmt::arg("setup", setup_lines(job.setup)),
        fmt::arg("work", work_lines(work, job)));
}

void write_description(Batch const& batch) {
    Json json{{"name", batch.name}};
    if (batch.job) json["job"] = *batch.job;
    core::write_file_atomically(batch.folder / "batch.json", json.dump(2) + "\n");
}

/// The markers of a batch: one listing instead of a question for each task.
std::set<std::string> names_of_markers(Batch const& batch) {
    std::set<std::string> names;
    std::error_code missing;
    for (auto const& entry : fs::directory_iterator(batch.folder, missing))
        names.insert(entry.path().filename().string());
    return names;
}

/// What the marker says that a task writes at its end; none while it has none.
std::optional<TaskActivity> by_marker(Batch const& batch, std::size_t index,
                                      std::set<std::string> const& names) {
    std::string const name = fmt::format("task-{}.ended", index);
    if (!names.contains(name)) return {};
    std::string const code = core::read_file(batch.folder / name, core::largest_note);
    return TaskActivity{
        PackingActivity::ended, core::Outcome::interrupted,
        fmt::format("the task ended with exit code {}; see {}", code.substr(0, code.find('\n')),
                    (batch.folder / fmt::format("task-{}.out", index)).string())};
}

/// @param reports  asked for before the names were listed, so that a task that Slurm calls ended has its
/// marker
TaskActivity activity_of(Batch const& batch, std::size_t index, TaskReports const& reports,
                         std::set<std::string> const& names) {
    if (auto const marked = by_marker(batch, index, names)) return *marked;
    auto const found = reports.find({batch.name, static_cast<int>(index)});
    if (found == reports.end()) {
        return {
            PackingActivity::ended, core::Outcome::interrupted,
            batch.job
                ? fmt::format("Slurm no longer knows task {} of job {}, which ended without writing its "
                              "exit marker",
                              index, *batch.job)
                : fmt::format("Slurm knows no job {}: the run ended before it was submitted", batch.name)};
    }
    TaskReport const& report = found->second;
    if (report.state == TaskReport::ended) return {PackingActivity::ended, report.outcome, report.message};
    bool const waits = report.state == TaskReport::waiting;
    return {waits ? PackingActivity::waiting : PackingActivity::running, {}, report.message};
}

/// Asks Slurm once for all tasks that have no marker.
/// @param open  the numbers of their batches
/// @return nothing when there is no Slurm here, or it does not answer
std::optional<TaskReports> ask(std::vector<Batch>& batches, std::set<std::size_t> const& open) {
    std::vector<SubmittedArray> arrays;
    for (std::size_t const i : open) arrays.push_back({batches[i].name, batches[i].job});
    try {
        auto reports = ask_slurm(arrays);
        std::size_t k = 0;
        for (std::size_t const i : open) batches[i].job = arrays[k++].job;
        return reports;
    } catch (core::MissingError const&) {
        return {};
    }
}

}  // namespace

std::vector<Batch> read_batches(fs::path const& campaign_folder) {
    std::vector<Batch> batches;
    fs::path const all = campaign_folder / "slurm";
    if (!fs::is_directory(all)) return batches;
    std::vector<fs::path> folders;
    for (auto const& entry : fs::directory_iterator(all)) folders.push_back(entry.path());
    std::ranges::sort(folders);
    for (fs::path const& folder : folders) {
        if (auto batch = read_batch(folder)) batches.push_back(std::move(*batch));
    }
    return batches;
}

Batch write_batch(fs::path const& campaign_folder, std::vector<Task> const& tasks, JobScript const& script) {
    fs::path const all = fs::absolute(campaign_folder) / "slurm";
    int number = 1;
    while (fs::exists(all / fmt::format("{:04}", number))) ++number;
    std::string const label = fmt::format("{:04}", number);
    std::string const unique =
        fmt::format("{} {} {} {}", all.parent_path().string(), label, core::utc_now(), ::getpid());
    Batch batch{all / label, "vibrotrough-" + core::sha256_hex(unique).substr(0, 12), {}, tasks};
    core::make_folder(batch.folder);
    core::write_file_atomically(batch.folder / "tasks.txt", write_task_list(tasks));
    core::write_file_atomically(batch.folder / "job.sh", job_script(batch, script));
    write_description(batch);
    return batch;
}

void remember_job(Batch& batch, long job) {
    batch.job = job;
    write_description(batch);
}

std::vector<std::vector<TaskActivity>> survey_tasks(std::vector<Batch>& batches) {
    std::vector<std::vector<TaskActivity>> activities;
    std::set<std::size_t> open;
    for (std::size_t i = 0; i < batches.size(); ++i) {
        auto const names = names_of_markers(batches[i]);
        std::vector<std::optional<TaskActivity>> marked(batches[i].tasks.size());
        core::for_each_index(marked.size(), cases_per_thread, [&] {
            return [&](std::size_t k) { marked[k] = by_marker(batches[i], k, names); };
        });
        auto& tasks = activities.emplace_back();
        for (auto const& one : marked) {
            if (!one) open.insert(i);
            tasks.push_back(
                one.value_or(TaskActivity{PackingActivity::unknown, {}, "Slurm does not answer"}));
        }
    }
    if (open.empty()) return activities;
    auto const reports = ask(batches, open);
    if (!reports) return activities;
    for (std::size_t const i : open) {
        auto const names = names_of_markers(batches[i]);
        for (std::size_t k = 0; k < activities[i].size(); ++k) {
            if (activities[i][k].state == PackingActivity::unknown)
                activities[i][k] = activity_of(batches[i], k, *reports, names);
        }
    }
    return activities;
}

std::vector<PackingActivity> survey_packings(std::filesystem::path const& campaign_folder) {
    std::vector<Batch> batches = read_batches(campaign_folder);
    auto const activities = survey_tasks(batches);
    std::map<PackingId, PackingActivity> newest;
    for (std::size_t i = 0; i < batches.size(); ++i) {
        for (std::size_t k = 0; k < batches[i].tasks.size(); ++k) {
            auto const& [state, outcome, message] = activities[i][k];
            for (PackingId const& id : batches[i].tasks[k])
                newest.insert_or_assign(id, PackingActivity{id, state, outcome, message});
        }
    }
    std::vector<PackingActivity> all;
    for (auto& [id, activity] : newest) all.push_back(std::move(activity));
    return all;
}

}  // namespace vibrotrough::campaign
