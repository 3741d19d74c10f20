#include "campaign/execute/batch.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/temporary_folder.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace vibrotrough::campaign {
namespace {

namespace fs = std::filesystem;

class BatchTest : public testing::Test {
  protected:
    core::TemporaryFolder const own_folder;
    fs::path folder = own_folder.path();
    std::vector<Task> tasks{
        {{"0123456789ab", 1}}, {{"0123456789ab", 2}, {"ffffffffffff", 1}}, {{"ffffffffffff", 1000}}};
};

TEST_F(BatchTest, ComesBackAsWritten) {
    Batch batch = write_batch(folder, tasks, {"/usr/bin/true", 1, {}, 0, false, {}});
    write_batch(folder, {tasks[2]}, {"/usr/bin/true", 1, {}, 0, false, {}});
    auto read = read_batches(folder);
    ASSERT_EQ(read.size(), 2u);
    EXPECT_EQ(read[0].tasks, tasks);
    EXPECT_EQ(read[0].name, batch.name);
    EXPECT_NE(read[0].name, read[1].name);
    EXPECT_FALSE(read[0].job);
    EXPECT_EQ(core::read_file(batch.folder / "job.sh").find("--learning"), std::string::npos);
    remember_job(batch, 4711);
    EXPECT_EQ(read_batches(folder)[0].job, 4711);
    for (std::size_t i = 0; i < tasks.size(); ++i)
        EXPECT_EQ(read_task(batch.folder / "tasks.txt", static_cast<int>(i)), tasks[i]);
    EXPECT_THROW(read_task(batch.folder / "tasks.txt", 3), core::InputError);
}

TEST_F(BatchTest, DamagedListsAreRefused) {
    fs::path const list = folder / "tasks.txt";
    for (char const* line :
         {"", "0123456789ab", "0123456789ab 0", "0123456789ab 1001", "0123456789ag 1", "../../../etc 1",
          "0123456789abc 1", "0123456789a 1", "0123456789AB 1", "$(id)      1", "0123456789ab 1 0123456789ab",
          "0123456789ab 1 0123456789ab x"}) {
        std::ofstream(list) << line << "\n";
        EXPECT_THROW(read_task(list, 0), core::InputError) << line;
    }
}

// The script is run as Slurm runs it, with a program whose path would do harm in a careless script.
TEST_F(BatchTest, TheScriptRunsTheProgramAndSaysHowFarItCame) {
    fs::path const odd = folder / "a $(touch hacked) 'b' \"c\" &";
    fs::create_directories(odd);
    fs::path const program = odd / "vibrotrough";
    std::ofstream(program) << "#!/bin/sh\nprintf '%s\\n' \"$@\" > arguments\nexit 5\n";
    fs::permissions(program, fs::perms::owner_all);
    Batch const batch = write_batch(folder, tasks, {program, 2, 90.0, 3, true, {}, 1, false, true});
    std::string const command = fmt::format(
        "cd '{}' && SLURM_ARRAY_TASK_ID=1 SLURM_ARRAY_JOB_ID=77 sh slurm/0001/job.sh", folder.string());
    int const status = std::system(command.c_str());
    EXPECT_EQ(WEXITSTATUS(status), 5);
    EXPECT_EQ(
        core::read_file(folder / "arguments"),
        "work\n.\n--task-list\nslurm/0001/"
        "tasks.txt\n--index\n1\n--ranks\n2\n--retries\n3\n--allow-extra\n--learning\n--time-limit\n90\n");
    EXPECT_EQ(core::read_file(batch.folder / "task-1.ended"), "5\n");
    EXPECT_TRUE(core::read_file(batch.folder / "task-1.started").ends_with(" 77\n"));
    EXPECT_FALSE(fs::exists(folder / "hacked"));
}

// Two engines at once: the program is started twice on the same task, and the worst of its exit codes counts,
// also when a signal to the script's shell comes in between.
TEST_F(BatchTest, TheScriptRunsSeveralEnginesAndWaitsForAll) {
    fs::path const program = folder / "vibrotrough";
    std::ofstream(program)
        << "#!/bin/sh\n"
           "mkdir first 2>/dev/null || { kill -TERM $PPID; sleep 0.5; echo late >> ended; exit 0; }\n"
           "echo early >> ended; exit 3\n";
    fs::permissions(program, fs::perms::owner_all);
    Batch const batch = write_batch(folder, tasks, {program, 1, {}, 0, false, {}, 2});
    std::string const command = fmt::format(
        "cd '{}' && SLURM_ARRAY_TASK_ID=0 SLURM_ARRAY_JOB_ID=77 sh slurm/0001/job.sh", folder.string());
    int const status = std::system(command.c_str());
    EXPECT_EQ(WEXITSTATUS(status), 3);
    EXPECT_EQ(core::read_file(folder / "ended"), "early\nlate\n");
    EXPECT_EQ(core::read_file(batch.folder / "task-0.ended"), "3\n");
}

// A task that is warned tells the program, and is queued again without a marker that it ended; when it is not
// taken again, it has ended. The scheduler may end the task before the command that queues it has ended.
TEST_F(BatchTest, TheScriptQueuesAWarnedTaskAgain) {
    fs::path const program = folder / "vibrotrough";
    std::ofstream(program) << "#!/bin/sh\ntrap 'echo told >> said; exit 130' TERM\n"
                              "kill -USR1 $PPID\nsleep 20 > /dev/null 2>&1 & wait\n";
    fs::permissions(program, fs::perms::owner_all);
    Batch const batch = write_batch(folder, tasks, {program, 1, {}, 0, false, {}, 1, true});
    std::ofstream(batch.folder / "task-2.ended") << "130\n";
    for (int const code : {0, 1}) {
        std::ofstream(folder / "scontrol")
            << "#!/bin/sh\nkill -TERM $$\necho \"$@\" >> asked\nexit " << code << "\n";
        fs::permissions(folder / "scontrol", fs::perms::owner_all);
        std::string const command = fmt::format(
            "cd '{0}' && PATH='{0}':$PATH SLURM_ARRAY_TASK_ID=2 SLURM_ARRAY_JOB_ID=77 sh slurm/0001/job.sh",
            folder.string());
        int const status = std::system(command.c_str());
        EXPECT_EQ(WEXITSTATUS(status), code == 0 ? 0 : 130);
        EXPECT_EQ(fs::exists(batch.folder / "task-2.ended"), code != 0);
    }
    EXPECT_EQ(core::read_file(folder / "asked"), "requeue 77_2\nrequeue 77_2\n");
    EXPECT_EQ(core::read_file(folder / "said"), "told\ntold\n");
}

/// What is found of a batch where Slurm's squeue is this script.
std::vector<TaskActivity> survey_with(std::string const& squeue, Batch& batch, fs::path const& bin) {
    fs::create_directories(bin);
    for (auto const& [name, script] : {std::pair{"squeue", squeue}, {"sacct", std::string("exit 1\n")}}) {
        std::ofstream(bin / name) << "#!/bin/sh\n" << script;
        fs::permissions(bin / name, fs::perms::owner_all);
    }
    std::string const path = std::getenv("PATH");
    ::setenv("PATH", fmt::format("{}:{}", bin.string(), path).c_str(), 1);
    std::vector<Batch> batches{batch};
    auto const found = survey_tasks(batches);
    ::setenv("PATH", path.c_str(), 1);
    batch = batches[0];
    return found[0];
}

// A driver that was killed after it had submitted a batch: the job has the batch's name. What Slurm says of
// its tasks is read as squeue(1) has it.
TEST_F(BatchTest, AJobWithoutAnIdIsFoundByItsName) {
    Batch batch = write_batch(folder, tasks, {"/usr/bin/true", 1, {}, 0, false, {}});
    std::string const squeue = fmt::format(
        "case \"$*\" in *'-n {} '*) echo 4711; exit ;; *'-j 4711 '*) ;; *) exit 0 ;; esac\n"
        "echo '4711_0|TIMEOUT|TimeLimit'\necho '4711_1|RUNNING|None'\n"
        "echo '4711_2|OUT_OF_MEMORY|None'\n",
        batch.name);
    auto const found = survey_with(squeue, batch, folder / "bin");
    EXPECT_EQ(batch.job, 4711);
    EXPECT_EQ(found[0].outcome, core::Outcome::time_limit) << found[0].message;
    EXPECT_EQ(found[1].state, PackingActivity::running);
    EXPECT_EQ(found[2].outcome, core::Outcome::out_of_memory) << found[2].message;
}

// A driver that was killed between the batch's files and sbatch: Slurm has nothing of this name.
TEST_F(BatchTest, ABatchThatWasNotSubmittedSaysSo) {
    Batch batch = write_batch(folder, tasks, {"/usr/bin/true", 1, {}, 0, false, {}});
    auto const found = survey_with("exit 0\n", batch, folder / "bin");
    EXPECT_EQ(found[0].state, PackingActivity::ended);
    EXPECT_EQ(found[0].outcome, core::Outcome::interrupted);
    EXPECT_EQ(found[0].message,
              fmt::format("Slurm knows no job {}: the run ended before it was submitted", batch.name));
}

}  // namespace
}  // namespace vibrotrough::campaign
