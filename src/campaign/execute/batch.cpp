#include "campaign/execute/batch.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/shell.hpp"
#include "core/text.hpp"
#include "core/time.hpp"

#include <algorithm>
#include <charconv>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace vibrotrough::campaign {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::optional<Task> parse_task(std::string const& line) {
    std::istringstream text(line);
    Task task{};
    bool const read = static_cast<bool>(text >> task.case_id >> task.packing);
    bool const is_id =
        task.case_id.size() == 12 && task.case_id.find_first_not_of("0123456789abcdef") == std::string::npos;
    if (!read || !is_id || task.packing < 1 || task.packing > 1000) return {};
    return task;
}

std::optional<Batch> read_batch(fs::path const& folder) {
    try {
        Json const json = Json::parse(core::read_file(folder / "batch.json"));
        Batch batch{folder, json.at("name"), {}, {}};
        if (json.contains("job")) batch.job = json.at("job").get<long>();
        std::istringstream lines(core::read_file(folder / "tasks.txt"));
        for (std::string line; std::getline(lines, line);) {
            auto const task = parse_task(line);
            if (!task) return {};
            batch.tasks.push_back(*task);
        }
        return batch;
    } catch (Json::exception const&) {
        return {};
    } catch (core::MissingError const&) {
        return {};
    }
}

/// Only numbers and the program's own path, as a word of the shell, enter the script.
std::string job_script(std::string const& number, Job const& job) {
    std::string options = fmt::format("--ranks {} --retries {}", job.ranks, job.retries);
    if (job.time_limit) options += fmt::format(" --time-limit {:.0f}", *job.time_limit);
    return fmt::format(
        "#!/bin/sh\n"
        "# One packing of a campaign, as a task of a job array of Slurm. Made by vibrotrough run.\n"
        "# Slurm starts it in the campaign's folder; the files task-* say how far it came.\n"
        "trap : TERM INT\n"
        "index=${{SLURM_ARRAY_TASK_ID:?}}\n"
        "mark() {{ printf '%s\\n' \"$2\" > \"slurm/{0}/.$1\" && mv -f \"slurm/{0}/.$1\" \"slurm/{0}/$1\"; "
        "}}\n"
        "[ -f slurm/{0}/tasks.txt ] || {{ echo \"$PWD is not the campaign's folder\" >&2; exit 3; }}\n"
        "mark \"task-$index.started\" \"$(uname -n) $SLURM_ARRAY_JOB_ID\"\n"
        "{1} work . --task-list slurm/{0}/tasks.txt --index \"$index\" {2}\n"
        "code=$?\n"
        "mark \"task-$index.ended\" \"$code\"\n"
        "exit \"$code\"\n",
        number, core::shell_word(job.program), options);
}

void write_description(Batch const& batch) {
    Json json{{"name", batch.name}};
    if (batch.job) json["job"] = *batch.job;
    core::write_file_atomically(batch.folder / "batch.json", json.dump(2) + "\n");
}

fs::path marker(Batch const& batch, std::size_t index, char const* kind) {
    return batch.folder / fmt::format("task-{}.{}", index, kind);
}

std::string outcome_of(std::string const& slurm_state) {
    if (slurm_state == "TIMEOUT" || slurm_state == "DEADLINE") return "time-limit";
    if (slurm_state == "OUT_OF_MEMORY") return "out-of-memory";
    return "interrupted";
}

/// The outcome and message that a look before wrote down, or that Slurm gives now.
TaskStatus dead(Batch const& batch, std::size_t index, slurm::TaskReport const* report) {
    TaskStatus status{batch.tasks[index], TaskState::ended, {}, {}};
    status.outcome = report ? outcome_of(report->state) : "interrupted";
    status.message =
        report ? fmt::format(
                     "Slurm says {}{} of task {}_{}", report->state,
                     report->reason.empty() || report->reason == "None" ? "" : " (" + report->reason + ")",
                     batch.job.value_or(0), index)
               : fmt::format("Slurm does not know task {}_{} any more, and it left no last word",
                             batch.job.value_or(0), index);
    try {
        Json const json{{"outcome", status.outcome}, {"message", status.message}};
        core::write_file_atomically(marker(batch, index, "lost"), json.dump() + "\n");
    } catch (core::MissingError const&) {
        // A folder that only may be looked at: the next look asks again.
    }
    return status;
}

