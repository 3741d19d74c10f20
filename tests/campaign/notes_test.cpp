#include "campaign/state/notes.hpp"

#include <string>

#include <gtest/gtest.h>

namespace vibrotrough::campaign {
namespace {

/// The fault of a note in which one piece is replaced; empty when it is believed.
std::string fault_with(auto const& parse, std::string note, std::string const& piece,
                       std::string const& other) {
    auto const at = note.find(piece);
    EXPECT_NE(at, std::string::npos) << piece;
    try {
        parse(note.replace(at, piece.size(), other));
        return "";
    } catch (core::note::Fault const& fault) {
        return fault.what();
    }
}

TEST(Notes, AFailureHasCountsThatCanBe) {
    std::string const note = R"({"outcome": "lost-grains", "message": "gone", "packing": 2, "attempts": 1})";
    auto const fault = [&](auto const&... change) { return fault_with(parse_failure, note, change...); };
    EXPECT_EQ(fault("gone", "gone"), "");
    EXPECT_EQ(fault("\"attempts\": 1", "\"attempts\": -1"),
              "'attempts' is not a whole number from 1 to 2147483647");
    EXPECT_EQ(fault("\"packing\": 2", "\"packing\": 4294967298"),
              "'packing' is not a whole number from 1 to 2147483647");
    EXPECT_EQ(fault("lost-grains", "finished"), "'outcome' is not that of a failure");
    EXPECT_EQ(fault("\"gone\"", "[\"gone\"]"), "'message' is not a text");
}

TEST(Notes, ACheckpointHasACycleAndTimes) {
    std::string const note = R"({"cycle": 20, "file": "checkpoint.20.restart", "restart_sha256": "a",
        "deck_sha256": "b", "started": "today", "wall_time": 1.5, "core_time": 1})";
    auto const fault = [&](auto const&... change) { return fault_with(parse_checkpoint, note, change...); };
    EXPECT_EQ(fault("20", "20"), "");
    EXPECT_EQ(fault("20", "0"), "'cycle' is not a whole number from 1 to 2147483647");
    EXPECT_EQ(fault("1.5", "-1.5"), "'wall_time' is below 0");
    EXPECT_EQ(fault("1.5", "1e999"), "it holds a number that is too large");
    EXPECT_EQ(fault(", \"core_time\": 1", ""), "") << "a file of an older version";
}

TEST(Notes, ABatchHasTheNameAndTheIdOfAJob) {
    std::string const note = R"({"name": "vibrotrough-0123456789ab", "job": 17})";
    auto const fault = [&](auto const&... change) { return fault_with(parse_batch, note, change...); };
    EXPECT_EQ(fault("17", "9000000000"), "");
    EXPECT_EQ(fault("17", "-17"), "'job' is not a whole number from 1 to 9223372036854775807");
    for (char const* name : {"", "a b", "*", "--help", "vibrotrough-1,--me", "a'b", "../a"})
        EXPECT_EQ(fault("vibrotrough-0123456789ab", name), "'name' is not the name of a job of this program");
}

TEST(Notes, AnEngineNamesTemplates) {
    std::string const note = R"({"program": "/bin/true", "version": "1", "templates": ["contact.mustache"]})";
    auto const fault = [&](auto const&... change) { return fault_with(parse_engine, note, change...); };
    EXPECT_EQ(fault("contact.mustache", "../secret"), "'templates' names other files");
    EXPECT_EQ(fault("\"version\": \"1\", ", ""), "'version' is missing");
}

TEST(Notes, AFrictionLiesInItsInterval) {
    std::string const note = R"([{"layer": "l", "case": "c", "grain_friction": 0.2, "machine_number": 1,
        "max_relative_displacement": null, "max_relative_displacement_half_width": null, "creep_per_cycle": 0,
        "friction": 0.21, "friction_low": 0.2, "friction_high": 0.22, "mode": "", "message": ""}])";
    auto const fault = [&](auto const&... change) { return fault_with(parse_friction, note, change...); };
    EXPECT_EQ(fault("0.21", "0.22"), "");
    EXPECT_EQ(fault("0.21", "0.23"), "'friction' lies outside of its own interval");
    EXPECT_EQ(fault("0.21", "-0.21"), "'friction' is below 0");
}

TEST(Notes, ANumericalErrorIsNotNegative) {
    std::string const note = R"({"format": "vibrotrough numerics", "schema_version": 1,
        "cases": [{"case": "c", "numerical_error": 0.03}]})";
    auto const fault = [&](auto const&... change) { return fault_with(parse_numerics, note, change...); };
    EXPECT_EQ(fault("0.03", "null"), "");
    EXPECT_EQ(fault("0.03", "-0.03"), "'numerical_error' is below 0");
    EXPECT_EQ(fault(": 1,", ": 2,"), "it is of another format or version");
}

}  // namespace
}  // namespace vibrotrough::campaign
