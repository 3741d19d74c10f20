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
#include <sstream>

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
std::string setup_lines(Scheduler const& scheduler, std::vector<std::string> const& lines) {
    std::string text;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        text += fmt::format(
            "{}\n"
            "code=$?; [ \"$code\" = 0 ] || {{ echo \"line {} of run.{}.setup ended with exit code $code\" "
            ">&2;\n"
            "    mark \"task-$index.ended\" \"$code\"; exit \"$code\"; }}\n",
            lines[i], i + 1, scheduler.name);
    }
    return text;
}

/// Runs `work` as often as engines are to run at the same time. All go through the same list: the lock of a
/// packing, which only one process gets, says who takes it, and whoever is done takes the next. `wait` ends
/// early when a signal comes.
///
/// A task that is warned hands the warning on: each engine ends its cycle and writes a checkpoint. Then the
/// task is queued again, without a marker that it ended.
std::string work_lines(Scheduler const& scheduler, std::string const& work, JobScript const& job) {
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
        "    [ \"$one\" -le \"$code\" ] || code=$one\n"
        "done\n",
        job.engines, work);
    if (job.is_warned) {
        // The scheduler ends the task that it queues again, and with it the command that asked for this,
        // which then would count as refused: the command inherits that the signal is ignored.
        lines += fmt::format(
            "trap '' TERM\n"
            "if [ -n \"$warned\" ] && [ \"$code\" = 130 ] && {}; then exit 0; fi\n"
            "trap : TERM\n",
            scheduler.requeueing.command);
    }
    return lines;
}

/// Only numbers, paths of this machine as words of the shell, and the scheduler's own variables enter the
/// script; and the lines of the key setup, which the user has allowed.
std::string job_script(Scheduler const& scheduler, Batch const& batch, JobScript const& job) {
    std::string options = fmt::format("--ranks {} --retries {}", job.ranks, job.retries);
    if (job.allow_extra) options += " --allow-extra";
    if (job.time_limit) options += fmt::format(" --time-limit {:.0f}", *job.time_limit);
    std::string const files = fmt::format("{}/{}", scheduler.name, batch.folder.filename().string());
    std::string const work = fmt::format("{} work . --task-list {}/tasks.txt --index \"$index\" {}",
                                         core::shell_word(job.program), files, options);
    return fmt::format(
        "{first}\n"
        "# A task of a job array of {title}: packings of a campaign. Made by vibrotrough run.\n"
        "# The files task-* say how far it came.\n"
        "trap : TERM INT USR1\n"
        "cd {folder} || exit 3\n"
        "index={index}\n"
        "mark() {{ rm -f \"{files}/.$1\" && ( set -C; printf '%s\\n' \"$2\" > \"{files}/.$1\" ) &&\n"
        "    mv -fT \"{files}/.$1\" \"{files}/$1\"; }}\n"
        "[ -f {files}/tasks.txt ] || {{ echo \"$PWD is not the campaign's folder\" >&2; exit 3; }}\n"
        "rm -f \"{files}/task-$index.ended\" \"{files}/task-$index.lost\"\n"  // when it is queued again
        "mark \"task-$index.started\" \"$(uname -n) {job}\"\n"
        "{setup}"
        "{work}"
        "mark \"task-$index.ended\" \"$code\"\n"
        "exit \"$code\"\n",
        fmt::arg("first", job.setup.empty() ? "#!/bin/sh" : "#!/bin/bash -l"),
        fmt::arg("title", scheduler.title),
        fmt::arg("folder", core::shell_word(batch.folder.parent_path().parent_path())),
        fmt::arg("index", scheduler.task_index), fmt::arg("job", scheduler.job_id), fmt::arg("files", files),
        fmt::arg("setup", setup_lines(scheduler, job.setup)),
        fmt::arg("work", work_lines(scheduler, work, job)));
}

void write_description(Batch const& batch) {
    Json json{{"name", batch.name}};
    if (batch.job) json["job"] = *batch.job;
    core::write_file_atomically(batch.folder / "batch.json", json.dump(2) + "\n");
}

