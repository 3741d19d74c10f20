#include "engine/outcome.hpp"

#include <csignal>
#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

namespace vibrotrough::engine {
namespace {

class OutcomeTest : public testing::Test {
  protected:
    OutcomeTest() { std::filesystem::create_directories(folder); }
    ~OutcomeTest() override { std::filesystem::remove_all(folder); }

    RunReport examine(std::string const& output, ExitStatus status = {0, 0}, Stage stage = Stage::driving) {
        std::ofstream(folder / output_file) << output;
        return examine_run(folder, status, stage);
    }

    std::filesystem::path folder = testing::TempDir() + "outcome_" + std::to_string(::getpid());
    std::string const settled = "VIBROTROUGH SETTLED floor_force -0.0991 mass 0.0101 centre_height 0.0095\n";
    std::string const whole = settled + "Loop time of 1\nVIBROTROUGH DONE step 59000 grains 500\n";
};

TEST_F(OutcomeTest, CompletedNeedsExitCodeAndEndMarker) {
    RunReport const report = examine(whole);
    EXPECT_EQ(report.outcome, Outcome::completed);
    EXPECT_EQ(report.last_step, 59000);
    EXPECT_EQ(examine(whole, {1, 0}).outcome, Outcome::engine_error);
    EXPECT_EQ(examine(settled, {0, 0}, Stage::settling).outcome, Outcome::completed);
    EXPECT_EQ(examine(settled, {0, 0}, Stage::settling).settled_force, 0.0991);
    EXPECT_EQ(examine("", {0, 0}, Stage::settling).outcome, Outcome::outputs_incomplete);
}

// A mesh read from a checkpoint lies on the faces of the box only up to rounding (1e-16 m), and the engine
// warns about it.
TEST_F(OutcomeTest, AMeshFromACheckpointMayTouchTheBoxFaces) {
    std::string const warning = "WARNING: Not all nodes of fix mesh inside simulation box, elements\n";
    EXPECT_EQ(examine("VIBROTROUGH BEGIN cycle 50\n" + warning + whole).outcome, Outcome::completed);
    EXPECT_EQ(examine("VIBROTROUGH BEGIN cycle 0\n" + warning + whole).outcome, Outcome::mesh_left_domain);
}

// After SIGTERM the engine skips the rest of the deck and ends with exit code 0; the exit code is also 0 when
// the disk is full.
TEST_F(OutcomeTest, ExitCodeZeroProvesNothing) {
    EXPECT_EQ(examine("").outcome, Outcome::outputs_incomplete);
    EXPECT_EQ(examine(settled).outcome, Outcome::outputs_incomplete);
    EXPECT_EQ(examine(settled + "VIBROTROUGH DONE st").outcome, Outcome::outputs_incomplete);
    EXPECT_EQ(examine(settled + "SIGINT/SIGTERM caught\n").outcome, Outcome::engine_crashed);
    std::filesystem::remove(folder / output_file);
    EXPECT_EQ(examine_run(folder, {0, 0}, Stage::driving).outcome, Outcome::outputs_incomplete);
}

TEST_F(OutcomeTest, FailuresHaveNames) {
    EXPECT_EQ(examine(settled, {0, SIGKILL}).message, "the engine was killed by signal 9 (Killed)");
    EXPECT_EQ(examine(settled, {0, SIGKILL}).outcome, Outcome::engine_crashed);
    RunReport const lost =
        examine(settled + "ERROR: Lost atoms: original 500 current 499 (thermo.cpp:427)\n", {1, 0});
    EXPECT_EQ(lost.outcome, Outcome::lost_grains);
    EXPECT_EQ(lost.message, "ERROR: Lost atoms: original 500 current 499 (thermo.cpp:427)");
    EXPECT_EQ(examine("ERROR on proc 0: Cannot open file\x01\xff.stl\n", {1, 0}).message,
              "ERROR on proc 0: Cannot open file??.stl");
    EXPECT_EQ(examine("VIBROTROUGH FAILED insertion-incomplete: 499 of 500\n").outcome,
              Outcome::insertion_incomplete);
    RunReport const restless = examine("VIBROTROUGH FAILED not-settled: kinetic energy\n");
    EXPECT_EQ(restless.outcome, Outcome::not_settled);
    EXPECT_EQ(restless.message, "kinetic energy");
    // A truncated line, found by fuzzing.
    EXPECT_EQ(examine("VIBROTROUGH FAILED\n").outcome, Outcome::engine_error);
    EXPECT_EQ(examine("VIBROTROUGH FAILED  ").outcome, Outcome::engine_error);
    EXPECT_EQ(examine("WARNING: Not all nodes of fix mesh inside simulation box, elements will be deleted\n" +
                      whole)
                  .outcome,
              Outcome::mesh_left_domain);
    // The echo of the deck in the output must not be taken for an outcome.
    EXPECT_EQ(examine(whole + "print \"VIBROTROUGH FAILED insertion-incomplete\"\n").outcome,
              Outcome::completed);
}

}  // namespace
}  // namespace vibrotrough::engine
