#include "campaign/outcome_names.hpp"

#include "core/atomic_file.hpp"
#include "engine/outcome.hpp"

#include <set>

#include <gtest/gtest.h>

namespace vibrotrough::campaign {
namespace {

TEST(OutcomeNames, ReadmeHoldsTheReference) {
    EXPECT_NE(core::read_file(README_FILE).find(outcome_reference()), std::string::npos)
        << "paste this into " << README_FILE << ":\n"
        << outcome_reference();
}

TEST(OutcomeNames, EveryEndOfTheEngineIsThereOnce) {
    std::set<std::string_view> names;
    for (OutcomeName const& outcome : outcome_names())
        EXPECT_TRUE(names.insert(outcome.name).second) << outcome.name;
    using enum engine::Outcome;
    for (auto const outcome : {insertion_incomplete, not_settled, mesh_left_domain, lost_grains, engine_error,
                               engine_crashed, outputs_incomplete}) {
        EXPECT_TRUE(find_outcome(to_string(outcome))) << to_string(outcome);
    }
    for (char const* name : {"finished", "not-steady", "not-precise", "diverged", "time-limit",
                             "out-of-memory", "disk-full", "interrupted"}) {
        EXPECT_TRUE(find_outcome(name)) << name;
    }
    EXPECT_EQ(find_outcome("no such outcome"), nullptr);
}

TEST(OutcomeNames, OnlyWhatMayEndOtherwiseIsTriedAgain) {
    EXPECT_TRUE(retry_makes_sense("engine-crashed"));
    EXPECT_FALSE(retry_makes_sense("lost-grains")) << "the same deck loses the same grains";
    EXPECT_FALSE(retry_makes_sense("disk-full")) << "not before somebody has freed space";
    EXPECT_EQ(retry_advice("disk-full"), "after mending: free space");
    EXPECT_EQ(retry_advice("finished"), "");
}

}  // namespace
}  // namespace vibrotrough::campaign
