#include "view/theory_map_vtk.hpp"

#include "core/atomic_file.hpp"
#include "view/vtk_files.hpp"

#include <cmath>
#include <initializer_list>
#include <limits>
#include <map>
#include <vector>

#include <vtkCellArray.h>
#include <vtkDataObject.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLImageDataWriter.h>

namespace vibrotrough::view {
namespace {

double spacing(theory::MapAxis const& axis) {
    double const step = axis.count > 1 ? (axis.to - axis.from) / (axis.count - 1) : 1;
    return step != 0 ? step : 1;
}

void mark(vtkDataObject& data) {
    vtkNew<vtkStringArray> array;
    array->SetName(theory_map_mark);
    array->InsertNextValue("written by vibrotrough theory map");
    data.GetFieldData()->AddArray(array);
}

}  // namespace

void write_theory_image(std::filesystem::path const& path, theory::Map const& map) {
    vtkNew<vtkImageData> image;
    image->SetDimensions(map.x.count, map.y.count, 1);
    image->SetOrigin(map.x.from, map.y.from, 0);
    image->SetSpacing(spacing(map.x), spacing(map.y), 1);
    vtkNew<vtkDoubleArray> efficiency;
    efficiency->SetName("velocity_efficiency");
    vtkNew<vtkIntArray> mode, period;
    mode->SetName("mode");
    period->SetName("period_cycles");
    for (vtkDataArray* const array : std::initializer_list<vtkDataArray*>{efficiency, mode, period})
        array->SetNumberOfTuples(static_cast<vtkIdType>(map.points.size()));
    std::vector<theory::ModeCode> modes{0};
    std::map<theory::ModeCode, int> numbers{{0, 0}};
    vtkIdType i = 0;
    for (theory::Efficiency const& point : map.points) {
        double const eta = point.velocity_efficiency;
        efficiency->SetValue(i, std::isfinite(eta) ? eta : std::numeric_limits<double>::quiet_NaN());
        auto const [number, is_new] = numbers.try_emplace(point.mode, static_cast<int>(modes.size()));
        if (is_new) modes.push_back(point.mode);
        mode->SetValue(i, number->second);
        period->SetValue(i, point.period_cycles);
        ++i;
    }
    image->GetPointData()->AddArray(efficiency);
    image->GetPointData()->AddArray(mode);
    image->GetPointData()->AddArray(period);
    image->GetPointData()->SetActiveScalars("velocity_efficiency");
    vtkNew<vtkStringArray> names;
    names->SetName("modes");
    for (theory::ModeCode const code : modes)
        names->InsertNextValue(code == 0 ? "none" : theory::to_string(code));
    image->GetFieldData()->AddArray(names);
    mark(*image);
    vtkNew<vtkXMLImageDataWriter> writer;
    writer->SetInputData(image);
    writer->SetDataModeToBinary();  // not appended: ParaView 5.11 reads appended data as an empty scene
    writer->SetCompressorTypeToZLib();
    writer->SetCompressionLevel(1);  // as for frames: the default takes a fifth of a large map
    writer->WriteToOutputStringOn();
    writer->Write();
    core::write_file_atomically(path, writer->GetOutputString());
}

void write_theory_boundaries(std::filesystem::path const& path, theory::Map const& map) {
    vtkNew<vtkPolyData> lines;
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> cells;
    for (theory::BoundaryPiece const& piece : map.boundaries) {
        vtkIdType const ends[2] = {points->InsertNextPoint(piece.x0, piece.y0, 0),
                                   points->InsertNextPoint(piece.x1, piece.y1, 0)};
        cells->InsertNextCell(2, ends);
    }
    lines->SetPoints(points);
    lines->SetLines(cells);
    mark(*lines);
    write_vtp(path, *lines);
}

}  // namespace vibrotrough::view
