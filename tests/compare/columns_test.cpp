#include "compare/columns.hpp"

#include "compare/exports.hpp"
#include "compare/select.hpp"
#include "compare/table.hpp"
#include "scenario/example_campaign.hpp"
#include "scenario/reader/campaign_file.hpp"
#include "store/sample_record.hpp"

#include <algorithm>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace vibrotrough::compare {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

/// The program's table and one column more. It is added here and nowhere else, and every view must have it.
std::vector<Column> with_another_column() {
    std::vector<Column> columns(all_columns().begin(), all_columns().end());
    auto const behind = std::ranges::find(columns, "mass_flow_t_per_h", &Column::name);
    columns.insert(behind, {.name = "speed_number",
                            .unit = "1",
                            .value = [](Row const& row) -> std::optional<double> {
                                auto const speed = row.number("conveying_speed");
                                if (!speed) return {};
                                return 100 * *speed;
                            },
                            .meaning = "A hundred times the speed, for the test",
                            .format = "{:.1f}",
                            .terminal = TerminalView{.heading = "hundredfold", .priority = 7},
                            .report = ReportView{.heading = "speed \u00d7 100"}});
    return columns;
}

Row row_of(std::string const& id, std::optional<double> speed) {
    Row row{};
    row.id = id;
    if (speed) row.set("conveying_speed", *speed);
    return row;
}

std::vector<Row> const rows{row_of("a", 0.25), row_of("b", {}), row_of("c", 0.125)};
std::vector<Column> const columns = with_another_column();

TEST(AnotherColumn, IsInJsonAndCsv) {
    auto const json = nlohmann::json::parse(to_json(rows, columns));
    EXPECT_EQ(json.at(0).at("speed_number"), 25.0);
    EXPECT_TRUE(json.at(1).at("speed_number").is_null());
    EXPECT_THAT(to_csv(rows, columns), HasSubstr(",speed_number,"));
    EXPECT_THAT(to_csv(rows, columns), HasSubstr(",12.5,"));
}

TEST(AnotherColumn, IsInTheTerminalsTableBehindTheSpeed) {
    std::string const table = to_table(rows, {}, columns);
    EXPECT_LT(table.find("speed"), table.find("hundredfold"));
    EXPECT_LT(table.find("hundredfold"), table.find("cycles"));
    EXPECT_THAT(table, HasSubstr("  25.0  "));
    EXPECT_THAT(to_table(rows, {.width = 30}, columns), HasSubstr("hundredfold")) << "named as left out";
}

TEST(AnotherColumn, FiltersAndSorts) {
    auto const kept = filtered(rows, "speed_number>20", columns);
    ASSERT_EQ(kept.size(), 1u);
    EXPECT_EQ(kept[0].id, "a");
    auto const order = sorted(rows, "speed_number", columns);
    EXPECT_EQ(order[0].id + order[1].id + order[2].id, "cab") << "unknown comes last";
}

TEST(AnotherColumn, IsInTheReportAndInTheReadme) {
    auto const all = column_descriptions(columns);
    auto const added =
        std::ranges::find_if(all, [](auto const& one) { return one.at("name") == "speed_number"; });
    ASSERT_NE(added, all.end());
    EXPECT_EQ(added->at("meaning"), "A hundred times the speed, for the test");
    EXPECT_EQ(added->at("report").at("heading"), "speed \u00d7 100");
    EXPECT_EQ(to_object(rows[0], columns).at("speed_number"), 25.0);
    EXPECT_THAT(column_reference(columns), HasSubstr("| `speed_number` | 1 | number | data, terminal, report "
                                                     "| A hundred times the speed, for the test |\n"));
}

