#include "compare/select.hpp"

#include "core/error.hpp"

#include <gtest/gtest.h>

namespace vibrotrough::compare {
namespace {

Row row_of(std::string const& id, double throw_number, std::optional<double> dem,
           std::optional<double> theory, std::string const& outcome = "finished") {
    Row row{};
    row.id = id;
    row.throw_number = throw_number;
    if (dem) row.set("efficiency", *dem);
    row.efficiency_theory = theory;
    row.outcome = outcome;
    return row;
}

/// Differences: a +0.1, b -0.2, c unknown, d +0.3.
std::vector<Row> some_rows() {
    return {row_of("a", 2.0, 0.6, 0.5), row_of("b", 1.5, 0.3, 0.5), row_of("c", 3.0, {}, 0.9, "not-steady"),
            row_of("d", 1.0, 0.4, 0.1)};
}

std::string ids(std::vector<Row> const& rows) {
    std::string text;
    for (Row const& row : rows) text += row.id;
    return text;
}

std::string refusal(auto const& call) {
    try {
        call();
    } catch (core::InputError const& error) {
        return error.what();
    }
    return "no error";
}

TEST(Filter, ComparesNumbers) {
    auto const rows = some_rows();
    EXPECT_EQ(ids(filtered(rows, "throw_number>1.5")), "ac");
    EXPECT_EQ(ids(filtered(rows, "throw_number >= 1.5")), "abc");
    EXPECT_EQ(ids(filtered(rows, "throw_number<1.5")), "d");
    EXPECT_EQ(ids(filtered(rows, "throw_number<=1.5")), "bd");
    EXPECT_EQ(ids(filtered(rows, "throw_number=2")), "a");
    EXPECT_EQ(ids(filtered(rows, " throw_number == 2.0 ")), "a");
    EXPECT_EQ(ids(filtered(rows, "throw_number!=2")), "bcd");
    EXPECT_EQ(ids(filtered(rows, "difference<0")), "b");
    EXPECT_EQ(ids(filtered(rows, "packings>0")), "") << "what is not known fulfils nothing";
    EXPECT_EQ(ids(filtered(rows, "efficiency!=0.6")), "bd") << "what is not known fulfils nothing";
}

TEST(Filter, ComparesTexts) {
    EXPECT_EQ(ids(filtered(some_rows(), "outcome=finished")), "abd");
    EXPECT_EQ(ids(filtered(some_rows(), "outcome!=finished")), "c");
    EXPECT_EQ(ids(filtered(some_rows(), "case=b")), "b");
}

TEST(Filter, SaysWhatIsWrong) {
    auto const said = [](char const* condition) {
        return refusal([&] { filtered(some_rows(), condition); });
    };
    EXPECT_NE(said("gamma>1").find("there is no column 'gamma'; 'vibrotrough quantities' describes all"),
              std::string::npos);
    EXPECT_NE(said("flow_speed>1").find("there is no column 'flow_speed'"), std::string::npos);
    EXPECT_NE(said("throw_number").find("is not a condition; write a column"), std::string::npos);
    EXPECT_NE(said("throw_number>").find("is not a condition"), std::string::npos);
    EXPECT_NE(said("throw_number=>1").find("is not a condition"), std::string::npos);
    EXPECT_NE(said("").find("is not a condition"), std::string::npos);
    EXPECT_NE(said(">1").find("there is no column ''"), std::string::npos);
    for (char const* value :
         {"throw_number>high", "throw_number>1.5x", "throw_number>nan", "throw_number>1e999"})
        EXPECT_NE(said(value).find("is not a number"), std::string::npos) << value;
    EXPECT_NE(said("outcome>finished").find("'outcome' is a text; compare it with = or !="),
              std::string::npos);
}

TEST(Sort, PutsUnknownNumbersLast) {
    EXPECT_EQ(ids(sorted(some_rows(), "throw_number")), "dbac");
    EXPECT_EQ(ids(sorted(some_rows(), "throw_number:asc")), "dbac");
    EXPECT_EQ(ids(sorted(some_rows(), "throw_number:desc")), "cabd");
    EXPECT_EQ(ids(sorted(some_rows(), "difference")), "badc");
    EXPECT_EQ(ids(sorted(some_rows(), "difference:desc")), "dabc");
    EXPECT_EQ(ids(sorted(some_rows(), "friction:desc")), "abcd") << "equal rows keep their order";
}

TEST(Sort, TakesTheHeadingsOfTables) {
    EXPECT_EQ(ids(sorted(some_rows(), "Gamma:desc")), "cabd") << "in a terminal";
    EXPECT_EQ(ids(sorted(some_rows(), "throw number \u0393:desc")), "cabd") << "in a report";
    EXPECT_EQ(ids(filtered(some_rows(), "eta theory at mu = 0.5")), "ab");
    std::string const said = refusal([] { sorted(some_rows(), "eta theory"); });
    EXPECT_NE(said.find("no column 'eta theory'; it is a heading of efficiency_theory and "),
              std::string::npos)
        << said;
}

TEST(Sort, SaysWhatIsWrong) {
    auto const said = [](char const* key) { return refusal([&] { sorted(some_rows(), key); }); };
    EXPECT_NE(said("eta").find("--sort: there is no column 'eta'"), std::string::npos);
    EXPECT_NE(said("friction:down").find("the order 'down' is neither asc nor desc"), std::string::npos);
}

}  // namespace
}  // namespace vibrotrough::compare