fs::path marker(Batch const& batch, std::size_t index, char const* kind) {
    return batch.folder / fmt::format("task-{}.{}", index, kind);
}

/// Names of markers in a batch's folder: one question instead of one for each task.
using MarkerNames = std::set<std::string>;

MarkerNames names_of_markers(Batch const& batch) {
    MarkerNames names;
    std::error_code missing;
    for (auto const& entry : fs::directory_iterator(batch.folder, missing))
        names.insert(entry.path().filename().string());
    return names;
}

/// What the markers say of a task; none while it has no marker that it ended.
std::optional<TaskActivity> by_marker(Batch const& batch, std::size_t index, MarkerNames const& names) {
    TaskActivity activity{PackingActivity::ended, core::Outcome::interrupted, {}};
    auto const is_there = [&](fs::path const& file) {
        return names.contains(file.filename().string()) && fs::is_regular_file(file);
    };
    if (is_there(marker(batch, index, "ended"))) {
        std::string const code = core::read_file(marker(batch, index, "ended"), core::largest_note);
        activity.message = fmt::format("the task ended with exit code {}; see {}",
                                       code.substr(0, code.find('\n')), marker(batch, index, "out").string());
        return activity;
    }
    fs::path const lost = marker(batch, index, "lost");
    if (!is_there(lost)) return {};
    try {
        LostTask const task = parse_lost_task(core::read_file(lost, core::largest_note));
        activity.outcome = task.outcome;
        activity.message = task.message;
    } catch (core::note::Fault const& fault) {
        activity.message = fmt::format("{} is damaged: {}", lost.string(), fault.what());
    }
    return activity;
}

/// The id that the tasks of a batch have written down, when its driver died before it did so.
void find_lost_id(Batch& batch) {
    if (batch.job) return;
    MarkerNames const names = names_of_markers(batch);
    for (std::size_t i = 0; i < batch.tasks.size(); ++i) {
        fs::path const started = marker(batch, i, "started");
        if (!names.contains(started.filename().string()) || !fs::is_regular_file(started)) continue;
        std::istringstream text(core::read_file(started, core::largest_note));
        std::string host;
        if (long job = 0; text >> host >> job) batch.job = job;
        return;
    }
}

/// @param reports  asked for before this call and the listing, so that a task that the scheduler calls ended
/// has its marker
TaskActivity activity_of(Scheduler const& scheduler, Batch const& batch, std::size_t index,
                         TaskReports const& reports, MarkerNames const& names) {
    if (auto const marked = by_marker(batch, index, names)) return *marked;
    auto const found = reports.find({batch.name, static_cast<int>(index)});
    if (found == reports.end()) {
        return {
            PackingActivity::ended, core::Outcome::interrupted,
            fmt::format("{} no longer knows task {} of job {}, which ended without writing its exit marker",
                        scheduler.title, index, batch.job.value_or(0))};
    }
    TaskReport const& report = found->second;
    if (report.state == TaskReport::ended) return {PackingActivity::ended, report.outcome, report.message};
    bool const waits = report.state == TaskReport::waiting;
    return {waits ? PackingActivity::waiting : PackingActivity::running, {}, report.message};
}

/// A task that has no marker that it ended.
struct OpenTask {
    std::size_t batch, index;
};

/// Asks the scheduler once for all tasks that are open.
/// @return nothing when there is none here, or it does not answer
std::optional<TaskReports> ask(Scheduler const& scheduler, std::vector<Batch>& batches,
                               std::vector<OpenTask> const& open) {
    try {
        std::set<std::size_t> asked;
        for (OpenTask const& task : open) asked.insert(task.batch);
        std::vector<SubmittedArray> arrays;
        for (std::size_t const i : asked) {
            find_lost_id(batches[i]);
            arrays.push_back({batches[i].name, batches[i].job, static_cast<int>(batches[i].tasks.size())});
        }
        auto reports = scheduler.ask(arrays);
        std::size_t k = 0;
        for (std::size_t const i : asked) batches[i].job = arrays[k++].job;
        return reports;
    } catch (core::MissingError const&) {
        return {};
    }
}

}  // namespace