// A person's own number has a column for itself and one for its interval in every view, and none when the
// program has that name.
TEST(ObservedColumns, AreInEveryView) {
    store::Observable const number{"temperature", "m2/s2", "Granular temperature", "", "", "", "", "", {}};
    store::Observable curve = number, taken = number;
    curve.name = "profile";
    curve.over = "height";
    taken.name = "efficiency";
    std::vector<Column> all(all_columns().begin(), all_columns().end());
    std::size_t const before = all.size();
    add_observed(all, std::vector{curve, taken, number});
    ASSERT_EQ(all.size(), before + 2);
    Row row = drive_row("case",
                        prepare::prepare_case(scenario::parse_campaign(example_campaign, "c.toml").cases[0]));
    row.observed = {{}, {}, {}, {}, 0.25, 0.125};
    std::vector const table{row};
    EXPECT_THAT(to_csv(table, all),
                HasSubstr(",temperature_m2_per_s2,temperature_half_width_m2_per_s2,outcome,"));
    auto const json = nlohmann::json::parse(to_json(table, all));
    EXPECT_EQ(json.at(0).at("temperature_m2_per_s2"), 0.25);
    EXPECT_EQ(json.at(0).at("temperature_half_width_m2_per_s2"), 0.125);
    EXPECT_THAT(to_table(table, {}, all), HasSubstr("temperature     +-"));
    EXPECT_EQ(filtered(table, "temperature>0.2", all).size(), 1u) << "also without its unit";
    EXPECT_EQ(filtered(table, "temperature>0.3", all).size(), 0u);
    EXPECT_EQ(column_descriptions(all).at(before - 3).at("meaning"), "Granular temperature");
    for (char const* name : {"efficiency", "conveying_speed", "speed", "layer_mode", "throw_number"})
        EXPECT_TRUE(is_name_of_program(name, "1")) << name;
    EXPECT_TRUE(is_name_of_program("wall_time", "s"));
    EXPECT_FALSE(is_name_of_program("temperature", "m2/s2"));
}

/// The columns of a campaign with these sections and the rows of its cases.
struct SweptTable {
    explicit SweptTable(std::string const& sections)
        : campaign(scenario::parse_campaign(example_campaign + sections, "c.toml")),
          columns(columns_with_swept(campaign.swept)) {
        for (scenario::Scenario const& one : campaign.cases) {
            rows.push_back(compare("case", prepare::prepare_case(one), {}, "open"));
            for (scenario::Key const* const key : campaign.swept)
                rows.back().swept.push_back(swept_value(one, *key));
        }
    }
    scenario::Campaign campaign;
    std::vector<Column> columns;
    std::vector<Row> rows;
};

// A heading stands above millimetres, a name above metres.
TEST(SweptColumns, AreFilteredInTheUnitOfTheirName) {
    SweptTable const table("[sweep]\n\"trough.amplitude\" = [\"3 mm\", \"5 mm\"]\n");
    EXPECT_EQ(filtered(table.rows, "r>4", table.columns).size(), 1u);
    EXPECT_EQ(filtered(table.rows, "amplitude>0.004", table.columns).size(), 1u);
    EXPECT_EQ(filtered(table.rows, "amplitude_m>0.004", table.columns).size(), 1u);
}

// Whatever key is swept has a column in every view, and a name for --filter and --sort.
TEST(SweptColumns, AreInEveryView) {
    SweptTable const table(
        "[sweep]\n\"grains.friction\" = [0.3, 0.5]\n\"layer.height\" = [\"9 mm\", \"12 mm\"]\n"
        "\"trough.along_phase\" = [\"0 deg\", \"30 deg\"]\n\"grains.rotation\" = [\"free\", \"blocked\"]\n");
    ASSERT_EQ(table.rows.size(), 16u);
    auto const json = nlohmann::json::parse(to_json(table.rows, table.columns));
    EXPECT_EQ(json.at(15).at("grains.friction"), 0.5);
    EXPECT_EQ(json.at(15).at("layer.height"), 0.012) << "data are in SI units";
    EXPECT_EQ(json.at(15).at("trough.along_phase"), 30.0) << "but angles in degrees, as elsewhere";
    EXPECT_EQ(json.at(15).at("grains.rotation"), "blocked");
    EXPECT_THAT(
        to_csv(table.rows, table.columns),
        HasSubstr("case,grains.friction,layer.height,trough.along_phase,grains.rotation,throw_number,"));
    std::string const text = to_table(table.rows, {}, table.columns);
    EXPECT_THAT(text, HasSubstr("friction  height  along_phase   rotation  Gamma"));
    EXPECT_THAT(text, HasSubstr("of grains      mm          deg"));
    EXPECT_THAT(text, HasSubstr(" 0.5      12           30    blocked"));
    EXPECT_EQ(filtered(table.rows, "grains.friction>0.4", table.columns).size(), 8u);
    EXPECT_EQ(filtered(table.rows, "height<0.01", table.columns).size(), 8u) << "without its section";
    EXPECT_EQ(filtered(table.rows, "rotation=free", table.columns).size(), 8u);
    EXPECT_EQ(filtered(table.rows, "friction>0.4", table.columns).size(), 0u) << "the trough's comes first";
    EXPECT_EQ(filtered(table.rows, "trough.friction<0.4", table.columns).size(), 16u);
    auto const order = sorted(table.rows, "layer.height:desc", table.columns);
    EXPECT_EQ(std::get<double>(*order.front().swept[1]), 0.012);
    auto const described = column_descriptions(table.columns);
    EXPECT_EQ(described.at(2).at("name"), "layer.height");
    EXPECT_EQ(described.at(2).at("report").at("factor"), 1e3);
    EXPECT_EQ(described.at(2).at("report").at("shown_unit"), "mm");
}

