#include "deck/commands.hpp"

#include "scenario/example_campaign.hpp"
#include "scenario/reader/campaign_file.hpp"

#include <gtest/gtest.h>

namespace vibrotrough::deck {
namespace {

TEST(Commands, LeaveOutCommentsAndAlignment) {
    EXPECT_EQ(commands_of("# a title\n\nfix   integrate all   nve   # the integrator\n\n# end\n"),
              "fix integrate all nve\n");
    EXPECT_EQ(commands_of("run 1\r\n  run 2"), "run 1\nrun 2\n");
    EXPECT_EQ(commands_of(""), "");
    EXPECT_EQ(commands_of("# only a comment"), "");
}

// In LIGGGHTS a # within quotes is text, and a line that ends in & goes on.
TEST(Commands, RespectQuotesAndContinuedLines) {
    EXPECT_EQ(commands_of("print \"a # b   c\" # said\n"), "print \"a # b   c\"\n");
    EXPECT_EQ(commands_of("print 'it is \"# 1\"'\n"), "print 'it is \"# 1\"'\n");
    EXPECT_EQ(commands_of("fix a all &  # first\n   nve\nrun 1\n"), "fix a all  nve\nrun 1\n");
}

TEST(Commands, DifferWhereDecksRunDifferently) {
    EXPECT_NE(commands_of("run 1\n"), commands_of("run 2\n"));
    EXPECT_NE(commands_of("print \"a b\"\n"), commands_of("print \"a  b\"\n"));
}

// Frames of older versions have no spin, and a case that was filmed keeps its id.
TEST(Commands, SpinInFramesDoesNotCount) {
    std::string const before = "dump frames all custom 100 dump/frames.*.dump id type x y z vx vy vz radius";
    EXPECT_EQ(commands_of(before + " omegax omegay omegaz # spin\n"), before + "\n");
    EXPECT_NE(commands_of(before + " fx\n"), commands_of(before + "\n"));
    EXPECT_NE(commands_of("dump mine all custom 100 a omegax omegay omegaz\n"),
              commands_of("dump mine all custom 100 a\n"));
}

TEST(Commands, OfARealDeckDoNotChangeWithItsComments) {
    auto const prepared =
        prepare::prepare_case(scenario::parse_campaign(example_campaign, "c").cases.front());
    auto files = make_deck(prepared, {1}).files;
    std::string const digest = digest_of_commands(files);
    std::string& drive = files.at(drive_file);
    drive = "# another title\n" + drive + "\n# and a last word\n";
    EXPECT_EQ(digest_of_commands(files), digest);
    drive += "run 1\n";
    EXPECT_NE(digest_of_commands(files), digest);
}

}  // namespace
}  // namespace vibrotrough::deck
