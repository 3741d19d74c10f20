#include "engine/run_report.hpp"

#include "core/temporary_folder.hpp"

#include <csignal>
#include <fstream>

#include <gtest/gtest.h>

namespace vibrotrough::engine {
namespace {

class RunReportTest : public testing::Test {
  protected:
    RunReport examine(std::string const& output, ExitStatus status = {0, 0}, Stage stage = Stage::driving) {
        std::ofstream(folder / output_file) << output;
        return examine_run(folder, status, stage);
    }

    core::TemporaryFolder const own_folder;
    std::filesystem::path folder = own_folder.path();
    std::string const settled = "VIBROTROUGH SETTLED floor_force -0.0991 mass 0.0101 centre_height 0.0095\n";
    std::string const whole = settled + "Loop time of 1\nVIBROTROUGH DONE step 59000 grains 500\n";
};

TEST_F(RunReportTest, CompletedNeedsExitCodeAndEndMarker) {
    RunReport const report = examine(whole);
    EXPECT_EQ(report.failure, std::nullopt);
    EXPECT_EQ(report.last_step, 59000);
    EXPECT_EQ(examine(whole, {1, 0}).failure, core::Outcome::engine_error);
    EXPECT_EQ(examine(settled, {0, 0}, Stage::settling).failure, std::nullopt);
    EXPECT_EQ(examine(settled, {0, 0}, Stage::settling).settled_force, 0.0991);
    EXPECT_EQ(examine("", {0, 0}, Stage::settling).failure, core::Outcome::outputs_incomplete);
}

// A mesh read from a checkpoint lies on the box faces up to rounding (1e-16 m) and the engine warns.
TEST_F(RunReportTest, AMeshFromACheckpointMayTouchTheBoxFaces) {
    std::string const warning = "WARNING: Not all nodes of fix mesh inside simulation box, elements\n";
    EXPECT_EQ(examine("VIBROTROUGH BEGIN cycle 50\n" + warning + whole).failure, std::nullopt);
    EXPECT_EQ(examine("VIBROTROUGH BEGIN cycle 0\n" + warning + whole).failure,
              core::Outcome::mesh_left_domain);
}

// The engine answers SIGTERM with exit code 0 and skips the rest of the deck; a full disk gives exit code 0
// too.
TEST_F(RunReportTest, ExitCodeZeroProvesNothing) {
    EXPECT_EQ(examine("").failure, core::Outcome::outputs_incomplete);
    EXPECT_EQ(examine(settled).failure, core::Outcome::outputs_incomplete);
    EXPECT_EQ(examine(settled + "VIBROTROUGH DONE st").failure, core::Outcome::outputs_incomplete);
    EXPECT_EQ(examine(settled + "SIGINT/SIGTERM caught\n").failure, core::Outcome::engine_crashed);
    std::filesystem::remove(folder / output_file);
    EXPECT_EQ(examine_run(folder, {0, 0}, Stage::driving).failure, core::Outcome::outputs_incomplete);
}

TEST_F(RunReportTest, FailuresHaveNames) {
    EXPECT_EQ(examine(settled, {0, SIGKILL}).message, "the engine was killed by signal 9 (Killed)");
    EXPECT_EQ(examine(settled, {0, SIGKILL}).failure, core::Outcome::engine_crashed);
    RunReport const lost =
        examine(settled + "ERROR: Lost atoms: original 500 current 499 (thermo.cpp:427)\n", {1, 0});
    EXPECT_EQ(lost.failure, core::Outcome::lost_grains);
    EXPECT_EQ(examine("ERROR on proc 0: Failed to allocate 8 bytes\n", {1, 0}).failure,
              core::Outcome::out_of_memory);
    EXPECT_EQ(lost.message, "ERROR: Lost atoms: original 500 current 499 (thermo.cpp:427)");
    EXPECT_EQ(examine("ERROR on proc 0: Cannot open file\x01\xff.stl\n", {1, 0}).message,
              "ERROR on proc 0: Cannot open file\\x01\\xff.stl");
    EXPECT_EQ(examine("VIBROTROUGH FAILED insertion-incomplete: 499 of 500\n").failure,
              core::Outcome::insertion_incomplete);
    RunReport const restless = examine("VIBROTROUGH FAILED not-settled: kinetic energy\n");
    EXPECT_EQ(restless.failure, core::Outcome::not_settled);
    EXPECT_EQ(restless.message, "kinetic energy");
    EXPECT_EQ(examine("VIBROTROUGH FAILED overfull: after 1.5 s\n").message, "after 1.5 s");
    // A line cut short, found by fuzzing.
    EXPECT_EQ(examine("VIBROTROUGH FAILED\n").failure, core::Outcome::engine_error);
    EXPECT_EQ(examine("VIBROTROUGH FAILED  ").failure, core::Outcome::engine_error);
    EXPECT_EQ(examine("WARNING: Not all nodes of fix mesh inside simulation box, elements will be deleted\n" +
                      whole)
                  .failure,
              core::Outcome::mesh_left_domain);
    // What the deck echoes of itself does not count.
    EXPECT_EQ(examine(whole + "print \"VIBROTROUGH FAILED insertion-incomplete\"\n").failure, std::nullopt);
}

}  // namespace
}  // namespace vibrotrough::engine
