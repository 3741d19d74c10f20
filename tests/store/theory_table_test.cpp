#include "store/theory_table.hpp"

#include "core/error.hpp"
#include "core/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vibrotrough::store {
namespace {

using theory::Input;

std::string error_of(std::string const& text) {
    try {
        parse_theory_points({"in.csv", text});
    } catch (core::InputError const& error) {
        return error.what();
    }
    return "no error";
}

TheoryPoints const sample = parse_theory_points(
    {"in.csv", "throw_number,tan_vibration_angle,friction,restitution\n2,0.50,0.23,\n1.5,0.25,0.3,0.2\n"});

std::vector<theory::Efficiency> const answers{{0.5, 0, 1, theory::Outcome::periodic},
                                              {-1.0 / 0.0, 0, 0, theory::Outcome::runs_away, 0.25}};

TEST(TheoryTable, PointsAreRead) {
    EXPECT_EQ(sample.columns, (std::vector{Input::throw_number, Input::tan_vibration_angle, Input::friction,
                                           Input::restitution}));
    ASSERT_EQ(sample.points.size(), 2u);
    EXPECT_EQ(sample.points[1].get(Input::throw_number), 1.5);
    EXPECT_FALSE(sample.points[0].get(Input::restitution).has_value()) << "an empty cell is not given";
    EXPECT_EQ(sample.cells[0], (std::vector<std::string>{"2", "0.50", "0.23", ""})) << "as written";
}

// What a spreadsheet writes: quotes, commas within them, ; with decimal commas.
TEST(TheoryTable, SpreadsheetsAreRead) {
    auto const quoted = parse_theory_points(
        {"in.csv", "\"throw_number\",\"tan_vibration_angle\",\"friction\"\r\n\"2\",\"0.5\",\"0.23\"\r\n"});
    EXPECT_EQ(quoted.points[0].get(Input::friction), 0.23);
    auto const german =
        parse_theory_points({"in.csv", "throw_number;tan_vibration_angle;friction\n2;0,5;0,23\n"});
    EXPECT_EQ(german.points[0].get(Input::friction), 0.23);
    EXPECT_EQ(german.cells[0][2], "0.23") << "commas separate the cells of the answer";
    EXPECT_NE(error_of("throw_number,tan_vibration_angle,friction\n2,\"0,5\",0.23\n")
                  .find("in.csv:2: column tan_vibration_angle: '0,5' is not a finite number"),
              std::string::npos);
}

TEST(TheoryTable, MistakesAreNamedWithTheirPlace) {
    EXPECT_THAT(error_of("throw_number,colour\n2,red\n"),
                testing::StartsWith("in.csv:1: column 'colour' is not an input"));
    for (auto const& [other, meant] : {std::pair{"stroke", "stroke_mm"},
                                       {"frequency", "frequency_hz"},
                                       {"throw_numbr", "throw_number"},
                                       {"vibration_angle_dg", "vibration_angle_deg"}})
        EXPECT_EQ(
            error_of(std::string(other) + "\n2\n"),
            "in.csv:1: column '" + std::string(other) + "' is not an input; did you mean " + meant + "?");
    EXPECT_EQ(error_of("# a\n\nthrow_number,friction\n2,0.3\n"),
              "in.csv:4: point 1: give exactly one of vibration_angle_deg and tan_vibration_angle");
    EXPECT_THAT(error_of(""), testing::StartsWith("in.csv:1: the file is empty"));
    EXPECT_THROW(read_theory_points("no_such.csv"), core::InputError);
}

TEST(TheoryTable, AnswersStandBesideTheInputs) {
    EXPECT_EQ(theory_answers_csv(sample, answers),
              "throw_number,tan_vibration_angle,friction,restitution,velocity_efficiency,half_width,mode,"
              "period_cycles,converged\n2,0.50,0.23,,0.5,0," +
                  theory::to_string(theory::ModeCode{}) + ",1,true\n1.5,0.25,0.3,0.2,-inf,0.25," +
                  theory::to_string(theory::ModeCode{}) + ",0,false\n");
    core::TemporaryFolder const folder;
    write_theory_answers(folder.path() / "a.h5", sample, answers);
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "a.h5"));
}

}  // namespace
}  // namespace vibrotrough::store
