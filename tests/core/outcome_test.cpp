#include "core/outcome.hpp"

#include <set>

#include <gtest/gtest.h>

namespace vibrotrough::core {
namespace {

TEST(Outcome, NamesAreUniqueAndReadBack) {
    std::set<std::string_view> names;
    for (OutcomeEntry const& entry : outcome_table()) {
        EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
        EXPECT_EQ(outcome_named(entry.name), entry.outcome);
        EXPECT_EQ(name_of(entry.outcome), entry.name);
        EXPECT_FALSE(entry.meaning.empty()) << entry.name;
    }
    EXPECT_FALSE(outcome_named("no such outcome"));
    EXPECT_FALSE(outcome_named(""));
}

TEST(Outcome, OnlyWhatMayEndDifferentlyIsTriedAgain) {
    EXPECT_TRUE(retry_makes_sense(Outcome::engine_crashed));
    EXPECT_FALSE(retry_makes_sense(Outcome::lost_grains)) << "the same deck loses the same grains";
    EXPECT_FALSE(retry_makes_sense(Outcome::disk_full)) << "not before somebody has freed space";
    EXPECT_EQ(retry_advice(Outcome::disk_full), "afterwards: free space, or raise the limit");
    EXPECT_EQ(retry_advice(Outcome::finished), "");
}

}  // namespace
}  // namespace vibrotrough::core
