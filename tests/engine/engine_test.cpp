#include "engine/engine.hpp"

#include "core/error.hpp"
#include "core/temporary_folder.hpp"
#include "engine/run_report.hpp"
#include "engine/sole_writer.hpp"
#include "engine/stop_signals.hpp"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>

#include <boost/asio/steady_timer.hpp>
#include <gtest/gtest.h>
#include <sys/resource.h>

namespace vibrotrough::engine {
namespace {

namespace fs = std::filesystem;

// These tests run the real LIGGGHTS on decks without grains.
class EngineTest : public testing::Test {
  protected:
    void write_deck(std::string const& text) { std::ofstream(folder / "in.liggghts") << text; }

    std::string error_for(fs::path const& asked) {
        try {
            find_engine(asked);
        } catch (core::MissingError const& error) {
            return error.what();
        }
        return "no error";
    }

    core::TemporaryFolder const own_folder;
    fs::path folder = own_folder.path();
    boost::asio::io_context context;
};

// How long a busy machine may take before an engine counts as hanging.
constexpr std::chrono::seconds patience(240);

char const* const endless =
    "atom_style granular\nregion r block 0 1 0 1 0 1\ncreate_box 1 r\nlabel again\n"
    "variable i loop 100000000\nnext i\njump in.liggghts again\n";

TEST_F(EngineTest, IsFoundAndNamesItsVersion) {
    Engine const engine = find_engine({});
    EXPECT_NE(engine.version.find("LIGGGHTS"), std::string::npos) << engine.version;
    EXPECT_TRUE(engine.program.is_absolute());
}

TEST_F(EngineTest, IsRefusedWhenItIsNone) {
    EXPECT_NE(error_for("/nonexistent/liggghts").find("there is no file /nonexistent/liggghts"),
              std::string::npos);
    EXPECT_NE(error_for("/bin/true").find("does not identify itself as LIGGGHTS"), std::string::npos);
    EXPECT_NE(error_for("/").find("there is no file"), std::string::npos);
    std::ofstream(folder / "not_executable") << "x";
    EXPECT_NE(error_for(folder / "not_executable"), "no error");
}

TEST_F(EngineTest, RunsADeckInItsFolder) {
    write_deck(
        "print \"VIBROTROUGH SETTLED floor_force -2 mass 1\"\nprint \"VIBROTROUGH DONE step 7 grains 1\"\n");
    int ended = 0;
    EngineProcess const process(context, find_engine({}), folder, [&](ExitStatus status) {
        ++ended;
        RunReport const report = examine_run(folder, status, Stage::driving);
        EXPECT_FALSE(report.failure) << report.message;
        EXPECT_EQ(report.last_step, 7);
    });
    context.run();
    EXPECT_EQ(ended, 1);
    EXPECT_TRUE(fs::exists(folder / "log.liggghts"));
}

TEST_F(EngineTest, AnErrorMessageIsKept) {
    write_deck("fix nonsense all no/such/style\n");
    EngineProcess const process(context, find_engine({}), folder, [&](ExitStatus status) {
        RunReport const report = examine_run(folder, status, Stage::driving);
        EXPECT_EQ(report.failure, core::Outcome::engine_error);
        EXPECT_EQ(report.message.find("ERROR"), 0u) << report.message;
    });
    context.run();
}

// An engine that ends with exit code 7 was not killed by signal 7: Boost reports both as the same number.
TEST_F(EngineTest, AnExitCodeIsNoSignal) {
    fs::path const script = folder / "script";
    for (auto const& [command, code, signal] : {std::tuple{"exit 0", 0, 0},
                                                {"exit 1", 1, 0},
                                                {"exit 7", 7, 0},
                                                {"exit 137", 137, 0},
                                                {"kill -KILL $$", 0, SIGKILL},
                                                {"kill -SEGV $$", 0, SIGSEGV}}) {
        std::ofstream(script) << "#!/bin/sh\n" << command << "\n";
        fs::permissions(script, fs::perms::owner_all);
        std::optional<ExitStatus> ended;
        EngineProcess const process(context, {script, "any"}, folder,
                                    [&](ExitStatus status) { ended = status; });
        context.restart();
        context.run();
        ASSERT_TRUE(ended) << command;
        EXPECT_EQ(ended->code, code) << command;
        EXPECT_EQ(ended->signal, signal) << command;
    }
}

// Open MPI's networks are not loaded for one rank. One of them, PSM, sleeps 0.2 s in some 350 short pauses;
// each makes the engine give up its core. Without them it did so 7 or 8 times, with them 720 to 920 times
// (three starts each); stdbuf, env and one deck add a few. Open MPI 5.0.7 loads no such network: it gives up
// the core 540 to 670 times with and without these settings.
TEST_F(EngineTest, DoesNotWaitForNetworksThatOneRankDoesNotNeed) {
    if (std::system("mpirun --version | grep -q 'Open MPI) 4'") != 0) GTEST_SKIP() << "for Open MPI 4 alone";
    Engine const engine = find_engine({});
    write_deck("print \"nothing\"\n");
    rusage before{}, after{};
    ::getrusage(RUSAGE_CHILDREN, &before);
    EngineProcess const process(context, engine, folder, [](ExitStatus) {});
    context.run();
    ::getrusage(RUSAGE_CHILDREN, &after);
    EXPECT_LT(after.ru_nvcsw - before.ru_nvcsw, 250);
}

// Three engines run at a time, and each one that ends starts another: every end must be noticed.
TEST_F(EngineTest, ManyRunSideBySide) {
    Engine const engine = find_engine({});
    std::vector<std::unique_ptr<EngineProcess>> processes;
    int ended = 0;
    std::function<void()> start = [&] {
        fs::path const own = folder / std::to_string(processes.size());
        fs::create_directories(own);
        std::ofstream(own / "in.liggghts") << "print hello\n";
        processes.push_back(std::make_unique<EngineProcess>(context, engine, own, [&](ExitStatus status) {
            EXPECT_EQ(status.code, 0);
            ++ended;
            if (processes.size() < 9) start();
        }));
    };
    for (int i = 0; i < 3; ++i) start();
    context.run();
    EXPECT_EQ(ended, 9);
}

TEST_F(EngineTest, EndsWhenAsked) {
    write_deck(endless);
    bool ended = false;
    EngineProcess process(context, find_engine({}), folder, [&](ExitStatus) { ended = true; });
    boost::asio::steady_timer timer(context, std::chrono::milliseconds(700));
    timer.async_wait([&](auto const&) { process.terminate(); });
    context.run_for(patience);  // SIGKILL follows after 5 s
    EXPECT_TRUE(ended);
}

TEST_F(EngineTest, DestructionKillsAndCallsNobody) {
    write_deck(endless);
    bool called = false;
    auto process =
        std::make_unique<EngineProcess>(context, find_engine({}), folder, [&](ExitStatus) { called = true; });
    process.reset();
    context.run_for(patience);
    EXPECT_FALSE(called);
    EXPECT_TRUE(context.stopped()) << "the context is still waiting for the engine";
}

// The engine holds its folder's lock as long as it lives, also when the driver has closed its own end.
// Killed, it has ended before the destructor gives up waiting for it, which takes two seconds.
TEST_F(EngineTest, HoldsItsFolderUntilItIsKilled) {
    fs::path const script = folder / "script";
    std::ofstream(script) << "#!/bin/sh\nexec sleep 1000\n";
    fs::permissions(script, fs::perms::owner_all);
    auto process = std::make_unique<EngineProcess>(context, Engine{script, "any"}, folder, [](ExitStatus) {});
    EXPECT_TRUE(has_writer(folder));
    auto const start = std::chrono::steady_clock::now();
    process.reset();
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2));
    EXPECT_FALSE(has_writer(folder));
}