std::vector<Batch> read_batches(Scheduler const& scheduler, fs::path const& campaign_folder) {
    std::vector<Batch> batches;
    fs::path const all = campaign_folder / scheduler.name;
    if (!fs::is_directory(all)) return batches;
    std::vector<fs::path> folders;
    for (auto const& entry : fs::directory_iterator(all)) folders.push_back(entry.path());
    std::ranges::sort(folders);
    for (fs::path const& folder : folders) {
        if (auto batch = read_batch(folder)) batches.push_back(std::move(*batch));
    }
    return batches;
}

Batch write_batch(Scheduler const& scheduler, fs::path const& campaign_folder, std::vector<Task> const& tasks,
                  JobScript const& script) {
    fs::path const all = fs::absolute(campaign_folder) / scheduler.name;
    int number = 1;
    while (fs::exists(all / fmt::format("{:04}", number))) ++number;
    std::string const label = fmt::format("{:04}", number);
    std::string const unique =
        fmt::format("{} {} {} {}", all.parent_path().string(), label, core::utc_now(), ::getpid());
    Batch batch{all / label, "vibrotrough-" + core::sha256_hex(unique).substr(0, 12), {}, tasks};
    core::make_folder(batch.folder);
    core::write_file_atomically(batch.folder / "tasks.txt", write_task_list(tasks));
    core::write_file_atomically(batch.folder / "job.sh", job_script(scheduler, batch, script));
    write_description(batch);
    return batch;
}

void remember_job(Batch& batch, long job) {
    batch.job = job;
    write_description(batch);
}

std::vector<std::vector<TaskActivity>> survey_tasks(Scheduler const& scheduler, std::vector<Batch>& batches) {
    TaskActivity const no_answer{
        PackingActivity::unknown, {}, fmt::format("{} does not answer", scheduler.title)};
    std::vector<std::vector<TaskActivity>> activities;
    std::vector<OpenTask> open;
    for (std::size_t i = 0; i < batches.size(); ++i) {
        MarkerNames const names = names_of_markers(batches[i]);
        std::vector<std::optional<TaskActivity>> marked(batches[i].tasks.size());
        core::for_each_index(marked.size(), cases_per_thread, [&] {
            return [&](std::size_t k) { marked[k] = by_marker(batches[i], k, names); };
        });
        std::vector<TaskActivity>& tasks = activities.emplace_back();
        for (std::size_t k = 0; k < marked.size(); ++k) {
            if (!marked[k]) open.push_back({i, k});
            tasks.push_back(marked[k].value_or(no_answer));
        }
    }
    if (open.empty()) return activities;
    auto const reports = ask(scheduler, batches, open);
    if (!reports) return activities;
    std::map<std::size_t, MarkerNames> names;
    for (OpenTask const& task : open)
        if (!names.contains(task.batch)) names[task.batch] = names_of_markers(batches[task.batch]);
    for (OpenTask const& task : open)
        activities[task.batch][task.index] =
            activity_of(scheduler, batches[task.batch], task.index, *reports, names.at(task.batch));
    return activities;
}

std::vector<PackingActivity> survey_packings(Scheduler const& scheduler, std::vector<Batch>& batches) {
    auto const activities = survey_tasks(scheduler, batches);
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

void remember_lost_tasks(Scheduler const& scheduler, std::vector<Batch>& batches) {
    auto const activities = survey_tasks(scheduler, batches);
    for (std::size_t i = 0; i < batches.size(); ++i) {
        MarkerNames const names = names_of_markers(batches[i]);
        for (std::size_t k = 0; k < activities[i].size(); ++k) {
            auto const& [state, outcome, message] = activities[i][k];
            if (state != PackingActivity::ended || by_marker(batches[i], k, names)) continue;
            Json const json{{"outcome", name_of(outcome.value_or(core::Outcome::interrupted))},
                            {"message", message}};
            try {
                core::write_file_atomically(marker(batches[i], k, "lost"), json.dump() + "\n");
            } catch (core::MissingError const&) {
                return;
            }
        }
    }
}

}  // namespace vibrotrough::campaign
