#include "view/point_mass.hpp"

#include "theory/quantities.hpp"
#include "view/frame_writers.hpp"
#include "view/trough_motion.hpp"

#include <cmath>
#include <string>

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkStringArray.h>

namespace vibrotrough::view {
namespace {

void add_vector(vtkPolyData& data, char const* name, std::array<double, 3> const& value) {
    vtkNew<vtkFloatArray> array;
    array->SetName(name);
    array->SetNumberOfComponents(3);
    for (vtkIdType i = 0; i < data.GetNumberOfPoints(); ++i) array->InsertNextTuple(value.data());
    data.GetPointData()->AddArray(array);
}

void add_values(vtkPolyData& data, char const* name, double value) {
    vtkNew<vtkFloatArray> array;
    array->SetName(name);
    for (vtkIdType i = 0; i < data.GetNumberOfPoints(); ++i)
        array->InsertNextValue(static_cast<float>(value));
    data.GetPointData()->AddArray(array);
}

void add_text(vtkPolyData& data, char const* name, std::string const& text) {
    vtkNew<vtkStringArray> array;
    array->SetName(name);
    array->InsertNextValue(text);
    data.GetFieldData()->AddArray(array);
}

/// The eight corners of a cube that stands on the floor, with a copy for each face so that edges are drawn
/// sharp.
constexpr int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                             {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};

}  // namespace

std::string_view in_words(theory::PhaseKind phase) {
    switch (phase) {
        case theory::PhaseKind::rest:
            return "rests";
        case theory::PhaseKind::flight:
            return "flies";
        case theory::PhaseKind::positive_slide:
        case theory::PhaseKind::positive_slide_after_landing:
            return "slides forwards";
        case theory::PhaseKind::negative_slide:
        case theory::PhaseKind::negative_slide_after_landing:
            return "slides backwards";
    }
    return "";
}

PointMassMotion::PointMassMotion(FrameSource const& source, TheoryMotion const& theory)
    : source_(source),
      theory_(theory),
      displacement_at_start_(theory::sample(theory.motion, theory.phase_at_start).displacement) {}

PointMassState PointMassMotion::at(double time) const {
    theory::TraceSample const s =
        theory::sample(theory_.motion, source_.angular_frequency * time + theory_.phase_at_start);
    double const speed_x = source_.angular_frequency * theory_.length_x;
    double const speed_z = source_.angular_frequency * theory_.length_z;
    return {
        .phase = s.kind,
        .x = theory_.length_x * (s.displacement - displacement_at_start_) + trough_state(source_, time).x,
        .gap = theory_.length_z * s.gap,
        .velocity = {speed_x * s.mass_vx, 0.0, speed_z * s.mass_vy},
        .relative_velocity = {speed_x * (s.mass_vx - s.trough_vx), 0.0, speed_z * (s.mass_vy - s.trough_vy)}};
}

PointMassBlock::PointMassBlock(std::array<double, 6> const& trough_bounds)
    : trough_(trough_bounds), edge_(0.2 * std::sqrt((trough_[1] - trough_[0]) * (trough_[3] - trough_[2]))) {}

vtkSmartPointer<vtkPolyData> PointMassBlock::at(PointMassState const& state, double trough_z,
                                                double layer_vx) const {
    double const length = trough_[1] - trough_[0];
    double const travel = 0.5 * length + state.x;
    double const centre_x = trough_[0] + travel - length * std::floor(travel / length);
    double const front = trough_[2] - 1.8 * edge_;
    double const floor = trough_[4] + trough_z + state.gap;
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> cells;
    for (auto const& face : faces) {
        cells->InsertNextCell(4);
        for (int const corner : face) {
            double const x = centre_x + ((corner & 1) != 0 ? 0.5 : -0.5) * edge_;
            double const y = front + ((corner & 2) != 0 ? edge_ : 0.0);
            double const z = floor + ((corner & 4) != 0 ? edge_ : 0.0);
            cells->InsertCellPoint(points->InsertNextPoint(x, y, z));
        }
    }
    auto block = vtkSmartPointer<vtkPolyData>::New();
    block->SetPoints(points);
    block->SetPolys(cells);
    add_vector(*block, "velocity", state.velocity);
    add_vector(*block, "velocity_relative_to_trough", state.relative_velocity);
    add_values(*block, "velocity_from_mean", state.velocity[0] - layer_vx);
    add_text(*block, "phase_of_motion", theory::to_string(state.phase));
    add_text(*block, "motion", std::string(in_words(state.phase)));
    set_number(*block, "gap", state.gap);
    set_number(*block, "displacement", state.x);
    return block;
}

}  // namespace vibrotrough::view