// The terminal has both theories only where the restitution is swept; the data always have them.
TEST(SweptColumns, ARestitutionIsBesideBothTheories) {
    SweptTable const swept("[sweep]\n\"trough.restitution\" = [0.2, 1.0]\n"), other("");
    std::string const text = to_table(swept.rows, {}, swept.columns);
    EXPECT_THAT(text, HasSubstr("eta theory   eta theory"));
    EXPECT_THAT(text, HasSubstr("   plastic  restitution"));
    EXPECT_THAT(to_table(other.rows, {}, other.columns), Not(HasSubstr("plastic")));
    EXPECT_THAT(
        to_csv(other.rows, other.columns),
        HasSubstr(
            ",efficiency_theory,efficiency_theory_restitution,efficiency_theory_restitution_half_width,"));
    EXPECT_FALSE(is_without_restitution(swept.rows[0]));
    EXPECT_TRUE(is_without_restitution(swept.rows[1])) << "the theory takes up to 0.95";
    EXPECT_NE(swept.rows[0].efficiency_theory_restitution, swept.rows[0].efficiency_theory);
    EXPECT_EQ(swept.rows[0].efficiency_theory, swept.rows[1].efficiency_theory);
}

// A key that always has a column gets no second one; the column comes first and is left out last.
TEST(SweptColumns, OfTheDriveAreTheUsualOnes) {
    SweptTable const table(
        "[sweep]\n\"trough.stroke\" = [\"8 mm\", \"12 mm\"]\n\"trough.friction\" = [0.2, 0.3]\n");
    EXPECT_EQ(table.columns.size(), all_columns().size());
    std::string const text = to_table(table.rows, {.width = 60}, table.columns);
    EXPECT_THAT(text, HasSubstr("case  stroke   mu"));
    EXPECT_THAT(text, HasSubstr("open"));
}

TEST(Columns, HaveNamesOfTheirOwnAndMeanings) {
    std::set<std::string_view> names;
    for (Column const& column : all_columns()) {
        EXPECT_TRUE(names.insert(column.name).second) << column.name;
        EXPECT_FALSE(column.meaning.empty() || column.unit.empty()) << column.name;
    }
}

// Whoever draws the obvious column must not have bars that are too short.
TEST(Columns, AHalfWidthIsTheWholeWhateverIsNumerical) {
    store::CaseRecord const record = store::sample_record("0123456789ab");
    auto const prepared = prepare::prepare_case(record.scenario);
    Row const row = compare(record.id, prepared, record, "finished");
    double const whole = row.number("efficiency_half_width").value(),
                 statistics = row.number("efficiency_half_width_statistics").value(),
                 numerics = row.number("efficiency_numerics").value();
    EXPECT_NEAR(whole, std::hypot(statistics, numerics), 1e-15);
    EXPECT_GT(whole, statistics);
    for (Column const& column : all_columns()) {
        std::string number = column.name;
        auto const at = number.find("_half_width");
        if (at == number.npos || number.ends_with("_statistics")) continue;
        number.erase(at, std::string_view("_half_width").size());
        auto const found = std::ranges::find(all_columns(), number, &Column::name);
        ASSERT_NE(found, all_columns().end()) << column.name;
        bool const follows = number.starts_with("conveying_speed") || number.starts_with("mass_flow");
        auto const value = found->of(row), width = column.of(row);
        if (!follows || !value) continue;
        EXPECT_NEAR(std::get<double>(*width) / std::get<double>(*value),
                    whole / row.number("efficiency").value(), 1e-12)
            << column.name;
    }
}

TEST(Columns, KnowWhatIsNotKnown) {
    store::CaseRecord const record = store::sample_record("0123456789ab");
    Row const known = compare("0123456789ab", prepare::prepare_case(record.scenario), record, "",
                              MeasuredFriction{0.2, 0.1, 0.3});
    Row const open = compare("0123456789ab", prepare::prepare_case(record.scenario), {}, "open");
    for (Column const& column : all_columns()) {
        EXPECT_EQ(column.shown(known) == "-", !column.of(known)) << column.name;
        EXPECT_FALSE(column.shown(known).empty()) << column.name;
    }
    auto const column = std::ranges::find(all_columns(), "efficiency", &Column::name);
    EXPECT_EQ(column->shown(known), "0.820");
    EXPECT_EQ(column->shown(open), "-");
}

}  // namespace
}  // namespace vibrotrough::compare
