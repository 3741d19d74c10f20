#include "campaign/execute/slurm_batch.hpp"

#include "campaign/state/campaign_folder.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/shell.hpp"
#include "core/text.hpp"
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
using Json = nlohmann::ordered_json;

std::optional<Batch> read_batch(fs::path const& folder) {
    try {
        Json const json = Json::parse(core::read_file(folder / "batch.json", core::largest_note));
        Batch batch{folder, json.at("name"), {}, {}};
        if (json.contains("job")) batch.job = json.at("job").get<long>();
        auto tasks = read_task_list(folder / "tasks.txt");
        if (!tasks) return {};
        batch.tasks = std::move(*tasks);
        return batch;
    } catch (Json::exception const&) {
        return {};
    } catch (core::MissingError const&) {
        return {};
    }
}

/// The lines of run.slurm.setup, and what ends the task when one of them fails. A login shell knows `module`.
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

/// Only numbers and the program's own path, as a word of the shell, enter the script; and the lines of
/// run.slurm.setup, which the user has allowed.
std::string job_script(std::string const& number, JobScript const& job) {
    std::string options = fmt::format("--ranks {} --retries {}", job.ranks, job.retries);
    if (job.allow_extra) options += " --allow-extra";
    if (job.time_limit) options += fmt::format(" --time-limit {:.0f}", *job.time_limit);
    return fmt::format(
        "{3}\n"
        "# A task of a job array of Slurm: packings of a campaign, one after the other. Made by vibrotrough "
        "run.\n"
        "# Slurm starts it in the campaign's folder; the files task-* say how far it came.\n"
        "trap : TERM INT\n"
        "index=${{SLURM_ARRAY_TASK_ID:?}}\n"
        "mark() {{ rm -f \"slurm/{0}/.$1\" && ( set -C; printf '%s\\n' \"$2\" > \"slurm/{0}/.$1\" ) &&\n"
        "    mv -fT \"slurm/{0}/.$1\" \"slurm/{0}/$1\"; }}\n"
        "[ -f slurm/{0}/tasks.txt ] || {{ echo \"$PWD is not the campaign's folder\" >&2; exit 3; }}\n"
        "mark \"task-$index.started\" \"$(uname -n) $SLURM_ARRAY_JOB_ID\"\n"
        "{4}"
        "{1} work . --task-list slurm/{0}/tasks.txt --index \"$index\" {2}\n"
        "code=$?\n"
        "mark \"task-$index.ended\" \"$code\"\n"
        "exit \"$code\"\n",
        number, core::shell_word(job.program), options, job.setup.empty() ? "#!/bin/sh" : "#!/bin/bash -l",
        setup_lines(job.setup));
}

void write_description(Batch const& batch) {
    Json json{{"name", batch.name}};
    if (batch.job) json["job"] = *batch.job;
    core::write_file_atomically(batch.folder / "batch.json", json.dump(2) + "\n");
}

fs::path marker(Batch const& batch, std::size_t index, char const* kind) {
    return batch.folder / fmt::format("task-{}.{}", index, kind);
}

core::Outcome outcome_of(std::string const& slurm_state) {
    if (slurm_state == "TIMEOUT" || slurm_state == "DEADLINE") return core::Outcome::time_limit;
    if (slurm_state == "OUT_OF_MEMORY") return core::Outcome::out_of_memory;
    return core::Outcome::interrupted;
}

/// What is known of a task, and so of each of its packings.
struct TaskActivity {
    PackingActivity::State state = PackingActivity::unknown;
    std::optional<core::Outcome> outcome = {};
    std::string message = {};
};

/// A task that ended without a marker of its own.
/// @param report  what Slurm knows of it; null when Slurm does not know it
TaskActivity lost_task(Batch const& batch, std::size_t index, slurm::TaskReport const* report) {
    TaskActivity activity{PackingActivity::ended, core::Outcome::interrupted, {}};
    long const job = batch.job.value_or(0);
    if (report == nullptr) {
        activity.message = fmt::format(
            "Slurm no longer knows task {}_{}, which ended without writing its exit marker", job, index);
        return activity;
    }
    bool const has_reason = !report->reason.empty() && report->reason != "None";
    activity.outcome = outcome_of(report->state);
    activity.message = fmt::format("Slurm says {}{} of task {}_{}", report->state,
                                   has_reason ? " (" + report->reason + ")" : "", job, index);
    return activity;
}

/// What the markers say of a task; none while it has no marker that it ended.
std::optional<TaskActivity> by_marker(Batch const& batch, std::size_t index) {
    TaskActivity activity{PackingActivity::ended, core::Outcome::interrupted, {}};
    if (fs::is_regular_file(marker(batch, index, "ended"))) {
        std::string const code = core::read_file(marker(batch, index, "ended"), core::largest_note);
        activity.message = fmt::format("the task ended with exit code {}; see {}",
                                       core::printable(code.substr(0, code.find('\n')), 10),
                                       marker(batch, index, "out").string());
        return activity;
    }
    fs::path const lost = marker(batch, index, "lost");
    if (!fs::is_regular_file(lost)) return {};
    Json const json = Json::parse(core::read_file(lost, core::largest_note), nullptr, false);
    if (json.is_object()) {
        try {
            auto const outcome = core::outcome_named(json.value("outcome", ""));
            // A task that was lost has no result, whatever the file says.
            if (outcome && !core::has_result(*outcome)) activity.outcome = outcome;
            activity.message = core::harmless(json.value("message", ""));
        } catch (Json::exception const&) {
            activity.message = fmt::format("{} is damaged", lost.string());
        }
    }
    return activity;
}

