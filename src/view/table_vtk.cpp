#include "view/table_vtk.hpp"

#include "core/atomic_file.hpp"

#include <limits>
#include <string>
#include <type_traits>
#include <variant>

#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkXMLTableWriter.h>

namespace vibrotrough::view {
namespace {

using compare::Row;

constexpr double unknown_number = std::numeric_limits<double>::quiet_NaN();

/// VTK's tables have no word for what is not known.
double vtk_value(std::optional<double> const& value) {
    return value.value_or(unknown_number);
}
double vtk_value(std::optional<int> const& value) {
    return value ? *value : unknown_number;
}
std::string vtk_value(std::optional<std::string> const& value) {
    return value.value_or("");
}

vtkSmartPointer<vtkAbstractArray> array_of(compare::Column const& column, std::vector<Row> const& rows) {
    return std::visit(
        [&](auto const value_of) -> vtkSmartPointer<vtkAbstractArray> {
            using Value = decltype(vtk_value(value_of(rows.front())));
            using Array =
                std::conditional_t<std::is_same_v<Value, std::string>, vtkStringArray, vtkDoubleArray>;
            auto array = vtkSmartPointer<Array>::New();
            array->SetName(std::string(column.name).c_str());
            for (Row const& row : rows) array->InsertNextValue(vtk_value(value_of(row)));
            return array;
        },
        column.value);
}

}  // namespace

void write_table(std::filesystem::path const& path, std::vector<Row> const& rows,
                 std::span<compare::Column const> columns) {
    vtkNew<vtkTable> table;
    for (compare::Column const& column : columns) {
        if (column.in_data) table->AddColumn(array_of(column, rows));
    }
    vtkNew<vtkXMLTableWriter> writer;
    writer->SetInputData(table);
    writer->SetDataModeToBinary();  // never appended: ParaView 5.11 reads it as empty
    writer->SetCompressorTypeToZLib();
    writer->WriteToOutputStringOn();
    writer->Write();
    core::write_file_atomically(path, writer->GetOutputString());
}

}  // namespace vibrotrough::view