std::optional<TaskStatus> by_marker(Batch const& batch, std::size_t index) {
    TaskStatus status{batch.tasks[index], TaskState::ended, {}, {}};
    if (fs::is_regular_file(marker(batch, index, "ended"))) {
        std::string const code = core::read_file(marker(batch, index, "ended"));
        status.outcome = "interrupted";
        status.message = fmt::format("the task ended with exit code {}; see {}",
                                     core::printable(code.substr(0, code.find('\n')), 10),
                                     marker(batch, index, "out").string());
        return status;
    }
    fs::path const lost = marker(batch, index, "lost");
    if (!fs::is_regular_file(lost)) return {};
    Json const json = Json::parse(core::read_file(lost), nullptr, false);
    status.outcome = json.is_object() ? json.value("outcome", "interrupted") : "interrupted";
    status.message = json.is_object() ? json.value("message", "") : "";
    return status;
}

/// The id of a batch whose driver died between sbatch and writing the id down.
void find_lost_id(Batch& batch) {
    if (batch.job) return;
    for (std::size_t i = 0; i < batch.tasks.size(); ++i) {
        if (!fs::is_regular_file(marker(batch, i, "started"))) continue;
        std::istringstream text(core::read_file(marker(batch, i, "started")));
        std::string host;
        if (long job = 0; text >> host >> job) batch.job = job;
        return;
    }
    if (auto const job = slurm::find_by_name(batch.name)) batch.job = job;
}

TaskStatus status_of(Batch const& batch, std::size_t index, slurm::Reports const& reports) {
    // After Slurm's word: a task that it calls ended has written its marker before.
    if (auto const marked = by_marker(batch, index)) return *marked;
    auto const found = reports.find({batch.job.value_or(0), static_cast<int>(index)});
    if (found == reports.end()) return dead(batch, index, nullptr);
    if (slurm::is_terminal(found->second.state)) return dead(batch, index, &found->second);
    bool const waits = found->second.state == "PENDING" || found->second.state == "CONFIGURING";
    std::string const& reason = found->second.reason;
    return {batch.tasks[index],
            waits ? TaskState::waiting : TaskState::running,
            {},
            reason.empty() || reason == "None" ? "" : fmt::format("waits in Slurm: {}", reason)};
}

}  // namespace

Task read_task(fs::path const& task_list, int index) {
    std::istringstream lines(core::read_file(task_list));
    std::string line;
    for (int i = 0; i <= index && std::getline(lines, line); ++i) {
        if (i < index) continue;
        if (auto const task = parse_task(line)) return *task;
    }
    throw core::InputError(fmt::format(
        "{} has no task with index {}; give a list that 'vibrotrough run' made", task_list.string(), index));
}

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

Batch write_batch(fs::path const& campaign_folder, std::vector<Task> const& tasks, Job const& job) {
    int number = 1;
    while (fs::exists(campaign_folder / "slurm" / fmt::format("{:04}", number))) ++number;
    std::string const label = fmt::format("{:04}", number);
    std::string const unique = fmt::format("{} {} {} {}", fs::absolute(campaign_folder).string(), label,
                                           core::utc_now(), ::getpid());
    Batch batch{campaign_folder / "slurm" / label,
                "vibrotrough-" + core::sha256_hex(unique).substr(0, 12),
                {},
                tasks};
    std::string list;
    for (Task const& task : tasks) list += fmt::format("{} {}\n", task.case_id, task.packing);
    core::make_folder(batch.folder);
    core::write_file_atomically(batch.folder / "tasks.txt", list);
    core::write_file_atomically(batch.folder / "job.sh", job_script(label, job));
    write_description(batch);
    return batch;
}

void remember_job(Batch& batch, long job) {
    batch.job = job;
    write_description(batch);
}

std::vector<TaskStatus> look_at_tasks(std::vector<Batch>& batches) {
    std::map<Task, TaskStatus> newest;
    for (Batch& batch : batches) {
        std::vector<std::size_t> open;
        for (std::size_t i = 0; i < batch.tasks.size(); ++i) {
            if (auto const marked = by_marker(batch, i)) {
                newest.insert_or_assign(batch.tasks[i], *marked);
            } else {
                open.push_back(i);
            }
        }
        if (open.empty()) continue;
        std::optional<slurm::Reports> reports;
        try {
            find_lost_id(batch);
            reports = batch.job ? slurm::ask({*batch.job}) : slurm::Reports{};
        } catch (core::MissingError const&) {
            // No Slurm here, or no answer.
        }
        for (std::size_t const i : open) {
            TaskStatus const unknown{batch.tasks[i], TaskState::unknown, {}, "Slurm does not answer"};
            newest.insert_or_assign(batch.tasks[i], reports ? status_of(batch, i, *reports) : unknown);
        }
    }
    std::vector<TaskStatus> all;
    for (auto& [task, status] : newest) all.push_back(std::move(status));
    return all;
}

}  // namespace vibrotrough::campaign
