#include "view/table_vtk.hpp"

#include "core/atomic_file.hpp"

#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkXMLTableWriter.h>

namespace vibrotrough::view {
namespace {

template <typename Array, typename Value>
vtkSmartPointer<vtkAbstractArray> array_of(std::string const& name, std::vector<Value> const& values) {
    auto array = vtkSmartPointer<Array>::New();
    array->SetName(name.c_str());
    for (Value const& value : values) array->InsertNextValue(value);
    return array;
}

vtkSmartPointer<vtkAbstractArray> array_of(TableColumn const& column) {
    if (auto const* const numbers = std::get_if<std::vector<double>>(&column.values)) {
        return array_of<vtkDoubleArray>(column.name, *numbers);
    }
    return array_of<vtkStringArray>(column.name, std::get<std::vector<std::string>>(column.values));
}

}  // namespace

void write_table(std::filesystem::path const& path, std::vector<TableColumn> const& columns) {
    vtkNew<vtkTable> table;
    for (TableColumn const& column : columns) table->AddColumn(array_of(column));
    vtkNew<vtkXMLTableWriter> writer;
    writer->SetInputData(table);
    writer->SetDataModeToBinary();  // never appended: ParaView 5.11 reads it as empty
    writer->SetCompressorTypeToZLib();
    writer->WriteToOutputStringOn();
    writer->Write();
    core::write_file_atomically(path, writer->GetOutputString());
}

}  // namespace vibrotrough::view
