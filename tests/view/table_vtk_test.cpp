#include "view/table_vtk.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/temporary_folder.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkXMLTableReader.h>

namespace vibrotrough::view {
namespace {

namespace fs = std::filesystem;

compare::Row row_of(std::string const& id, double throw_number) {
    compare::Row row{};
    row.id = id;
    row.throw_number = throw_number;
    return row;
}

TEST(Table, IsReadBackByVtk) {
    core::TemporaryFolder const folder;
    fs::path const path = folder.path() / "table.vtt";
    std::vector<compare::Row> rows{row_of("a", 1.7), row_of("b \xCE\xB2", 1e-300), row_of("", 2)};
    rows[1].layer_mode = "FP'N";
    rows[1].set("packings", 3);
    rows[1].set("efficiency", 0.5);
    write_table(path, rows);
    EXPECT_EQ(core::read_file(path).find("<AppendedData"), std::string::npos);
    vtkNew<vtkXMLTableReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    vtkTable& table = *reader->GetOutput();
    ASSERT_EQ(table.GetNumberOfRows(), 3);
    EXPECT_EQ(table.GetColumnByName("difference"), nullptr) << "the columns are those of the JSON";
    auto const* const numbers = vtkDoubleArray::SafeDownCast(table.GetColumnByName("throw_number"));
    auto* const texts = vtkStringArray::SafeDownCast(table.GetColumnByName("case"));
    ASSERT_NE(numbers, nullptr);
    ASSERT_NE(texts, nullptr);
    EXPECT_EQ(numbers->GetValue(0), 1.7);
    EXPECT_EQ(numbers->GetValue(1), 1e-300);
    auto const* const efficiencies = vtkDoubleArray::SafeDownCast(table.GetColumnByName("efficiency"));
    auto const* const packings = vtkDoubleArray::SafeDownCast(table.GetColumnByName("packings"));
    auto* const modes = vtkStringArray::SafeDownCast(table.GetColumnByName("layer_mode"));
    ASSERT_TRUE(efficiencies != nullptr && packings != nullptr && modes != nullptr);
    EXPECT_EQ(efficiencies->GetValue(1), 0.5);
    EXPECT_EQ(packings->GetValue(1), 3);
    EXPECT_EQ(modes->GetValue(1), "FP'N");
    EXPECT_TRUE(std::isnan(efficiencies->GetValue(0)) && std::isnan(packings->GetValue(0))) << "not known";
    EXPECT_EQ(modes->GetValue(0), "") << "not known";
    EXPECT_EQ(texts->GetValue(1), "b \xCE\xB2");
    EXPECT_EQ(texts->GetValue(2), "");
}

TEST(Table, OfNoRowOpens) {
    core::TemporaryFolder const folder;
    fs::path const path = folder.path() / "no_row.vtt";
    write_table(path, {});
    vtkNew<vtkXMLTableReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    EXPECT_EQ(reader->GetOutput()->GetNumberOfRows(), 0);
    EXPECT_THROW(write_table("/proc/no/such.vtt", {}), core::MissingError);
}

}  // namespace
}  // namespace vibrotrough::view
