#include "compare/table.hpp"

#include "compare/exports.hpp"
#include "store/sample_record.hpp"

#include <algorithm>
#include <numbers>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::compare {
namespace {

using Json = nlohmann::ordered_json;

/// The contract of the issue: scripts read these names.
std::vector<std::string> const contract{"case",
                                        "throw_number",
                                        "machine_number",
                                        "vibration_angle_deg",
                                        "inclination_deg",
                                        "friction",
                                        "amplitude_m",
                                        "stroke_mm",
                                        "frequency_hz",
                                        "turns_per_minute",
                                        "efficiency",
                                        "efficiency_half_width_statistics",
                                        "efficiency_half_width",
                                        "conveying_speed_m_per_s",
                                        "conveying_speed_half_width_m_per_s",
                                        "mass_flow_t_per_h",
                                        "mass_flow_half_width_t_per_h",
                                        "mass_flow_kg_per_s",
                                        "mass_flow_half_width_kg_per_s",
                                        "mass_flow_per_width_t_per_h_m",
                                        "mass_flow_per_width_half_width_t_per_h_m",
                                        "power_per_area_w_per_m2",
                                        "added_mass_per_area_kg_per_m2",
                                        "added_mass_fraction",
                                        "damping_per_area_n_s_per_m3",
                                        "efficiency_theory",
                                        "efficiency_theory_restitution",
                                        "efficiency_theory_restitution_half_width",
                                        "mode_theory_restitution",
                                        "efficiency_rolling_layer",
                                        "mode_theory",
                                        "layer_mode",
                                        "efficiency_by_normal_force",
                                        "landing_friction",
                                        "friction_layer",
                                        "friction_layer_low",
                                        "friction_layer_high",
                                        "efficiency_theory_layer",
                                        "mode_theory_layer",
                                        "packings",
                                        "cycles_measured",
                                        "cycles_discarded",
                                        "wall_time_s",
                                        "outcome",
                                        "efficiency_numerics",
                                        "numerics_source",
                                        "larger_error",
                                        "not_covered",
                                        "soft",
                                        "efficiency_atlas",
                                        "efficiency_atlas_half_width",
                                        "segregation",
                                        "segregation_half_width",
                                        "material_lead",
                                        "material_lead_half_width",
                                        "inflow_t_per_h",
                                        "inflow_half_width_t_per_h",
                                        "outflow_t_per_h",
                                        "outflow_half_width_t_per_h",
                                        "hold_up_kg",
                                        "hold_up_half_width_kg",
                                        "window_depth_mm",
                                        "window_depth_half_width_mm",
                                        "residence_time_s",
                                        "residence_time_half_width_s",
                                        "residence_spread_s",
                                        "residence_spread_half_width_s",
                                        "peclet",
                                        "peclet_half_width",
                                        "fill_time_s",
                                        "fill_time_half_width_s",
                                        "stage_speed_m_per_s",
                                        "stage_speed_half_width_m_per_s",
                                        "time_to_speed_s",
                                        "time_to_speed_half_width_s",
                                        "stopping_distance_m",
                                        "stopping_distance_half_width_m",
                                        "granular_temperature_m2_per_s2",
                                        "granular_temperature_half_width_m2_per_s2",
                                        "screening_efficiency",
                                        "screening_efficiency_half_width",
                                        "screening_efficiency_by_model",
                                        "passed_share",
                                        "passed_share_half_width",
                                        "undersize_share",
                                        "undersize_share_half_width",
                                        "cut_size_mm",
                                        "cut_size_half_width_mm",
                                        "screen_distance_m",
                                        "screen_distance_half_width_m",
                                        "underflow_t_per_h",
                                        "underflow_half_width_t_per_h"};

/// What is known of a case before it has a result: its drive, the theory and the atlas.
std::set<std::string> const known_before{"case",
                                         "throw_number",
                                         "machine_number",
                                         "vibration_angle_deg",
                                         "inclination_deg",
                                         "friction",
                                         "amplitude_m",
                                         "stroke_mm",
                                         "frequency_hz",
                                         "turns_per_minute",
                                         "efficiency_theory",
                                         "efficiency_theory_restitution",
                                         "mode_theory_restitution",
                                         "efficiency_rolling_layer",
                                         "efficiency_atlas",
                                         "efficiency_atlas_half_width",
                                         "mode_theory",
                                         "outcome"};

store::CaseRecord record_at(double degrees, std::string const& outcome) {
    store::CaseRecord record = store::sample_record("0123456789ab");
    record.scenario.trough.vibration_angle = degrees * std::numbers::pi / 180;
    record.outcome = core::outcome_named(outcome).value();
    return record;
}

/// A finished case, one that was never steady, one that failed and one that is open.
std::vector<Row> some_rows() {
    store::CaseRecord const finished = record_at(30, "finished"), unsteady = record_at(10, "not-steady");
    return {compare("0123456789ab", prepare::prepare_case(finished.scenario), finished, ""),
            compare("123456789abc", prepare::prepare_case(unsteady.scenario), unsteady, ""),
            compare("23456789abcd", prepare::prepare_case(finished.scenario), {}, "insertion-incomplete"),
            compare("3456789abcde", prepare::prepare_case(finished.scenario), {}, "open")};
}

std::vector<std::string> lines_of(std::string const& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

/// Split at each separator; an empty last field counts.
std::vector<std::string> fields_of(std::string const& line, char separator) {
    std::vector<std::string> fields(1);
    for (char const c : line) {
        if (c == separator) {
            fields.emplace_back();
        } else {
            fields.back() += c;
        }
    }
    return fields;
}

TEST(Json, HasTheContractsColumns) {
    Json const table = Json::parse(to_json(some_rows()));
    ASSERT_TRUE(table.is_array());
    ASSERT_EQ(table.size(), 4u);
    for (Json const& row : table) {
        for (std::string const& name : contract) EXPECT_TRUE(row.contains(name)) << name;
    }
}

TEST(Json, GivesNumbersInFull) {
    auto const rows = some_rows();
    Json const row = Json::parse(to_json(rows)).at(0);
    EXPECT_EQ(row["case"], "0123456789ab");
    EXPECT_EQ(row["outcome"], "finished");
    EXPECT_EQ(row["vibration_angle_deg"], 30.0);
    EXPECT_NE(to_json(rows).find("\"vibration_angle_deg\": 30.0,"), std::string::npos)
        << "30 is printed as 30";
    // Text and back: the same double.
    EXPECT_EQ(row["efficiency"].get<double>(), rows[0].number("efficiency"));
    EXPECT_EQ(row["efficiency_theory"].get<double>(), rows[0].efficiency_theory);
    EXPECT_EQ(row["conveying_speed_m_per_s"].get<double>(), rows[0].number("conveying_speed").value());
    EXPECT_EQ(row["cycles_measured"].get<int>(), 2);
    EXPECT_TRUE(row["packings"].is_number_integer());
}

TEST(Json, SaysNullOfWhatIsNotKnown) {
    auto rows = some_rows();
    for (Row& row : rows) row.soft.reset();
    Json const table = Json::parse(to_json(rows));
    Json const& unsteady = table.at(1);
    for (char const* name : {"efficiency", "efficiency_half_width_statistics", "conveying_speed_m_per_s"})
        EXPECT_TRUE(unsteady[name].is_null()) << name;
    EXPECT_EQ(unsteady["cycles_discarded"], 2);
    for (std::size_t const without_record : {2, 3}) {
        for (std::string const& name : contract) {
            EXPECT_EQ(table.at(without_record)[name].is_null(), !known_before.contains(name)) << name;
        }
    }
    EXPECT_EQ(table.at(2)["outcome"], "insertion-incomplete");
}

// As the library writes it, also texts that are not UTF-8 or need escapes.
TEST(Json, IsIndentedAsByTheLibrary) {
    auto rows = some_rows();
    rows[0].layer_mode = "\"\\\n\xff\u00b0\x01";
    std::string const text = to_json(rows);
    EXPECT_EQ(text, nlohmann::ordered_json::parse(text).dump(2) + "\n");
}

TEST(Json, OfNoCaseIsAnEmptyArray) {
    EXPECT_EQ(Json::parse(to_json({})), Json::array());
}

TEST(Csv, HasTheColumnsAndValuesOfTheJson) {
    Json const table = Json::parse(to_json(some_rows()));
    auto const lines = lines_of(to_csv(some_rows()));
    ASSERT_EQ(lines.size(), 1 + table.size());
    auto const names = fields_of(lines[0], ',');
    for (std::size_t i = 0; i < table.size(); ++i) {
        auto const fields = fields_of(lines[i + 1], ',');
        ASSERT_EQ(fields.size(), names.size());
        std::size_t column = 0;
        for (auto const& [name, value] : table.at(i).items()) {
            EXPECT_EQ(names[column], name);
            std::string const wanted = value.is_null()     ? ""
                                       : value.is_string() ? value.get<std::string>()
                                                           : value.dump();
            EXPECT_EQ(fields[column], wanted) << name;
            ++column;
        }
        EXPECT_EQ(column, names.size());
    }
}

TEST(Csv, OfNoCaseIsItsHeader) {
    auto const lines = lines_of(to_csv({}));
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(fields_of(lines[0], ',').size(), contract.size());
}

TEST(Table, NamesGrainsThatAreTooSoft) {
    auto rows = some_rows();
    EXPECT_TRUE(rows[0].soft) << "5 MPa, four diameters deep, for an interval of 0.02";
    EXPECT_NE(to_table(rows).find("too soft"), std::string::npos);
    for (Row& row : rows) row.soft.reset();
    EXPECT_EQ(to_table(rows).find("soft"), std::string::npos) << "no column where no grains are too soft";
}

TEST(Table, IsAligned) {
    auto rows = some_rows();
    for (Row& row : rows) row.soft.reset();
    auto const lines = lines_of(to_table(rows));
    ASSERT_EQ(lines.size(), 2u + 4u);
    // Ids and outcomes are flush left, numbers flush right: outcomes begin in one column, and the column
    // before them ends two blanks before it.
    std::size_t const outcome = lines[0].find("outcome");
    std::vector<std::string> const outcomes{"finished", "not-steady", "insertion-incomplete", "open"};
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
        std::string const& line = lines[i + 2];
        ASSERT_GT(line.size(), outcome);
        EXPECT_EQ(line.substr(outcome), outcomes[i]);
        EXPECT_EQ(line.substr(outcome - 2, 2), "  ");
        EXPECT_NE(line[outcome - 3], ' ') << line;
    }
    for (char const* heading :
         {"Gamma", "beta", "alpha", "mu", "f ", "eta DEM", "eta theory", "mode", "speed"})
        EXPECT_NE(lines[0].find(heading), std::string::npos) << heading;
    for (std::string const& line : lines) EXPECT_NE(line.back(), ' ') << "'" << line << "'";
}

TEST(Table, ShowsTheMeasurementBesideTheTheory) {
    auto const rows = some_rows();
    std::string const line = lines_of(to_table(rows))[2];
    std::string const whole = fmt::format("0.820 +- {:.3f}", rows[0].number("efficiency_half_width").value());
    EXPECT_NE(line.find(whole), std::string::npos) << line;
    EXPECT_NE(line.find("  30.00  "), std::string::npos) << line;
    EXPECT_NE(line.find(rows[0].mode_theory.value()), std::string::npos) << line;
    EXPECT_NE(line.find("2+2"), std::string::npos) << line;
    // The difference carries its sign.
    char difference[32];
    std::snprintf(difference, sizeof difference, "%+.3f", 0.82 - rows[0].efficiency_theory.value());
    EXPECT_NE(line.find(difference), std::string::npos) << line;
}

TEST(Table, LeavesOutTheLeastTellingColumnsAndSaysSo) {
    auto rows = some_rows();
    rows[1].throw_number = 1.25;
    for (std::size_t const width : {140, 100, 80, 60}) {
        auto const lines = lines_of(to_table(rows, {.width = width}));
        ASSERT_GE(lines.size(), 2u + 4u + (width < 140 ? 1u : 0u)) << width;
        for (std::size_t i = 0; i < 6; ++i) EXPECT_LE(lines[i].size(), width) << lines[i];
        for (char const* kept : {"case", "eta DEM", "difference"})
            EXPECT_NE(lines[0].find(kept), std::string::npos) << kept;
        if (width < 100) {
            EXPECT_NE(lines.back().find("no room for"), std::string::npos) << lines.back();
        }
    }
    EXPECT_NE(to_table(rows, {.width = 80}).find("\nthe same in all: alpha -2.86 deg"), std::string::npos);
    // Of the columns that go first, those that are the same in all rows go before all others.
    auto const lines = lines_of(to_table(rows, {.width = 110}));
    EXPECT_EQ(lines[0].find("alpha"), std::string::npos);
    EXPECT_NE(lines[0].find("Gamma"), std::string::npos);
    EXPECT_EQ(to_table(rows, {.width = 0}), to_table(rows));
}

// What a machine does is kept on a narrow terminal, and what is left out is named so that it can be told
// apart.
TEST(Table, KeepsTheSpeedOnANarrowTerminal) {
    auto rows = some_rows();
    rows[1].throw_number = 1.25;
    auto const lines = lines_of(to_table(rows, {.width = 80}));
    EXPECT_NE(lines[0].find("speed"), std::string::npos) << lines[0];
    EXPECT_EQ(lines.back().find("mode, mode"), std::string::npos) << lines.back();
    EXPECT_EQ(lines.back().find("+-"), std::string::npos) << lines.back();
}

TEST(Table, ColoursSignAndSizeOfTheDifference) {
    Row row = some_rows()[0];
    row.set("efficiency_half_width", 0.02);
    row.efficiency_theory = 0.5;
    auto const line = [&](double dem) {
        row.set("efficiency", dem);
        return lines_of(to_table({row}, {.colour = true}))[2];
    };
    EXPECT_NE(line(0.7).find("\x1b[1;33m+0.200\x1b[0m"), std::string::npos) << line(0.7);
    EXPECT_NE(line(0.55).find("\x1b[33m+0.050\x1b[0m"), std::string::npos);
    EXPECT_NE(line(0.45).find("\x1b[36m-0.050\x1b[0m"), std::string::npos);
    EXPECT_NE(line(0.3).find("\x1b[1;36m-0.200\x1b[0m"), std::string::npos);
    EXPECT_EQ(line(0.51).find("\x1b["), std::string::npos) << "within the interval";
    EXPECT_NE(to_table({some_rows()[2]}, {.colour = true}).find("\x1b[31minsertion-incomplete\x1b[0m"),
              std::string::npos);
    EXPECT_EQ(to_table(some_rows()).find('\x1b'), std::string::npos);
}

TEST(Table, ShowsADashForWhatIsNotKnown) {
    auto const lines = lines_of(to_table(some_rows()));
    EXPECT_EQ(lines[3].find("+-"), std::string::npos) << "there is no interval of nothing: " << lines[3];
    EXPECT_EQ(lines[5].find("nan"), std::string::npos) << lines[5];
}

// compare --budget: "mean +- statistical +- numerical", a star behind what is expected, and the larger error.
TEST(Table, ShowsBothErrorsInTheBudget) {
    store::CaseRecord const record = store::sample_record("0123456789ab");
    Row own = compare("0123456789ab", prepare::prepare_case(record.scenario), record, "");
    own.set("efficiency_numerics", 0.034);
    own.set("numerics_source", std::string("convergence"));
    Row unknown = own;
    unknown.set("efficiency_numerics", {});
    unknown.set("efficiency_half_width", {});
    Row expected = compare("0123456789ab", prepare::prepare_case(record.scenario), record, "");
    expected.set("efficiency_numerics", 0.055);
    std::string const budget = to_table({own, unknown, expected}, {}, budget_columns());
    EXPECT_NE(budget.find("0.820 +- 0.127 +- 0.055*"), std::string::npos) << budget;
    EXPECT_NE(budget.find("0.820 +- 0.127 +- 0.034 "), std::string::npos) << budget;
    EXPECT_EQ(budget.find("+- -"), std::string::npos) << budget;
    EXPECT_NE(budget.find("  statistical  "), std::string::npos) << budget;
    std::string const table = to_table({own}, {});
    EXPECT_EQ(table.find("0.034"), std::string::npos) << "the plain table has both errors together";
    EXPECT_EQ(table.find("numerical"), std::string::npos);
}

}  // namespace
}  // namespace vibrotrough::compare
