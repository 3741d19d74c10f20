#include "core/csv.hpp"

#include <cmath>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vibrotrough::core {
namespace {

using Rows = std::vector<std::vector<std::string>>;

/// The header and all rows, or the error.
Rows read(std::string_view text, CsvFormat const& format = {}) {
    CsvReader table(text, "t.csv", format);
    Rows rows{table.columns()};
    while (table.next()) rows.emplace_back(table.cells().begin(), table.cells().end());
    return rows;
}

std::string error_of(std::string_view text, CsvFormat const& format = {}) {
    try {
        read(text, format);
    } catch (CsvError const& error) {
        return error.what();
    }
    return "no error";
}

/// All rows, read as numbers without cells, or the error.
std::vector<std::vector<double>> numbers(std::string_view text, CsvFormat const& format = {}) {
    CsvReader table(text, "t.csv", format);
    std::vector<double> row(table.columns().size());
    std::vector<std::vector<double>> rows;
    while (table.next(row)) rows.push_back(row);
    return rows;
}

std::string number_error_of(std::string_view text, CsvFormat const& format = {}) {
    try {
        numbers(text, format);
    } catch (CsvError const& error) {
        return error.what();
    }
    return "no error";
}

TEST(Csv, PlainRows) {
    EXPECT_EQ(read("a,b\n1,2\n3,4\n"), (Rows{{"a", "b"}, {"1", "2"}, {"3", "4"}}));
    EXPECT_EQ(read("a,b\n1,2"), (Rows{{"a", "b"}, {"1", "2"}})) << "the last line needs no end";
    EXPECT_EQ(read("a,b\n,\n"), (Rows{{"a", "b"}, {"", ""}})) << "cells may be empty";
    EXPECT_EQ(read("a\n"), (Rows{{"a"}}));
    EXPECT_EQ(read("a\nx\n"), (Rows{{"a"}, {"x"}})) << "one column";
}

TEST(Csv, LinesMayEndAsOnWindows) {
    EXPECT_EQ(read("a,b\r\n1,2\r\n3,4"), (Rows{{"a", "b"}, {"1", "2"}, {"3", "4"}}));
    EXPECT_EQ(read("a,b\r\n\"1\",\"2\"\r\n3,\"4\"\r"), (Rows{{"a", "b"}, {"1", "2"}, {"3", "4"}}));
    EXPECT_EQ(numbers("a,b\r\n1,2\r\n").front(), (std::vector<double>{1, 2}));
}

TEST(Csv, AByteOrderMarkIsSkipped) {
    EXPECT_EQ(read("\xEF\xBB\xBF"
                   "a,b\n1,2\n"),
              (Rows{{"a", "b"}, {"1", "2"}}));
    EXPECT_EQ(read("\xEF\xBB\xBF"
                   "\"a\",b\n1,2\n"),
              (Rows{{"a", "b"}, {"1", "2"}}));
    EXPECT_THAT(error_of("\xEF\xBB\xBF"), testing::StartsWith("t.csv:1: the file is empty"));
}

TEST(Csv, TabsSeparateCells) {
    EXPECT_EQ(read("a\tb\n1,5\t2\n"), (Rows{{"a", "b"}, {"1,5", "2"}}));
    EXPECT_EQ(read("a\tb\n\t2\n"), (Rows{{"a", "b"}, {"", "2"}})) << "an empty cell";
    EXPECT_EQ(read("a\tb\n\"x\ty\"\t2\n"), (Rows{{"a", "b"}, {"x\ty", "2"}})) << "a tab in quotes";
    EXPECT_EQ(read("a,\tb\n1,2\n"), (Rows{{"a", "b"}, {"1", "2"}})) << "tabs beside commas are blanks";
    EXPECT_NE(error_of(std::string_view("\xFF\xFE"
                                        "a\0;\0",
                                        6))
                  .find("UTF-8"),
              std::string::npos)
        << "UTF-16";
    EXPECT_EQ(core::csv_number("1,5", '\t', core::CsvNumbers::finite), 1.5);
}

TEST(Csv, QuotesHoldAnything) {
    EXPECT_EQ(read("a,b\n\"1,5\",2\n"), (Rows{{"a", "b"}, {"1,5", "2"}}));
    EXPECT_EQ(read("a,b\n\"say \"\"yes\"\"\",2\n"), (Rows{{"a", "b"}, {"say \"yes\"", "2"}}));
    EXPECT_EQ(read("a,b\n\"two\nlines\",2\n3,4\n"), (Rows{{"a", "b"}, {"two\nlines", "2"}, {"3", "4"}}));
    EXPECT_EQ(read("a,b\n\"\",\"\"\"\"\n"), (Rows{{"a", "b"}, {"", "\""}}));
    EXPECT_EQ(read("\"a,x\",\"b\ny\"\n1,2\n"), (Rows{{"a,x", "b\ny"}, {"1", "2"}})) << "in the header, too";
    EXPECT_EQ(read("a,b\n\"#1\",2\n", {.comments = true}), (Rows{{"a", "b"}, {"#1", "2"}}));
    EXPECT_EQ(read("a\n\"x\n#y\n\nz\"\n", {.comments = true, .blanks = true}), (Rows{{"a"}, {"x\n#y\n\nz"}}));
    // Many cells with doubled quotes in one row: each keeps its own text.
    EXPECT_EQ(read("a,b,c\n\"1\"\"\",\"2\"\"\",\"3\"\"\"\n"), (Rows{{"a", "b", "c"}, {"1\"", "2\"", "3\""}}));
}

TEST(Csv, SpacesAroundACellDoNotBelongToIt) {
    EXPECT_EQ(read(" a ,\tb\n 1 , \"2\" \n"), (Rows{{"a", "b"}, {"1", "2"}}));
    EXPECT_EQ(read("a,b\n\" 1 \",2\n"), (Rows{{"a", "b"}, {" 1 ", "2"}}));
    EXPECT_EQ(read("a,b\n1 1,2\n"), (Rows{{"a", "b"}, {"1 1", "2"}}));
    EXPECT_EQ(numbers("a,b\n 1 , 2\n").front(), (std::vector<double>{1, 2}));
}

TEST(Csv, TheHeaderDecidesOnTheSeparator) {
    EXPECT_EQ(read("a;b\n1,5;2\n"), (Rows{{"a", "b"}, {"1,5", "2"}}));
    EXPECT_EQ(numbers("a;b\n1,5;2\n-0,25;1,5e3\n"),
              (std::vector<std::vector<double>>{{1.5, 2}, {-0.25, 1500}}));
    EXPECT_EQ(numbers("a;b\n1.5;2\n").front().front(), 1.5) << "a decimal point is right as well";
    EXPECT_EQ(numbers("a;b\n\"1,5\";2\n").front().front(), 1.5);
    EXPECT_EQ(read("\"a;x\",b\n1,2\n"), (Rows{{"a;x", "b"}, {"1", "2"}})) << "a quoted ; is not a separator";
    EXPECT_EQ(read("# a;b\na,b\n1,2\n", {.comments = true}), (Rows{{"a", "b"}, {"1", "2"}}));
    EXPECT_EQ(read("height, m;width\n1;2\n"), (Rows{{"height, m", "width"}, {"1", "2"}}));
    EXPECT_THAT(error_of("a,b\n1;2\n"),
                testing::StartsWith("t.csv:2: expected 2 values, one per column, but found 1"));
    for (char const* wrong : {"a;b\n1.234,5;2\n", "a;b\n1,2,3;2\n", "a;b\n1,;2\n", "a;b\n,5x;2\n"})
        EXPECT_NE(number_error_of(wrong).find("is not a finite number"), std::string::npos) << wrong;
    EXPECT_NE(number_error_of("a,b\n\"1,5\",2\n").find("'1,5' is not a finite number"), std::string::npos)
        << "a decimal comma needs ; between the cells";
    EXPECT_THAT(
        number_error_of("a,b\n0,0\n0,5,-1,5e-3\n"),
        testing::HasSubstr("3: expected 2 values, one per column, but found 4: its numbers seem to have "
                           "decimal commas, but commas separate its columns, too; separate the columns "
                           "with semicolons"));
    EXPECT_THAT(number_error_of("a,b\n0.5,1,2\n"), testing::Not(testing::HasSubstr("decimal commas")));
}

TEST(Csv, CommentsAndBlankLinesAreSkippedOnRequestOnly) {
    std::string const text = "# head\n\na,b\n# middle, \"with\" quotes\n1,2\n \t\r\n3,4\n#end";
    EXPECT_EQ(read(text, {.comments = true, .blanks = true}), (Rows{{"a", "b"}, {"1", "2"}, {"3", "4"}}));
    EXPECT_EQ(read("a\n\n1\n"), (Rows{{"a"}, {""}, {"1"}}));
    EXPECT_EQ(read("a\n#1\n"), (Rows{{"a"}, {"#1"}}));
    EXPECT_THAT(error_of("a,b\n\n1,2\n"),
                testing::StartsWith("t.csv:2: expected 2 values, one per column, but found 1"));
}

TEST(Csv, LinesAreCounted) {
    CsvReader table("# one\na,b\n\n\"x\n\ny\",1\n2,3\n", "", {.comments = true, .blanks = true});
    EXPECT_EQ(table.header_line(), 2);
    ASSERT_TRUE(table.next());
    EXPECT_EQ(table.line(), 4) << "the first line of the row";
    ASSERT_TRUE(table.next());
    EXPECT_EQ(table.line(), 7);
    EXPECT_FALSE(table.next());
    EXPECT_FALSE(table.next()) << "and stays at the end";
}

TEST(Csv, NumbersAreStrict) {
    auto const value = [](std::string_view cell) { return csv_number(cell, ',', CsvNumbers::finite); };
    EXPECT_EQ(value("1"), 1);
    EXPECT_EQ(value("-1.5e-3"), -1.5e-3);
    EXPECT_EQ(value("+2"), 2);
    EXPECT_EQ(value(".5"), 0.5);
    EXPECT_EQ(value("0.1"), 0.1) << "rounded correctly";
    for (char const* wrong : {"", "+", "+-1", "++1", "1x", "x", "1 2", "0x10", "1e", "1e999", "nan", "inf",
                              "-inf", "1,5", "1.5.2", "NaN(1)", " 1"})
        EXPECT_FALSE(value(wrong).has_value()) << wrong;
    EXPECT_TRUE(std::isnan(csv_number("nan", ',', CsvNumbers::any).value()));
    EXPECT_TRUE(std::isnan(csv_number("-nan", ',', CsvNumbers::any).value()));
    EXPECT_EQ(csv_number("-inf", ',', CsvNumbers::any), -INFINITY);
}

TEST(Csv, NumberErrorsNameLineAndColumn) {
    for (auto const& text : {"a,speed\n1,2\n3,fast\n", "a,speed\n1,2\n3,\"fast\"\n"})
        EXPECT_THAT(number_error_of(text),
                    testing::StartsWith("t.csv:3: column speed: 'fast' is not a finite number"));
    EXPECT_THAT(number_error_of("a,speed\n1,nan\n", {.cure = "run the case again"}),
                testing::StartsWith("t.csv:2: column speed: 'nan' is not a finite number"));
    EXPECT_THAT(number_error_of("a,speed\n1,x\n", {.numbers = CsvNumbers::any}),
                testing::StartsWith("t.csv:2: column speed: 'x' is not a number"));
    EXPECT_THAT(number_error_of("a,b\n1,2,3\n"),
                testing::StartsWith("t.csv:2: expected 2 values, one per column, but found 3"));
    EXPECT_THAT(number_error_of("a,b\n1\n"),
                testing::StartsWith("t.csv:2: expected 2 values, one per column, but found 1"));
    CsvReader table("a,b\n1,\n", "t.csv");
    ASSERT_TRUE(table.next());
    EXPECT_EQ(table.number_if_given(0), 1);
    EXPECT_FALSE(table.number_if_given(1).has_value());
    EXPECT_THROW(table.number(1), CsvError);
    try {
        table.fail("is wrong", "mend it");
    } catch (CsvError const& error) {
        EXPECT_STREQ(error.what(), "t.csv:2: is wrong; mend it");
        EXPECT_EQ(error.problem(), "is wrong");
        EXPECT_EQ(error.line(), 2);
        EXPECT_EQ(error.kind(), ErrorKind::input);
    }
}

// Reading by rows of numbers and reading by cells give the same numbers and refuse the same rows.
TEST(Csv, BothWaysAgree) {
    for (std::string_view const text :
         {"a,b\n1,2\n\"3\",4\n", "a,b\n+1,2\n", "a,b\n1, 2\n", "a,b\n1,2\r\n", "a,b\n1e999,2\n",
          "a,b\n1,2,\n", "a,b\n1,inf\n", "a,b\n,\n", "a;b\n1,5;2\n", "a,b\n\"1\"x,2\n", "a,b\n1,2\n\n",
          "a,b\n1,2\nx,y\n"}) {
        std::vector<std::vector<double>> by_cells;
        std::string message = "no error";
        try {
            CsvReader table(text, "t.csv");
            while (table.next()) by_cells.push_back({table.number(0), table.number(1)});
        } catch (CsvError const& error) {
            message = error.what();
        }
        EXPECT_EQ(number_error_of(text), message) << text;
        if (message == "no error") {
            EXPECT_EQ(numbers(text), by_cells) << text;
        }
    }
    std::vector<double> three(3);
    CsvReader table("a,b\n1,2\n", "t.csv");
    EXPECT_THROW(table.next(three), std::invalid_argument);
}

TEST(Csv, MalformedQuotesAreRefusedWithTheirLine) {
    EXPECT_THAT(error_of("a,b\n1,2\n\"3,4\n5,6\n"),
                testing::StartsWith("t.csv:3: an opening quote has no closing quote"));
    EXPECT_THAT(error_of("a,b\n\"x\ny\",\"3\n"),
                testing::StartsWith("t.csv:3: an opening quote has no closing quote"));
    EXPECT_NE(error_of("a,b\n\"1\"2,3\n").find("t.csv:2: there is text after the closing quote"),
              std::string::npos);
    EXPECT_NE(error_of("a,b\n5\" pipe,3\n").find("t.csv:2: there is a quote within the cell '5\" pipe'"),
              std::string::npos);
    EXPECT_NE(error_of("a,b\n\"\n\",5\"\n").find("t.csv:3: there is a quote within"), std::string::npos);
    EXPECT_NE(error_of("a,\"b\n1,2\n").find("t.csv:1: an opening quote"), std::string::npos);
    EXPECT_NE(error_of("a,b\n\"1\"\"\n").find("t.csv:2: an opening quote"), std::string::npos)
        << "a doubled quote does not close the cell";
}

TEST(Csv, MalformedHeadersAreRefused) {
    EXPECT_THAT(error_of(""), testing::StartsWith("t.csv:1: the file is empty"));
    EXPECT_THAT(error_of("#\n\n", {.comments = true, .blanks = true}),
                testing::StartsWith("t.csv:1: the file is empty"));
    EXPECT_THAT(error_of("a,b,a\n"), testing::StartsWith("t.csv:1: column 'a' appears twice"));
    EXPECT_THAT(error_of("a,,b\n"), testing::StartsWith("t.csv:1: column 2 has no name"));
    EXPECT_THAT(error_of("a,b,\n"), testing::StartsWith("t.csv:1: column 3 has no name"));
    EXPECT_NE(error_of("a\rb\n").find("control characters"), std::string::npos);
    EXPECT_NE(error_of(std::string_view("a\0,b\n", 5)).find("control characters"), std::string::npos);
}

TEST(Csv, SizesHaveLimits) {
    EXPECT_NE(error_of("a,b\n1,2\n", {.most_bytes = 7}).find("the file is larger than 7 bytes"),
              std::string::npos);
    EXPECT_EQ(error_of("a,b\n1,2\n", {.most_bytes = 8}), "no error");
    EXPECT_THAT(error_of("a\n1\n2\n3\n", {.most_rows = 2}),
                testing::StartsWith("t.csv:4: there are more than 2 rows"));
    EXPECT_THAT(number_error_of("a\n1\n2\n3\n", {.most_rows = 2}),
                testing::StartsWith("t.csv:4: there are more than 2 rows"));
    EXPECT_EQ(error_of("a\n1\n2\n", {.most_rows = 2}), "no error");
    EXPECT_NE(error_of("a,b,c\n", {.most_columns = 2}).find("more than 2 columns"), std::string::npos);
}

// However much of a growing text exists, its complete rows are read without an error.
TEST(Csv, GrowingTextsAreReadAtAnyMoment) {
    std::string const whole = "# SI\na,b\n1,2\n\"3\n3\",\"4\"\"\"\n# more\n5,6\n";
    CsvFormat const format{.comments = true, .growing = true};
    std::size_t most = 0;
    for (std::size_t size = 0; size <= whole.size(); ++size) {
        Rows const rows = read(std::string_view(whole).substr(0, size), format);
        EXPECT_GE(rows.size(), most);
        most = rows.size();
        for (auto const& row : rows) EXPECT_TRUE(row.empty() || row.size() == 2) << size;
    }
    EXPECT_EQ(most, 4u);
    EXPECT_TRUE(read("\"a", format).front().empty()) << "a header that is not complete yet";
    EXPECT_TRUE(numbers("a,b\n1,2", {.growing = true}).empty());
}

TEST(Csv, ColumnsMayBeNamedByTheCaller) {
    CsvFormat const format{.comments = true, .columns = {"step", "x"}};
    EXPECT_EQ(numbers("# title\n1,2\n3,4\n", format), (std::vector<std::vector<double>>{{1, 2}, {3, 4}}));
    EXPECT_THAT(number_error_of("1,2\n3,\n", format),
                testing::StartsWith("t.csv:2: column x: '' is not a finite number"));
    EXPECT_TRUE(numbers("", format).empty());
}

TEST(Csv, CellsThatAreWrittenAreReadBack) {
    for (std::string const cell : {"plain", "", "a,b", "a;b", "say \"yes\"", "\"", "two\nlines", " spaces ",
                                   "\t", "#", "\r", "\xC3\xA9", "FN'"}) {
        Rows const rows = read("a,b\n" + csv_cell(cell) + ",2\n", {.comments = true, .blanks = true});
        ASSERT_EQ(rows.size(), 2u) << cell;
        EXPECT_EQ(rows[1][0], cell);
    }
    EXPECT_EQ(csv_cell("plain text"), "plain text");
}

TEST(Csv, DecimalCommas) {
    EXPECT_EQ(with_decimal_point("9,5 mm", ';'), "9.5 mm");
    EXPECT_EQ(with_decimal_point("9,5 mm", ','), "9,5 mm");
    for (char const* same : {"1.234,5", "1,2,3", "free, slow", "9,", ",", ""})
        EXPECT_EQ(with_decimal_point(same, ';'), same);
}

// 1.450 beside 1,2 may be 1450, as 1.450 in a German table is; 0.450 and a table without decimal commas
// cannot.
TEST(Csv, APointThatMayDivideThousandsIsRefusedBesideDecimalCommas) {
    EXPECT_THAT(error_of("a;b\n1,2;1.450\n"),
                testing::HasSubstr("t.csv:2: '1.450' can be read with and without"));
    EXPECT_THAT(error_of("a;b\n1.450 mm;3\n2;1,2\n"), testing::HasSubstr("1.450 mm"));
    for (char const* fine : {"a;b\n1.2;1.450\n", "a,b\n1,1.450\n", "a;b\n1,2;0.450\n", "a;b\n1,2;1.45\n",
                             "# 1,2\na;b\n1.2;1.450\n"})
        EXPECT_EQ(error_of(fine, {.comments = true}), "no error") << fine;
}

TEST(Csv, NumberTables) {
    auto const error = [](std::string_view text) -> std::string {
        try {
            read_number_table(text, {"x", "y"});
        } catch (std::invalid_argument const& problem) {
            return problem.what();
        }
        return "no error";
    };
    auto const rows = read_number_table("# SI\r\nx,y\r\n1,2\r\n\r\n3,4", {"x", "y"});
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[1].values, (std::vector<double>{3, 4}));
    EXPECT_EQ(rows[1].line, 5);
    EXPECT_EQ(read_number_table("x;y\n1,5;2\n", {"x", "y"}).front().values.front(), 1.5);
    EXPECT_TRUE(read_number_table(" \n", {"x", "y"}).empty());
    EXPECT_EQ(error("y,x\n"), "line 1: this is not the header x,y");
    EXPECT_EQ(error("x,y\n1\n"), "line 2: expected 2 values, one per column, but found 1");
    EXPECT_EQ(error("x,y\n1,inf\n"), "line 2: column y: 'inf' is not a finite number");
}

}  // namespace
}  // namespace vibrotrough::core
