#include "view/table_vtk.hpp"

#include "core/atomic_file.hpp"

#include <limits>
#include <string>
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
double number_of(std::optional<compare::Value> const& value) {
    if (!value) return unknown_number;
    auto const* const integer = std::get_if<int>(&*value);
    return integer != nullptr ? *integer : std::get<double>(*value);
}

vtkSmartPointer<vtkAbstractArray> array_of(compare::Column const& column, std::vector<Row> const& rows) {
    std::string const name(column.name);
    if (column.type() == compare::ColumnType::text) {
        auto array = vtkSmartPointer<vtkStringArray>::New();
        array->SetName(name.c_str());
        for (Row const& row : rows) {
            auto const value = column.of(row);
            array->InsertNextValue(value ? std::get<std::string>(*value) : "");
        }
        return array;
    }
    auto array = vtkSmartPointer<vtkDoubleArray>::New();
    array->SetName(name.c_str());
    for (Row const& row : rows) array->InsertNextValue(number_of(column.of(row)));
    return array;
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
