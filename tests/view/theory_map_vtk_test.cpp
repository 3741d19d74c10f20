#include "view/theory_map_vtk.hpp"

#include "core/temporary_folder.hpp"

#include <filesystem>

#include <gtest/gtest.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLPolyDataReader.h>

namespace vibrotrough::view {
namespace {

// Read back with VTK's own readers. Tolerance: zero, because doubles are stored exactly.
TEST(TheoryMapVtk, IsReadBack) {
    theory::Inputs inputs;
    inputs.set(theory::Input::friction, 0.35);
    theory::Map const map = theory::solve_map(inputs, {theory::Input::throw_number, 0.5, 3, 6},
                                              {theory::Input::vibration_angle_deg, 10, 50, 5}, {.jobs = 1});
    core::TemporaryFolder const own_folder;
    std::filesystem::path const& folder = own_folder.path();
    write_theory_image(folder / "map.vti", map);
    write_theory_boundaries(folder / "modes.vtp", map);
    vtkNew<vtkXMLImageDataReader> image;
    image->SetFileName((folder / "map.vti").c_str());
    image->Update();
    auto* const eta = image->GetOutput()->GetPointData()->GetArray("velocity_efficiency");
    ASSERT_NE(eta, nullptr);
    ASSERT_EQ(eta->GetNumberOfTuples(), 30);
    for (vtkIdType i = 0; i < 30; ++i) {
        EXPECT_EQ(eta->GetTuple1(i), map.points[static_cast<std::size_t>(i)].velocity_efficiency);
    }
    EXPECT_EQ(image->GetOutput()->GetOrigin()[1], 10);
    EXPECT_EQ(image->GetOutput()->GetSpacing()[0], 0.5);
    vtkNew<vtkXMLPolyDataReader> lines;
    lines->SetFileName((folder / "modes.vtp").c_str());
    lines->Update();
    EXPECT_EQ(lines->GetOutput()->GetNumberOfLines(), static_cast<vtkIdType>(map.boundaries.size()));
}

}  // namespace
}  // namespace vibrotrough::view
