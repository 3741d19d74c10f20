#include "core/temporary_folder.hpp"
#include "run_program.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace vibrotrough {
namespace {

namespace fs = std::filesystem;

nlohmann::json ask(std::string const& command) {
    Answer const answer = run_program("theory " + command + " --json", StandardError::dropped);
    EXPECT_EQ(answer.exit_code, 0) << answer.text;
    return nlohmann::json::parse(answer.text);
}

void expect_refused(std::string const& command, std::string const& words) {
    Answer const answer = run_program("theory " + command);
    EXPECT_EQ(answer.exit_code, 2) << command << '\n' << answer.text;
    EXPECT_EQ(std::count(answer.text.begin(), answer.text.end(), '\n'), 1) << answer.text;
    EXPECT_NE(answer.text.find(words), std::string::npos) << answer.text;
}

class TheoryFiles : public testing::Test {
  protected:
    std::string path(std::string const& name) const { return (folder_.path() / name).string(); }
    static std::vector<std::vector<std::string>> read_csv(std::string const& name) {
        std::vector<std::vector<std::string>> rows;
        std::ifstream file(name);
        for (std::string line; std::getline(file, line);) {
            rows.emplace_back();
            std::istringstream cells(line);
            for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
        }
        return rows;
    }

  private:
    core::TemporaryFolder const folder_;
};

// Read back by h5py and by VTK in validation/theory_figures; here that the files are there and the cost is
// said.
TEST_F(TheoryFiles, MapWritesItsFiles) {
    Answer const answer = run_program(
        "theory map --x throw_number=0.3:3.3:40 --y vibration_angle_deg=5:60:30 --friction 0.35 "
        "--tan-inclination -0.1 --jobs 1 --output " +
        path("map.h5"));
    EXPECT_EQ(answer.exit_code, 0) << answer.text;
    EXPECT_NE(answer.text.find("microseconds of CPU per solution"), std::string::npos);
    EXPECT_TRUE(fs::exists(path("map.h5")));
    bool const has_vtk = run_program("--version").text.find("no VTK") == std::string::npos;
    EXPECT_EQ(fs::exists(path("map.vti")), has_vtk);
    EXPECT_EQ(fs::exists(path("map_modes.vtp")), has_vtk);
}

TEST_F(TheoryFiles, MapRefusesWrongInput) {
    std::string const end = " --friction 0.35 --output " + path("map.h5");
    std::string const y = " --y vibration_angle_deg=5:60:3";
    expect_refused("map --x throw=0.3:3.3:3" + y + end, "'throw' is not an input");
    expect_refused("map --x throw_number=0.3:3.3" + y + end, "NAME=FROM:TO:COUNT");
    expect_refused("map --x throw_number=0.3:3.3:2.5" + y + end, "whole number");
    expect_refused("map --x throw_number=-1:3.3:3" + y + end, "outside its range");
    expect_refused("map --x throw_number=0.3:3.3:3 --friction 0.3 --output " + path("map.h5"),
                   "--y is missing");
    expect_refused("map --x throw_number=0.3:3.3:3" + y + " --output " + path("map.h5"),
                   "--friction is missing");
    expect_refused("map --x throw_number=0.3:3.3:3" + y + " --friction 0.3 --output map.png", ".h5");
}

// Fig. 6: at Gamma = 3.297 the mass lands where the trough is as fast as it was at take-off, cos(delta_F) =
// 0.9529. Tolerance: the digits of the throw number.
TEST_F(TheoryFiles, TraceFollowsTheMass) {
    Answer const answer = run_program(
        "theory trace --throw-number 3.296908 --tan-vibration-angle 0.5 --friction 0.3 "
        "--samples 101 --output " +
        path("trace.csv"));
    EXPECT_EQ(answer.exit_code, 0) << answer.text;
    auto const rows = read_csv(path("trace.csv"));
    ASSERT_EQ(rows.size(), 102u);
    EXPECT_EQ(rows[0][0], "time_rad");
    EXPECT_NEAR(std::stod(rows[1][2]), 0.9529, 1e-4);   // trough
    EXPECT_NEAR(std::stod(rows[50][3]), 0.9529, 1e-4);  // mass, in flight on the level
    expect_refused("trace --throw-number 2 --tan-vibration-angle 0.5 --friction 0.1 --tan-inclination 0.3",
                   "runs away");
}

// In SI: the trough moves along with omega r cos(beta) cos(omega t), omega^2 = Gamma g / (r sin(beta)).
// Tolerance: rounding. At take-off, arcsin(1/2), the trough accelerates down with g.
TEST_F(TheoryFiles, TraceInSiUnits) {
    Answer const answer = run_program(
        "theory trace --throw-number 2 --vibration-angle '30 deg' --friction 0.3 "
        "--amplitude '6 mm' --gravity '9.81 m/s2' --output " +
        path("trace.csv"));
    EXPECT_EQ(answer.exit_code, 0) << answer.text;
    auto const rows = read_csv(path("trace.csv"));
    EXPECT_EQ(rows[0][0], "time_s");
    double const omega = std::sqrt(2 * 9.81 / (0.006 * 0.5)), thirty = std::acos(-1.0) / 6;
    EXPECT_NEAR(std::stod(rows[1][0]), thirty / omega, 1e-9);
    EXPECT_NEAR(std::stod(rows[1][2]), omega * 0.006 * std::cos(thirty) * std::cos(thirty), 1e-9);
    EXPECT_NEAR(std::stod(rows[1][7]), -9.81, 1e-9);
}

TEST(TheoryErrors, OfTheCommandLineAreOneLine) {
    expect_refused("point --throw 3", "--throw");
    expect_refused("point --throw-number", "--throw-number");
    expect_refused("", "subcommand");
}

// Fig. 8 at beta = 0, alpha = 0, PN: X = 2 sqrt(1 - (pi mu / (2 K))^2). Tolerance: solver's 1e-6.
TEST(TheoryFriction, FindsMuFromTheDisplacement) {
    double const part = std::acos(-1.0) * 0.3 / (2 * 1.5), x = 2 * std::sqrt(1 - part * part);
    auto const answer = ask("friction --machine-number 1.5 --max-relative-displacement " + std::to_string(x) +
                            " --uncertainty 0.01");
    EXPECT_NEAR(answer.at("friction"), 0.3, 1e-4);
    EXPECT_LT(answer.at("friction_low"), 0.3);
    EXPECT_GT(answer.at("friction_high"), 0.3);
    EXPECT_EQ(answer.at("mode"), "PN");
    EXPECT_EQ(answer.at("warning"), "");
    EXPECT_NE(ask("friction --machine-number 0.5 --max-relative-displacement 0.4").at("warning"), "");
    std::string const hardly =
        "friction --machine-number 1.5 --max-relative-displacement 0.01 --uncertainty 0.05";
    EXPECT_TRUE(ask(hardly).at("friction_high").is_null());
    EXPECT_TRUE(ask(hardly).at("friction_uncertainty").is_null());
    EXPECT_NE(run_program("theory " + hardly).text.find("friction  1.429625, 1.328824 or more"),
              std::string::npos);
    EXPECT_NEAR(ask("friction --machine-number 1.5 --friction 0.3").at("max_relative_displacement"), x, 1e-6);
    expect_refused("friction --machine-number 1.5 --max-relative-displacement 2.5",
                   "at machine_number 1.5; write a smaller displacement\n");
    for (char const* const slips : {"--friction 0", "--friction 0.2 --tan-inclination 0.3"})
        expect_refused("friction --machine-number 1.5 " + std::string(slips),
                       "larger than |tan(alpha)|; write a larger --friction\n");
    expect_refused("friction --machine-number 1.5", "--max-relative-displacement is missing");
}

// Eqs. 15, 19, 20, 21. Tolerances: the digits that are given.
TEST(TheoryLimits, PrintsTheClosedResults) {
    auto const answer =
        ask("limits --friction 0.35 --tan-inclination -0.1 --tan-vibration-angle 0.5 --throw-number 0.8");
    EXPECT_NEAR(answer.at("best_throw_number_small_angle"), 2.975, 0.0006);
    EXPECT_NEAR(answer.at("efficiency_at_whole_cycle_flight"), 0.9529, 1e-4);
    EXPECT_NEAR(answer.at("small_angle_efficiency"), 0.434, 0.0005);
    EXPECT_NEAR(answer.at("pn_machine_number_level_small_angle"), 0.652, 0.0005);
    EXPECT_GT(answer.at("best_throw_number"), 2.975);
    auto const point =
        ask("point --throw-number 0.8 --tan-vibration-angle 0.5 --tan-inclination -0.1 --friction 0.35");
    EXPECT_NEAR(answer.at("pn_closed_form").at("velocity_efficiency"), point.at("velocity_efficiency"), 1e-9);
    expect_refused("limits --friction 0.05 --tan-inclination -0.1", "runs away");
}

// v = eta omega r cos(beta). Tolerance: rounding.
TEST(TheoryPoint, PrintsAnEngineersQuantities) {
    auto const answer =
        ask("point --throw-number 2 --vibration-angle '30 deg' --friction 0.3 --amplitude '6 mm' "
            "--layer-height '12 mm' --layer-width '200 mm' --bulk-density '800 kg/m3'");
    double const omega = std::sqrt(2 * 9.81 / (0.006 * 0.5));
    auto const& q = answer.at("quantities");
    double const speed =
        answer.at("velocity_efficiency").get<double>() * omega * 0.006 * std::cos(std::acos(-1.0) / 6);
    EXPECT_NEAR(q.at("conveying_speed").at("value"), speed, 1e-9);
    EXPECT_NEAR(q.at("mass_flow").at("value"), 800 * 0.012 * 0.2 * speed, 1e-9);
    EXPECT_EQ(q.at("conveying_speed").at("units"), "m/s");
    expect_refused("point --throw-number 2 --vibration-angle '30 deg' --friction 0.3 --amplitude 6",
                   "has no unit");
}

// Any two of throw number, frequency and amplitude are a drive: Gamma = (2 pi f)^2 r sin(beta) / g.
// Tolerance: the digits of the frequency in this test.
TEST(TheoryPoint, TakesFrequencyAndStroke) {
    std::string const rest = " --vibration-angle '30 deg' --friction 0.3";
    double const f = std::sqrt(2 * 9.81 / (0.006 * 0.5)) / (2 * std::acos(-1.0));  // 12.871 Hz
    std::string const hertz = std::to_string(f), turns = std::to_string(60 * f);
    auto const reference = ask("point --throw-number 2 --amplitude '6 mm'" + rest);
    double const eta = reference.at("velocity_efficiency"),
                 speed = reference.at("quantities").at("conveying_speed").at("value");
    EXPECT_FALSE(reference.at("quantities").contains("mass_flow")) << "nothing is known of the layer";
    EXPECT_NEAR(reference.at("quantities").at("stroke").at("value"), 12, 1e-12);
    EXPECT_NEAR(reference.at("quantities").at("turns_per_minute").at("value"), 60 * f, 1e-9);
    for (std::string const& drive : {std::string("--throw-number 2 --stroke '12 mm'"),
                                     "--frequency '" + hertz + " Hz' --amplitude '6 mm'",
                                     "--frequency '" + turns + " rpm' --stroke '12 mm'",
                                     "--frequency '" + turns + " 1/min' --stroke '12 mm'",
                                     "--throw-number 2 --frequency '" + hertz + " Hz'"}) {
        auto const answer = ask("point " + drive + rest);
        EXPECT_NEAR(answer.at("velocity_efficiency"), eta, 1e-6) << drive;
        EXPECT_NEAR(answer.at("quantities").at("conveying_speed").at("value"), speed, 1e-6) << drive;
    }
    // K = omega^2 r / g: a sixth of gravity is six times the machine number.
    auto const moon = ask("point --frequency '5 Hz' --stroke '12 mm' --gravity '1.635 m/s2'" + rest);
    EXPECT_NEAR(moon.at("machine_number"), std::pow(2 * std::acos(-1.0) * 5, 2) * 0.006 / 1.635, 1e-12);
    expect_refused("point --throw-number 2 --frequency '12 Hz' --stroke '12 mm'" + rest, "leave one");
    expect_refused("point --frequency '12 Hz'" + rest, "--amplitude is missing");
    expect_refused("point --frequency '75 rad/s' --stroke '12 mm'" + rest, "write 716.2 rpm");
    expect_refused("point --throw-number 2 --stroke '12 mm' --amplitude '6 mm'" + rest, "only one");
    expect_refused("point --throw-number 2 --bulk-density '800 kg/m3'" + rest, "--amplitude");
}

TEST_F(TheoryFiles, BatchRepeatsItsColumnsAndAddsTheAnswers) {
    std::ofstream(path("in.csv")) << "throw_number,tan_vibration_angle,tan_inclination,friction,restitution\n"
                                     "2,0.5,0,0.23,\n1.5,0.25,-0.05,0.23,0.2\n2,0.25,0.3,0.23,\n";
    Answer const answer =
        run_program("theory batch " + path("in.csv") + " --jobs 1 --output " + path("out.csv"));
    EXPECT_EQ(answer.exit_code, 0) << answer.text;
    auto const rows = read_csv(path("out.csv"));
    ASSERT_EQ(rows.size(), 4u);
    EXPECT_EQ(rows[0].back(), "converged");
    EXPECT_EQ(rows[0][0], "throw_number");
    EXPECT_NEAR(std::stod(rows[1][5]), 0.5815, 5e-5);
    EXPECT_EQ(rows[1][7], "FN'");
    EXPECT_NEAR(std::stod(rows[2][5]), 0.477, 0.001);
    EXPECT_EQ(rows[3][5], "-inf");
    EXPECT_EQ(rows[3].back(), "false");
    EXPECT_EQ(run_program("theory batch " + path("in.csv") + " --output " + path("out.h5")).exit_code, 0);
    EXPECT_TRUE(fs::exists(path("out.h5")));
}

// Both commands write 17 digits, which are the number itself: a plastic mass, one with rebounds that has a
// period of 3 cycles, and one that has none.
TEST_F(TheoryFiles, BatchGivesWhatPointGives) {
    std::ofstream(path("in.csv"))
        << "throw_number,tan_vibration_angle,tan_inclination,friction,restitution\n"
           "2,0.5,0,0.23,\n2.85854,0.89676,0.122648,0.139461,0.239105\n4.4,0.5,-0.1,0.35,0.5\n";
    ASSERT_EQ(run_program("theory batch " + path("in.csv") + " --output " + path("out.csv")).exit_code, 0);
    auto const rows = read_csv(path("out.csv"));
    ASSERT_EQ(rows.size(), 4u);
    for (std::size_t i = 1; i < rows.size(); ++i) {
        auto const& row = rows[i];
        std::string const rebounds = row[4].empty() ? "" : " --restitution " + row[4];
        Answer const answer =
            run_program("theory point --throw-number " + row[0] + " --tan-vibration-angle " + row[1] +
                        " --tan-inclination " + row[2] + " --friction " + row[3] + rebounds + " --json");
        auto const point = nlohmann::json::parse(answer.text);
        EXPECT_EQ(point.at("velocity_efficiency").get<double>(), std::stod(row[5])) << i;
        EXPECT_EQ(point.at("half_width").get<double>(), std::stod(row[6])) << i;
        EXPECT_EQ(std::to_string(point.at("period_cycles").get<int>()), row[8]) << i;
    }
}

// A mass that rebounds at half its speed can bounce once a cycle or come to rest between: `point` prints the
// motions, and `batch` and `map` write the same numbers where they are asked for.
TEST_F(TheoryFiles, SeveralMotionsAreSaid) {
    std::string const inputs =
        " --throw-number 1.5176 --tan-vibration-angle 0.6 --friction 0.3 --restitution 0.5";
    Answer const text = run_program("theory point" + inputs);
    EXPECT_NE(text.text.find("several motions"), std::string::npos) << text.text;
    auto const point = nlohmann::json::parse(run_program("theory point --json" + inputs).text);
    auto const& motions = point.at("motions");
    ASSERT_GE(motions.size(), 2u);
    EXPECT_EQ(motions[0].at("velocity_efficiency"), point.at("velocity_efficiency"));
    std::ofstream(path("in.csv"))
        << "throw_number,tan_vibration_angle,friction,restitution\n2,0.5,0.23,\n1.5176,0.6,0.3,0.5\n";
    std::string const batch = "theory batch " + path("in.csv") + " --output " + path("out.csv");
    ASSERT_EQ(run_program(batch + " --starts 64").exit_code, 0);
    auto const rows = read_csv(path("out.csv"));
    ASSERT_EQ(rows[0][9], "motions");
    EXPECT_EQ(rows[0][10] + rows[0][11] + rows[0][12], "efficiency_1fraction_1period_cycles_1");
    EXPECT_EQ(rows[1][9], "1");
    EXPECT_EQ(rows[2][9], std::to_string(motions.size()));
    for (std::size_t k = 0; k < motions.size(); ++k) {
        EXPECT_EQ(std::stod(rows[2][10 + 3 * k]), motions[k].at("velocity_efficiency").get<double>());
        EXPECT_EQ(std::stod(rows[2][11 + 3 * k]), motions[k].at("fraction").get<double>());
    }
    ASSERT_EQ(run_program(batch).exit_code, 0);
    EXPECT_EQ(read_csv(path("out.csv"))[0].back(), "converged") << "nothing more is done without the option";
    EXPECT_EQ(run_program(batch + " --starts 1").exit_code, 2);
    EXPECT_EQ(run_program("theory batch " + path("in.csv") + " --rolling-layer --starts 64 --output " +
                          path("out.csv"))
                  .exit_code,
              2);
    Answer const map = run_program(
        "theory map --x throw_number=1:2:5 --y friction=0.2:0.4:3 --tan-vibration-angle 0.6 --restitution "
        "0.5 "
        "--starts 16 --output " +
        path("map.h5"));
    EXPECT_EQ(map.exit_code, 0) << map.text;
}

// An engineer's columns: f = n / 60, r = stroke / 2, v = eta omega r cos(beta). Tolerance: rounding.
TEST_F(TheoryFiles, BatchTakesTurnsAndStrokes) {
    auto const answer_to = [&](std::string const& text) {
        std::ofstream(path("in.csv")) << text;
        Answer const answer = run_program("theory batch " + path("in.csv") + " --output " + path("out.csv"));
        EXPECT_EQ(answer.exit_code, 0) << answer.text;
        return read_csv(path("out.csv"));
    };
    auto const turns = answer_to("stroke_mm;rpm;vibration_angle_deg;friction\n12;780;30;0,3\n");
    EXPECT_EQ(turns[0], (std::vector<std::string>{"stroke_mm", "rpm", "vibration_angle_deg", "friction",
                                                  "velocity_efficiency", "half_width", "mode",
                                                  "period_cycles", "converged", "conveying_speed_m_per_s"}));
    double const eta = std::stod(turns[1][4]);
    EXPECT_NEAR(std::stod(turns[1][9]), eta * 2 * std::acos(-1.0) * 13 * 0.006 * std::sqrt(3) / 2, 1e-9);
    for (char const* const same : {"amplitude_m,frequency_hz,vibration_angle_deg,friction\n0.006,13,30,0.3\n",
                                   "amplitude_mm,frequency_hz,vibration_angle_deg,friction\n6,13,30,0.3\n"}) {
        EXPECT_NEAR(std::stod(answer_to(same)[1][4]), eta, 1e-9) << same;
    }
    std::string const command = "batch " + path("in.csv") + " --output " + path("out.csv");
    std::ofstream(path("in.csv"))
        << "rpm,frequency_hz,stroke_mm,vibration_angle_deg,friction\n780,13,12,30,0.3\n";
    expect_refused(command, "the columns 'rpm' and 'frequency_hz' are the same input");
    std::ofstream(path("in.csv")) << "rpm,vibration_angle_deg,friction\n780,30,0.3\n";
    expect_refused(command, "frequency_hz also needs amplitude_m or stroke_mm");
    std::ofstream(path("in.csv"))
        << "rpm,amplitude_mm,stroke_mm,vibration_angle_deg,friction\n780,6,12,30,0.3\n";
    expect_refused(command, "give the amplitude or the stroke, not both");
}

// A spreadsheet's file: quotes, also with a comma within, and ; with decimal commas.
TEST_F(TheoryFiles, BatchReadsSpreadsheets) {
    std::string const head = "throw_number,tan_vibration_angle,tan_inclination,friction\n";
    auto const answer_to = [&](std::string const& text) {
        std::ofstream(path("in.csv")) << text;
        Answer const answer = run_program("theory batch " + path("in.csv") + " --output " + path("out.csv"));
        EXPECT_EQ(answer.exit_code, 0) << answer.text;
        return read_csv(path("out.csv"));
    };
    auto const plain = answer_to(head + "2,0.5,-0.05,0.23\n");
    EXPECT_EQ(answer_to(head + "\"2\",\"0.5\",\"-0.05\",\"0.23\"\r\n"), plain);
    EXPECT_EQ(
        answer_to(
            "\xEF\xBB\xBFthrow_number;tan_vibration_angle;tan_inclination;friction\n2;0,5;-0,05;0,23\n"),
        plain);
    std::ofstream(path("in.csv")) << head << "\"2,5\",0.5,0,0.23\n";
    expect_refused("batch " + path("in.csv") + " --output " + path("out.csv"),
                   "in.csv:2: column throw_number: '2,5' is not a finite number");
}

TEST_F(TheoryFiles, BatchRefusesWrongTables) {
    auto const write = [&](char const* text) { std::ofstream(path("in.csv")) << text; };
    std::string const command = "batch " + path("in.csv") + " --output " + path("out.csv");
    write("throw_number,colour\n2,red\n");
    expect_refused(command, "column 'colour'");
    write("throw_number,tan_vibration_angle,friction\n2,0.5\n");
    expect_refused(command, "expected 3 values, one per column, but found 2");
    write("throw_number,tan_vibration_angle,friction\n2,half,0.3\n");
    expect_refused(command, "'half' is not a finite number");
    write("throw_number,friction\n2,0.3\n");
    expect_refused(command, "vibration_angle");
    write("throw_number,tan_vibration_angle,friction\n2,0.5,0.3\n-1,0.5,0.3\n");
    expect_refused(command, "point 2");
    write("");
    expect_refused(command, "the file is empty");
    expect_refused("batch " + path("none.csv") + " --output " + path("out.csv"), "cannot be read");
    expect_refused("batch " + path("in.csv"), "--output is missing");
}

TEST(TheoryHelp, EveryCommandTeachesWithAnExample) {
    for (char const* command : {"point", "map", "trace", "limits", "friction", "batch"}) {
        Answer const answer = run_program(std::string("theory ") + command + " --help");
        EXPECT_EQ(answer.exit_code, 0) << command;
        EXPECT_NE(answer.text.find(std::string("Example:\n  vibrotrough theory ") + command),
                  std::string::npos)
            << command;
    }
}

}  // namespace
}  // namespace vibrotrough
