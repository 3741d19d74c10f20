#include "view/table_vtk.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/temporary_folder.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkXMLTableReader.h>

namespace vibrotrough::view {
namespace {

namespace fs = std::filesystem;

TEST(Table, IsReadBackByVtk) {
    core::TemporaryFolder const folder;
    fs::path const path = folder.path() / "table.vtt";
    double constexpr unknown = std::numeric_limits<double>::quiet_NaN();
    write_table(path, {{"case", std::vector<std::string>{"a", "b \xCE\xB2", ""}},
                       {"throw_number", std::vector<double>{1.7, 1e-300, unknown}}});
    EXPECT_EQ(core::read_file(path).find("<AppendedData"), std::string::npos);
    vtkNew<vtkXMLTableReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    vtkTable& table = *reader->GetOutput();
    ASSERT_EQ(table.GetNumberOfRows(), 3);
    ASSERT_EQ(table.GetNumberOfColumns(), 2);
    auto const* const numbers = vtkDoubleArray::SafeDownCast(table.GetColumnByName("throw_number"));
    auto* const texts = vtkStringArray::SafeDownCast(table.GetColumnByName("case"));
    ASSERT_NE(numbers, nullptr);
    ASSERT_NE(texts, nullptr);
    EXPECT_EQ(numbers->GetValue(0), 1.7);
    EXPECT_EQ(numbers->GetValue(1), 1e-300);
    EXPECT_TRUE(std::isnan(numbers->GetValue(2)));
    EXPECT_EQ(texts->GetValue(1), "b \xCE\xB2");
    EXPECT_EQ(texts->GetValue(2), "");
}

TEST(Table, OfNoRowOpens) {
    core::TemporaryFolder const folder;
    fs::path const path = folder.path() / "no_row.vtt";
    write_table(path, {{"throw_number", std::vector<double>{}}});
    vtkNew<vtkXMLTableReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    EXPECT_EQ(reader->GetOutput()->GetNumberOfRows(), 0);
    EXPECT_THROW(write_table("/proc/no/such.vtt", {}), core::MissingError);
}

}  // namespace
}  // namespace vibrotrough::view
