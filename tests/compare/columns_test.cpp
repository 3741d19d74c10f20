#include "compare/columns.hpp"

#include "compare/exports.hpp"
#include "compare/select.hpp"
#include "compare/table.hpp"
#include "core/atomic_file.hpp"
#include "store/sample_record.hpp"
#include "view/table_vtk.hpp"

#include <algorithm>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkTable.h>
#include <vtkXMLTableReader.h>

namespace vibrotrough::compare {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// The program's table and one column more. It is added here and nowhere else, and every view must have it.
std::vector<Column> with_another_column() {
    std::vector<Column> columns(all_columns().begin(), all_columns().end());
    columns.push_back({.name = "speed_number",
                       .unit = "1",
                       .value = [](Row const& row) -> std::optional<double> {
                           if (!row.speed_dem_m_per_s) return {};
                           return 100 * *row.speed_dem_m_per_s;
                       },
                       .meaning = "A hundred times the speed, for the test",
                       .format = "{:.1f}",
                       .position = 165,
                       .terminal = TerminalView{.heading = "hundredfold", .priority = 7},
                       .report = ReportView{.heading = "speed \u00d7 100"}});
    return columns;
}

Row row_of(std::string const& id, std::optional<double> speed) {
    Row row{};
    row.id = id;
    row.speed_dem_m_per_s = speed;
    return row;
}

std::vector<Row> const rows{row_of("a", 0.25), row_of("b", {}), row_of("c", 0.125)};
std::vector<Column> const columns = with_another_column();

TEST(AnotherColumn, IsInJsonAndCsv) {
    auto const json = nlohmann::json::parse(to_json(rows, columns));
    EXPECT_EQ(json.at(0).at("speed_number"), 25.0);
    EXPECT_TRUE(json.at(1).at("speed_number").is_null());
    EXPECT_THAT(to_csv(rows, columns), HasSubstr(",speed_number\n"));
    EXPECT_THAT(to_csv(rows, columns), HasSubstr(",12.5\n"));
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

TEST(AnotherColumn, IsInTheVtkTable) {
    fs::path const path = fs::path(testing::TempDir()) / ("columns_" + std::to_string(::getpid()) + ".vtt");
    view::write_table(path, rows, columns);
    vtkNew<vtkXMLTableReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    auto const* const array =
        vtkDoubleArray::SafeDownCast(reader->GetOutput()->GetColumnByName("speed_number"));
    ASSERT_NE(array, nullptr);
    EXPECT_EQ(array->GetValue(2), 12.5);
    fs::remove(path);
}

TEST(AnotherColumn, IsInTheReportAndInTheReadme) {
    auto const last = column_descriptions(columns).back();
    EXPECT_EQ(last.at("name"), "speed_number");
    EXPECT_EQ(last.at("meaning"), "A hundred times the speed, for the test");
    EXPECT_EQ(last.at("report").at("heading"), "speed \u00d7 100");
    EXPECT_EQ(to_object(rows[0], columns).at("speed_number"), 25.0);
    EXPECT_THAT(column_reference(columns), HasSubstr("| `speed_number` | 1 | number | data, terminal, report "
                                                     "| A hundred times the speed, for the test |\n"));
}

// The list in the README is the program's own table: a second copy that drifts fails here.
TEST(Columns, AreInTheReadme) {
    EXPECT_NE(core::read_file(README_FILE).find(column_reference()), std::string::npos)
        << "write this into src/compare/README.md:\n"
        << column_reference();
}

TEST(Columns, HaveNamesOfTheirOwnAndMeanings) {
    std::set<std::string_view> names;
    std::set<int> positions;
    for (Column const& column : all_columns()) {
        EXPECT_TRUE(names.insert(column.name).second) << column.name;
        EXPECT_FALSE(column.meaning.empty() || column.unit.empty()) << column.name;
        if (!column.terminal && !column.report) continue;
        EXPECT_TRUE(positions.insert(column.position).second) << column.name;
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
    auto const column = std::ranges::find(all_columns(), "efficiency_dem", &Column::name);
    EXPECT_EQ(column->shown(known), "0.820");
    EXPECT_EQ(column->shown(open), "-");
}

}  // namespace
}  // namespace vibrotrough::compare
