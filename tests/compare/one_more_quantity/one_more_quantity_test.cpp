#include "compare/exports.hpp"
#include "compare/select.hpp"
#include "compare/table.hpp"
#include "core/atomic_file.hpp"
#include "store/hdf5_memory_file.hpp"
#include "store/reference.hpp"
#include "store/result_file.hpp"
#include "store/sample_record.hpp"
#include "store/summary.hpp"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#ifdef COMPARE_TEST_WITH_VTK
#include "view/table_vtk.hpp"

#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkTable.h>
#include <vtkXMLTableReader.h>
#endif

// This program is the rooms store and compare with one quantity more, test_mass, which add_quantity.cmake
// adds as one row. Nothing else knows it, and it is in every place in which a quantity is.
namespace vibrotrough::compare {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

store::CaseRecord const record = store::sample_record("0123456789ab");
double const first = *record.packings[0].motion.added_mass, second = *record.packings[1].motion.added_mass;
double const mean = (first + second) / 2;

std::vector<Row> rows() {
    auto const prepared = prepare::prepare_case(record.scenario);
    return {compare("0123456789ab", prepared, record, ""), compare("123456789abc", prepared, {}, "open")};
}

fs::path temporary(std::string const& name) {
    return fs::path(testing::TempDir()) / (std::to_string(::getpid()) + name);
}

TEST(OneMoreQuantity, IsInTheResultOfTheCaseAndItsPackings) {
    fs::path const path = temporary("result.h5");
    store::write_result(path, record);
    {  // only one file at a time is open
        store::Hdf5MemoryFileReader const file(core::read_file(path));
        EXPECT_EQ(file.table("case", store::Rank::scalar).values<double>("test_mass"), std::vector{mean});
        EXPECT_EQ(file.table("packings", store::Rank::array).values<double>("test_mass"),
                  (std::vector{first, second}));
    }
    EXPECT_EQ(store::read_result(path).packings[1].motion.added_mass, second);
    fs::remove(path);
}

TEST(OneMoreQuantity, IsInTheCampaignsTableAndInSummaries) {
    std::string const bytes = store::campaign_bytes("sample", std::span(&record, 1));
    store::Hdf5MemoryFileReader const file(bytes);
    EXPECT_EQ(file.values<double>("test_mass", store::Rank::array), std::vector{mean});
    EXPECT_THAT(store::summary_layout(), HasSubstr(" test_mass")) << "caches without it are outdated";
    auto const summary = store::unpack_summary(store::pack_summary(record), record.scenario);
    EXPECT_EQ(summary.packings[0].motion.added_mass, first);
}

TEST(OneMoreQuantity, IsInJsonAndCsvBehindTheOtherColumns) {
    auto const json = nlohmann::json::parse(to_json(rows()));
    EXPECT_EQ(json.at(0).at("test_mass_kg"), mean);
    EXPECT_TRUE(json.at(1).at("test_mass_kg").is_null()) << "an open case has none";
    EXPECT_THAT(to_csv(rows()), HasSubstr(",test_mass_kg\n"));
}

TEST(OneMoreQuantity, IsInTablesForPeople) {
    std::string const table = to_table(rows());
    EXPECT_THAT(table, HasSubstr("test mass"));
    EXPECT_LT(table.find("speed"), table.find("test mass"));
    auto const all = column_descriptions();
    auto const column =
        std::ranges::find_if(all, [](auto const& one) { return one.at("name") == "test_mass_kg"; });
    ASSERT_NE(column, all.end());
    EXPECT_EQ(column->at("report").at("heading"), "mass of the test");
    EXPECT_EQ(column->at("meaning"), "A mass of this test; mean over the packings");
}

TEST(OneMoreQuantity, FiltersAndSorts) {
    EXPECT_EQ(filtered(rows(), "test_mass_kg>0").size(), 1u);
    EXPECT_EQ(filtered(rows(), "test_mass_kg<0").size(), 0u);
    EXPECT_EQ(sorted(rows(), "test_mass_kg:desc").front().id, "0123456789ab");
}

TEST(OneMoreQuantity, IsInTheReference) {
    EXPECT_THAT(
        store::file_reference(),
        HasSubstr(
            "| `case/test_mass` | float64 | scalar | kg | A mass of this test; mean over the packings |"));
    EXPECT_THAT(store::file_reference(),
                HasSubstr("| `packings/test_mass` | float64 | packings | kg | A mass of this test |"));
    EXPECT_THAT(column_reference(), HasSubstr("| `test_mass_kg` | kg | number | data, terminal, report |"));
}

#ifdef COMPARE_TEST_WITH_VTK
TEST(OneMoreQuantity, IsInTheVtkTable) {
    fs::path const path = temporary("table.vtt");
    view::write_table(path, rows());
    vtkNew<vtkXMLTableReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    auto const* const array =
        vtkDoubleArray::SafeDownCast(reader->GetOutput()->GetColumnByName("test_mass_kg"));
    ASSERT_NE(array, nullptr);
    EXPECT_EQ(array->GetValue(0), mean);
    fs::remove(path);
}
#endif

}  // namespace
}  // namespace vibrotrough::compare
