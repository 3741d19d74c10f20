#include "campaign/execute/slurm_executor.hpp"

#include "campaign/execute/batch.hpp"
#include "campaign/execute/case_end.hpp"
#include "campaign/schedule/time_to_go.hpp"
#include "campaign/state/case_state.hpp"
#include "campaign/state/folder_lock.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

namespace vibrotrough::campaign {
namespace {

/// What is to be done about a campaign, told from its files and from Slurm.
class Submitter {
  public:
    Submitter(Plan const& plan, scenario::RunSettings const& settings, std::filesystem::path const& program)
        : plan_(plan), settings_(settings), program_(program) {}

    Submission run() {
        std::vector<Batch> batches = read_batches(plan_.folder);
        for (TaskStatus const& status : look_at_tasks(batches)) known_.insert({status.task, status.state});
        for (PlannedCase const& planned : plan_.cases) collect(planned);
        submit();
        return result_;
    }

  private:
    void collect(PlannedCase const& planned) {
        try {
            if (auto const result = finish_case(planned, plan_.engine_version)) {
                ++(result->outcome == "finished" ? result_.finished : result_.unsure);
                return;
            }
        } catch (core::InputError const&) {
            // All packings have their markers and one is damaged all the same: all are run again.
            for (int packing = 1; packing <= planned.scenario.measure.packings; ++packing)
                std::filesystem::remove(planned.packing_folder(packing) / "packing.json");
        }
        bool fresh = true;
        for (int packing = 1; packing <= planned.scenario.measure.packings; ++packing) {
            if (read_finished_packing(planned, packing) || is_in_queue({planned.id, packing})) continue;
            if (std::exchange(fresh, false)) write_case_files(planned);
            result_.again += known_.contains({planned.id, packing}) ? 1 : 0;
            tasks_.push_back({time_to_go_.work(planned.scenario, 1), {planned.id, packing}});
        }
    }

    bool is_in_queue(Task const& task) {
        auto const found = known_.find(task);
        if (found == known_.end() || found->second == TaskState::ended) return false;
        if (found->second == TaskState::unknown) {
            throw core::MissingError(
                fmt::format("Slurm does not answer, so that nobody knows whether packing {} of case {} still "
                            "runs; try again when it does",
                            task.packing, task.case_id));
        }
        ++result_.in_queue;
        return true;
    }

    /// What the task itself may use of Slurm's time, so that it ends with a word of its own.
    std::optional<double> time_limit() const {
        std::optional<double> limit = settings_.time_limit;
        if (settings_.slurm.minutes) {
            double const slurm = *settings_.slurm.minutes * 60.0;
            double const own = slurm - std::min(60.0, slurm / 4);
            limit = std::min(limit.value_or(own), own);
        }
        return limit;
    }

    void submit() {
        // The longest first: what starts last should not last longest.
        std::ranges::stable_sort(tasks_, std::ranges::greater(), &Expected::work);
        Job const job{program_, settings_.ranks.value_or(1), time_limit(), settings_.retries};
        std::size_t const most = tasks_.empty() ? 1 : static_cast<std::size_t>(slurm::most_array_tasks());
        for (std::size_t start = 0; start < tasks_.size(); start += most) {
            std::vector<Task> part;
            for (std::size_t i = start; i < std::min(start + most, tasks_.size()); ++i)
                part.push_back(tasks_[i].task);
            Batch batch = write_batch(plan_.folder, part, job);
            std::string const below = "slurm/" + batch.folder.filename().string();
            slurm::Array const array{plan_.folder,
                                     below + "/job.sh",
                                     below + "/task-%a.out",
                                     batch.name,
                                     static_cast<int>(part.size()),
                                     job.ranks,
                                     settings_.slurm};
            submit(batch, array);
            result_.submitted += static_cast<int>(part.size());
            result_.jobs.push_back(*batch.job);
        }
    }

    /// A batch that Slurm refuses leaves nothing behind.
    static void submit(Batch& batch, slurm::Array const& array) {
        long id = 0;
        try {
            slurm::check(array);
            id = slurm::submit(array);
        } catch (core::MissingError const&) {
            std::filesystem::remove_all(batch.folder);
            throw;
        }
        remember_job(batch, id);
    }

    struct Expected {
        double work;
        Task task;
    };

    Plan const& plan_;
    scenario::RunSettings const& settings_;
    std::filesystem::path const& program_;
    std::map<Task, TaskState> known_;
    std::vector<Expected> tasks_;
    TimeToGo time_to_go_;
    Submission result_;
};

}  // namespace

Submission submit_to_slurm(Plan const& plan, std::filesystem::path const& campaign_file,
                           engine::Engine const& engine, scenario::RunSettings const& settings,
                           std::filesystem::path const& program) {
    core::make_folder(plan.folder);
    FolderLock const lock(plan.folder);
    freeze(plan, campaign_file, engine);
    return Submitter(plan, settings, program).run();
}

}  // namespace vibrotrough::campaign
