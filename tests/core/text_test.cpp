#include "core/text.hpp"

#include <gtest/gtest.h>

namespace vibrotrough::core {
namespace {

TEST(Text, HarmlessKeepsTheLettersOfAllLanguages) {
    for (char const* text : {"", "plain", "\u00b5m, \u00e4\u00f6\u00fc", "\u632f\u52d5", "\U0001f600"})
        EXPECT_EQ(harmless(text), text);
}

TEST(Text, ANumberThatRoundsToZeroHasNoSign) {
    EXPECT_EQ(without_sign_of_zero("-0.0000"), "0.0000");
    EXPECT_EQ(without_sign_of_zero("-0"), "0");
    for (char const* const kept : {"0.0", "-0.0001", "-10.0", "-0.0e-3", "-nan", "-", ""})
        EXPECT_EQ(without_sign_of_zero(kept), kept);
}

TEST(Text, HarmlessReplacesWhatSteersATerminal) {
    EXPECT_EQ(harmless("a\x1b[2Jb"), "a\\x1b[2Jb");
    EXPECT_EQ(harmless("a\nb\rc\td\x7f"), "a\nb\\x0dc\td\\x7f");
    EXPECT_EQ(harmless("\u009b31m"), "\\u009b31m") << "a control sequence in one character";
    EXPECT_EQ(harmless("\u202egnp.exe"), "\\u202egnp.exe") << "right-to-left override";
    EXPECT_EQ(harmless(std::string_view("a\0b", 3)), "a\\x00b");
}

// RFC 3629: no overlong forms, no surrogates, nothing above U+10FFFF, no piece of a character.
TEST(Text, HarmlessReplacesBytesThatAreNotUtf8) {
    EXPECT_EQ(harmless("\xff\xfe"), "\\xff\\xfe");
    EXPECT_EQ(harmless("\xc0\x9b"), "\\xc0\\x9b") << "an escape character in an overlong form";
    EXPECT_EQ(harmless("\xe0\x80\x9b"), "\\xe0\\x80\\x9b");
    EXPECT_EQ(harmless("\xed\xa0\x80"), "\\xed\\xa0\\x80");
    EXPECT_EQ(harmless("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");
    EXPECT_EQ(harmless("\xe6\x8c"), "\\xe6\\x8c");
    EXPECT_EQ(harmless("\xc3("), "\\xc3(");
}

}  // namespace
}  // namespace vibrotrough::core
