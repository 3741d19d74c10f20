#include "core/shell.hpp"

#include <gtest/gtest.h>

namespace vibrotrough {
namespace {

TEST(Shell, QuotesWhatAShellWouldSplit) {
    EXPECT_EQ(core::shell_word("runs/demo-1_a.b"), "runs/demo-1_a.b");
    EXPECT_EQ(core::shell_word("my runs"), "'my runs'");
    EXPECT_EQ(core::shell_word("a'b"), "'a'\\''b'");
    EXPECT_EQ(core::shell_word("$(x)"), "'$(x)'");
    EXPECT_EQ(core::shell_word(""), "''");
}

}  // namespace
}  // namespace vibrotrough
