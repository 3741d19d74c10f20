#include "campaign/state/case_state.hpp"

#include "campaign_folder.hpp"
#include "core/atomic_file.hpp"
#include "store/result_file.hpp"
#include "store/sample_record.hpp"

namespace vibrotrough::campaign {
namespace {

namespace fs = std::filesystem;
using CaseStateTest = CampaignFolder;

Failure const lost{core::Outcome::lost_grains, "3 grains left the box", 2, 1};

TEST_F(CaseStateTest, DamagedResultIsNone) {
    fs::create_directories(planned.folder);
    store::write_result(planned.result_file(), store::sample_record(planned.id));
    std::string const whole = core::read_file(planned.result_file());
    ASSERT_TRUE(read_whole_result(planned));
    std::string flipped = whole;
    flipped[whole.size() / 2] = static_cast<char>(flipped[whole.size() / 2] ^ 1);
    for (std::string const& damaged : {std::string(), whole.substr(0, 10), whole.substr(0, whole.size() / 2),
                                       whole.substr(0, whole.size() - 1), flipped}) {
        overwrite(planned.result_file(), damaged);
        EXPECT_FALSE(read_whole_result(planned)) << damaged.size() << " of " << whole.size() << " bytes";
    }
    overwrite(planned.result_file(), whole);
    EXPECT_TRUE(read_whole_result(planned));
}

TEST_F(CaseStateTest, ResultOfAnotherCaseIsNone) {
    fs::create_directories(planned.folder);
    store::write_result(planned.result_file(), store::sample_record("ba9876543210"));
    EXPECT_FALSE(read_whole_result(planned));
}

TEST_F(CaseStateTest, FailureComesBackAsWritten) {
    EXPECT_FALSE(read_failure(planned));
    write_failure(planned,
                  {core::Outcome::engine_error, "a \"quoted\" path\\with\nlines and \xC3\xA9", 3, 7});
    auto const failure = read_failure(planned);
    ASSERT_TRUE(failure);
    EXPECT_EQ(failure->outcome, core::Outcome::engine_error);
    EXPECT_EQ(failure->message, "a \"quoted\" path\\with\nlines and \xC3\xA9");
    EXPECT_EQ(failure->packing, 3);
    EXPECT_EQ(failure->attempts, 7);
}

TEST_F(CaseStateTest, DamagedFailureIsNone) {
    write_failure(planned, lost);
    std::string const whole = core::read_file(planned.failure_file());
    for (std::string const& damaged :
         {std::string(), whole.substr(0, whole.size() / 2), std::string("[1]"), std::string("null"),
          std::string("\xff"), with("\"lost-grains\"", "3", whole), with("lost-grains", "unheard-of", whole),
          with("1", "\"once\"", whole)}) {
        overwrite(planned.failure_file(), damaged);
        EXPECT_FALSE(read_failure(planned)) << damaged;
    }
}

class PackingMarker : public CampaignFolder {
  protected:
    PackingMarker() { write_packing(1, "cycles", {12.5, "2026-11-21T12:00:00Z", "2026-11-21T12:00:12Z"}); }
    fs::path const cycles = planned.packing_folder(1) / "cycles.csv";
    fs::path const marker = planned.packing_folder(1) / "packing.json";
};

TEST_F(PackingMarker, ComesBackAsWritten) {
    auto const finished = evaluate::read_marker(planned.packing_folder(1));
    ASSERT_TRUE(finished);
    EXPECT_EQ(finished->wall_time, 12.5);
    EXPECT_EQ(finished->started, "2026-11-21T12:00:00Z");
    EXPECT_EQ(finished->finished, "2026-11-21T12:00:12Z");
    EXPECT_FALSE(evaluate::read_marker(planned.packing_folder(2)));
    EXPECT_EQ(finished_packings(planned), std::vector{1});
}

TEST_F(PackingMarker, HoldsOnlyForTheCyclesItWasWrittenFor) {
    for (char const* altered : {"", "cycle", "cycles\n", "Cycles"}) {
        overwrite(cycles, altered);
        EXPECT_FALSE(evaluate::read_marker(planned.packing_folder(1))) << altered;
    }
    fs::remove(cycles);
    EXPECT_FALSE(evaluate::read_marker(planned.packing_folder(1)));
    overwrite(cycles, "cycles");
    EXPECT_TRUE(evaluate::read_marker(planned.packing_folder(1)));
}

TEST_F(PackingMarker, HoldsOnlyForThePhasesAndSnapshotsItWasWrittenFor) {
    for (char const* name : {"phases.csv", "profiles.0.txt", "surface.0.txt"}) {
        fs::path const path = planned.packing_folder(1) / name;
        std::string const whole = core::read_file(path);
        overwrite(path, whole + "1\n");
        EXPECT_FALSE(evaluate::read_marker(planned.packing_folder(1))) << name;
        fs::remove(path);
        EXPECT_FALSE(evaluate::read_marker(planned.packing_folder(1))) << name;
        overwrite(path, whole);
        EXPECT_TRUE(evaluate::read_marker(planned.packing_folder(1))) << name;
    }
}

TEST_F(PackingMarker, DamagedIsNone) {
    std::string const whole = core::read_file(marker);
    for (std::string const& damaged : {std::string(), whole.substr(0, whole.size() / 2), std::string("{}"),
                                       std::string("[]"), with("12.5", "\"long\"", whole)}) {
        overwrite(marker, damaged);
        EXPECT_FALSE(evaluate::read_marker(planned.packing_folder(1))) << damaged;
    }
    EXPECT_TRUE(finished_packings(planned).empty());
}

TEST_F(PackingMarker, WithoutCyclesIsNone) {
    fs::remove(cycles);
    for (char const* marker_text : {"{}", "{\"cycles_sha256\": \"\"}"}) {
        overwrite(marker, marker_text);
        EXPECT_FALSE(evaluate::read_marker(planned.packing_folder(1))) << marker_text;
    }
}

}  // namespace
}  // namespace vibrotrough::campaign