/// The id of a batch whose driver died between sbatch and writing the id down.
void find_lost_id(Batch& batch) {
    if (batch.job) return;
    for (std::size_t i = 0; i < batch.tasks.size(); ++i) {
        if (!fs::is_regular_file(marker(batch, i, "started"))) continue;
        std::istringstream text(core::read_file(marker(batch, i, "started"), core::largest_note));
        std::string host;
        if (long job = 0; text >> host >> job) batch.job = job;
        return;
    }
    if (auto const job = slurm::find_by_name(batch.name)) batch.job = job;
}

TaskActivity activity_of(Batch const& batch, std::size_t index, slurm::Reports const& reports) {
    // After Slurm's answer: a task that Slurm calls ended wrote its marker before.
    if (auto const marked = by_marker(batch, index)) return *marked;
    auto const found = reports.find({batch.job.value_or(0), static_cast<int>(index)});
    if (found == reports.end()) return lost_task(batch, index, nullptr);
    auto const& [state, reason] = found->second;
    if (slurm::is_terminal(state)) return lost_task(batch, index, &found->second);
    bool const waits = state == "PENDING" || state == "CONFIGURING";
    return {waits ? PackingActivity::waiting : PackingActivity::running,
            {},
            reason.empty() || reason == "None" ? "" : fmt::format("waits in Slurm: {}", reason)};
}

/// A task that has no marker that it ended.
struct OpenTask {
    std::size_t batch, index;
};

/// Asks Slurm once for all tasks that are open.
/// @return nothing when there is no Slurm here, or it does not answer
std::optional<slurm::Reports> ask_slurm(std::vector<Batch>& batches, std::vector<OpenTask> const& open) {
    try {
        std::set<long> jobs;
        for (OpenTask const& task : open) {
            find_lost_id(batches[task.batch]);
            if (batches[task.batch].job) jobs.insert(*batches[task.batch].job);
        }
        return slurm::ask(jobs);
    } catch (core::MissingError const&) {
        return {};
    }
}

/// What is known of the tasks of all batches, by batch and index.
std::vector<std::vector<TaskActivity>> survey_batches(std::vector<Batch>& batches) {
    std::vector<std::vector<TaskActivity>> activities;
    std::vector<OpenTask> open;
    for (std::size_t i = 0; i < batches.size(); ++i) {
        std::vector<TaskActivity>& tasks = activities.emplace_back();
        for (std::size_t k = 0; k < batches[i].tasks.size(); ++k) {
            auto const marked = by_marker(batches[i], k);
            if (!marked) open.push_back({i, k});
            tasks.push_back(
                marked.value_or(TaskActivity{PackingActivity::unknown, {}, "Slurm does not answer"}));
        }
    }
    if (open.empty()) return activities;
    auto const reports = ask_slurm(batches, open);
    if (!reports) return activities;
    for (OpenTask const& task : open)
        activities[task.batch][task.index] = activity_of(batches[task.batch], task.index, *reports);
    return activities;
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

void remove_remains_of_batches(fs::path const& campaign_folder) {
    std::error_code missing;
    for (auto const& entry : fs::directory_iterator(campaign_folder / "slurm", missing)) {
        for (char const* const file : {"batch.json", "tasks.txt", "job.sh"})
            core::remove_remains_of(entry.path() / file);
    }
}

Batch write_batch(fs::path const& campaign_folder, std::vector<Task> const& tasks, JobScript const& script) {
    int number = 1;
    while (fs::exists(campaign_folder / "slurm" / fmt::format("{:04}", number))) ++number;
    std::string const label = fmt::format("{:04}", number);
    std::string const unique = fmt::format("{} {} {} {}", fs::absolute(campaign_folder).string(), label,
                                           core::utc_now(), ::getpid());
    Batch batch{campaign_folder / "slurm" / label,
                "vibrotrough-" + core::sha256_hex(unique).substr(0, 12),
                {},
                tasks};
    core::make_folder(batch.folder);
    core::write_file_atomically(batch.folder / "tasks.txt", write_task_list(tasks));
    core::write_file_atomically(batch.folder / "job.sh", job_script(label, script));
    write_description(batch);
    return batch;
}

void remember_job(Batch& batch, long job) {
    batch.job = job;
    write_description(batch);
}

std::vector<PackingActivity> survey_tasks(std::vector<Batch>& batches) {
    auto const activities = survey_batches(batches);
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

void remember_lost_tasks(std::vector<Batch>& batches) {
    auto const activities = survey_batches(batches);
    for (std::size_t i = 0; i < batches.size(); ++i) {
        for (std::size_t k = 0; k < activities[i].size(); ++k) {
            auto const& [state, outcome, message] = activities[i][k];
            if (state != PackingActivity::ended || by_marker(batches[i], k)) continue;
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
