#include "example_campaign.hpp"
#include "scenario/reader/written_campaign.hpp"
#include "single_case.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vibrotrough {
namespace {

using testing::HasSubstr;

/// The example with frames and these lines of [output].
std::string filming(std::string const& lines) {
    return with("frames_per_cycle = 0", "frames_per_cycle = 10\n" + lines);
}

TEST(FramePackings, AreTheFirstUnlessOthersAreNamed) {
    auto const first = single_case(filming("")).output,
               some = single_case(filming("frame_packings = [5, 2]")).output,
               all = single_case(filming("frame_packings = \"all\"")).output,
               none = single_case(example_campaign).output;
    EXPECT_EQ(some.frame_packings, (std::vector{2, 5}));
    for (int packing = 1; packing <= 9; ++packing) {
        EXPECT_EQ(writes_frames(first, packing), packing == 1);
        EXPECT_EQ(writes_frames(some, packing), packing == 2 || packing == 5);
        EXPECT_TRUE(writes_frames(all, packing));
        EXPECT_FALSE(writes_frames(none, packing));
    }
    EXPECT_EQ(packings_with_frames(first, 4), 1);
    EXPECT_EQ(packings_with_frames(some, 4), 1);
    EXPECT_EQ(packings_with_frames(all, 4), 4);
    EXPECT_EQ(packings_with_frames(none, 4), 0);
}

// A case without these keys has the text that it always had.
TEST(FramePackings, AreWrittenOnlyWhenTheyAreNotTheFirst) {
    for (char const* const lines : {"", "frame_packings = [1]", "contacts = false"}) {
        EXPECT_EQ(to_toml(single_case(filming(lines))), to_toml(single_case(filming("")))) << lines;
        EXPECT_EQ(to_toml(single_case(filming(lines))).find("frame_packings"), std::string::npos);
    }
    for (char const* const lines : {"frame_packings = [3, 1]", "frame_packings = \"all\"", "contacts = true",
                                    "frame_packings = [2]\ncontacts = true"}) {
        std::string const text = to_toml(single_case(filming(lines)));
        EXPECT_NE(text, to_toml(single_case(filming(""))));
        EXPECT_EQ(to_toml(single_case(text)), text);
        EXPECT_EQ(single_case(text).output.frame_packings, single_case(filming(lines)).output.frame_packings);
        EXPECT_EQ(single_case(text).output.contacts, single_case(filming(lines)).output.contacts);
    }
}

TEST(FramePackings, MustBeThere) {
    EXPECT_THAT(error_of(filming("frame_packings = [25]")),
                HasSubstr("there is no packing 25, because there are at most 24"));
    EXPECT_EQ(error_of(filming("frame_packings = [24]")), "no error");
    EXPECT_THAT(error_of(filming("frame_packings = \"none\"")),
                HasSubstr("neither a list nor the word 'all'"));
    EXPECT_THAT(error_of(filming("frame_packings = [1.5]")), HasSubstr("1.5 is not a whole number"));
    EXPECT_THAT(error_of(filming("frame_packings = [0]")), HasSubstr("0 is out of range"));
    EXPECT_THAT(error_of(filming("frame_packings = [2, 2]")), HasSubstr("has a packing twice"));
    EXPECT_THAT(error_of(filming("frame_packings = []")), HasSubstr("is not a list of 1 to 100 values"));
    EXPECT_THAT(error_of(filming("") + "\n[sweep]\n\"output.frame_packings\" = [[1], [2]]\n"),
                HasSubstr("this key cannot be varied"));
}

TEST(FrameContacts, AreWrittenWhenAskedFor) {
    EXPECT_FALSE(single_case(filming("")).output.contacts);
    EXPECT_TRUE(single_case(filming("contacts = true")).output.contacts);
}

}  // namespace
}  // namespace vibrotrough
