#include "core/note.hpp"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vibrotrough::core::note {
namespace {

std::string fault_of(auto const& read) {
    try {
        read();
    } catch (Fault const& fault) {
        return fault.what();
    }
    return "";
}

TEST(Note, NamesWhatIsNotJson) {
    for (char const* text : {"", "[", "{\"a\": 1", "\xff", "NaN", "[1,]", "{} x", "\"\x1b[31m\""})
        EXPECT_THAT(fault_of([&] { parse(text); }), ::testing::StartsWith("it is not JSON from byte "))
            << text;
    EXPECT_EQ(fault_of([] { parse("[1e999]"); }), "it holds a number that is too large");
}

TEST(Note, CountsAreWholeAndInTheirRange) {
    Json const note = parse(R"({"n": 3, "negative": -1, "half": 1.5, "whole": 2.0, "large": 5000000000,
                                "huge": 18446744073709551615, "beyond": 1e300, "true": true, "text": "3"})");
    EXPECT_EQ(count(note, "n", 0), 3);
    EXPECT_EQ(whole_number(note, "large", 0), 5'000'000'000);
    for (char const* key : {"negative", "half", "whole", "large", "huge", "beyond", "true", "text"})
        EXPECT_EQ(fault_of([&] { count(note, key, 0); }),
                  "'" + std::string(key) + "' is not a whole number from 0 to 2147483647");
    EXPECT_EQ(fault_of([&] { whole_number(note, "huge", 0); }).substr(0, 6), "'huge'");
    EXPECT_EQ(fault_of([&] { count(note, "none", 0); }), "'none' is missing");
}

// Both ends of a range belong to it, below zero too, where JSON has another type of number.
TEST(Note, ARangeHoldsItsEnds) {
    Json const note = parse(R"({"least": -5, "most": -3, "below": -6, "above": -2})");
    EXPECT_EQ(whole_number(note, "least", -5, -3), -5);
    EXPECT_EQ(whole_number(note, "most", -5, -3), -3);
    for (char const* key : {"below", "above"})
        EXPECT_EQ(fault_of([&] { whole_number(note, key, -5, -3); }),
                  "'" + std::string(key) + "' is not a whole number from -5 to -3");
}

TEST(Note, NumbersAreNumbersAndNotBelowTheirLeast) {
    Json const note = parse(R"({"x": -0.5, "n": 3, "none": null, "true": true, "text": "1", "list": [1, 2.5],
                                "mixed": [1, null]})");
    EXPECT_EQ(number(note, "x"), -0.5);
    EXPECT_EQ(number(note, "n", 0), 3);
    EXPECT_EQ(fault_of([&] { number(note, "x", 0); }), "'x' is below 0");
    for (char const* key : {"none", "true", "text", "list"})
        EXPECT_EQ(fault_of([&] { number(note, key); }), "'" + std::string(key) + "' is not a number");
    EXPECT_EQ(known_number(note, "none"), std::nullopt);
    EXPECT_EQ(known_number(note, "x"), -0.5);
    EXPECT_EQ(numbers(note, "list"), (std::vector<double>{1, 2.5}));
    EXPECT_EQ(fault_of([&] { numbers(note, "mixed"); }), "'mixed' holds what is not a number");
}

TEST(Note, AnEditedNumberIsNoticed) {
    std::string text = sealed({{"mean", {0.1, 1e-17, 3}}, {"name", "a"}});
    EXPECT_EQ(parse_sealed(text).at("mean"), Json({0.1, 1e-17, 3}));
    EXPECT_EQ(sealed(parse_sealed(text)), text);
    text.replace(text.find("0.1"), 3, "99.");
    text.insert(text.find("99.") + 3, "0");
    EXPECT_THAT(fault_of([&] { parse_sealed(text); }),
                testing::HasSubstr("it was changed since it was written"));
    EXPECT_EQ(parse_sealed(R"({"mean": 2})").at("mean"), 2) << "an older program wrote no digest";
}

TEST(Note, AnotherKindOfValueIsNamed) {
    EXPECT_EQ(fault_of([] { text(parse("[]"), "a"); }), "it is not an object");
    EXPECT_EQ(fault_of([] { text_if_any(parse("3"), "a"); }), "");
    EXPECT_EQ(fault_of([] { text_if_any(parse(R"({"a": 1})"), "a"); }), "'a' is not a text");
    EXPECT_EQ(fault_of([] { elements(parse("{}")); }), "it is not a list");
    EXPECT_EQ(fault_of([] { list(parse(R"({"a": 1})"), "a"); }), "'a' is not a list");
    EXPECT_EQ(fault_of([] { object(parse(R"({"a": []})"), "a"); }), "'a' is not an object");
}

}  // namespace
}  // namespace vibrotrough::core::note