// The processor times of engines that ran one after the other add up to that of all processes that have
// ended.
TEST_F(EngineTest, EachHasItsOwnProcessorTime) {
    fs::path const script = folder / "script";
    std::ofstream(script) << "#!/bin/sh\ni=0; while [ $i -lt 20000 ]; do i=$((i+1)); done\n";
    fs::permissions(script, fs::perms::owner_all);
    double sum = 0;
    for (int run = 0; run < 3; ++run) {
        EngineProcess const process(context, {script, "any"}, folder, [&](ExitStatus status) {
            EXPECT_GT(status.core_time, 0);
            sum += status.core_time;
        });
        context.restart();
        context.run();
    }
    rusage usage{};
    ::getrusage(RUSAGE_CHILDREN, &usage);
    EXPECT_NEAR(sum,
                static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
                    1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec),
                1e-9);
}

// A user who starts the program with nohup asks it not to stop.
TEST(StopSignals, WhatIsIgnoredStaysIgnored) {
    auto* const before = std::signal(SIGHUP, SIG_IGN);
    boost::asio::io_context context;
    boost::asio::signal_set signals(context);
    add_stop_signals(signals);
    int received = 0;
    signals.async_wait([&](boost::system::error_code const& failure, int number) {
        if (!failure) received = number;
    });
    std::raise(SIGHUP);
    context.poll();
    EXPECT_EQ(received, 0);
    std::raise(SIGTERM);
    context.run_for(patience);
    EXPECT_EQ(received, SIGTERM);
    signals.clear();
    std::signal(SIGHUP, before);
}

TEST_F(EngineTest, AMissingFolderIsAnError) {
    EXPECT_THROW(EngineProcess(context, find_engine({}), folder / "none", [](ExitStatus) {}),
                 core::MissingError);
}

}  // namespace
}  // namespace vibrotrough::engine
