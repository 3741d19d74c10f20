#include "view/frame_writers.hpp"

#include "view/profile.hpp"
#include "view/vtk_files.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkTypeInt32Array.h>

namespace vibrotrough::view {
namespace {

/// A VTK array that refers to the values without owning them.
template <typename Array, typename Value>
vtkSmartPointer<Array> view_of(std::vector<Value>& values, char const* name, int components) {
    auto array = vtkSmartPointer<Array>::New();
    array->SetName(name);
    array->SetNumberOfComponents(components);
    array->SetArray(values.data(), static_cast<vtkIdType>(values.size()), 1);
    return array;
}

/// One vertex cell per grain, because ParaView does not show points without cells.
void set_vertices(vtkPolyData& data, std::size_t grains) {
    if (data.GetNumberOfVerts() == static_cast<vtkIdType>(grains)) return;
    vtkNew<vtkTypeInt32Array> offsets;
    vtkNew<vtkTypeInt32Array> points;
    for (int i = 0; i <= static_cast<int>(grains); ++i) offsets->InsertNextValue(i);
    for (int i = 0; i < static_cast<int>(grains); ++i) points->InsertNextValue(i);
    vtkNew<vtkCellArray> vertices;
    vertices->SetData(offsets, points);
    data.SetVerts(vertices);
}

/// m/s, mean velocity along the trough, each grain counted with its volume; 0 without grains.
double mean_velocity_of(GrainFrame const& frame) {
    double volume = 0.0, flow = 0.0;
    for (std::size_t i = 0; i < frame.grains(); ++i) {
        double const cube = std::pow(static_cast<double>(frame.radius[i]), 3);
        volume += cube;
        flow += cube * frame.velocity[3 * i];
    }
    return volume > 0.0 ? flow / volume : 0.0;
}

// What is there for colours is rounded to what an eye can tell, so that the files stay small: their exact
// values follow from `velocity` and the points.
constexpr double speed_grain = 1.0 / (1 << 14), height_grain = 1.0 / (1 << 17);  // m/s, m

float rounded(double value, double grain) {
    return static_cast<float>(std::round(value / grain) * grain);
}

/// The triangles of two meshes.
vtkSmartPointer<vtkPolyData> joined(vtkPolyData& one, vtkPolyData& other) {
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> triangles;
    for (vtkPolyData* const mesh : {&one, &other}) {
        vtkIdType const before = points->GetNumberOfPoints();
        for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i) points->InsertNextPoint(mesh->GetPoint(i));
        for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i) {
            vtkIdType corners = 0;
            vtkIdType const* nodes = nullptr;
            mesh->GetCellPoints(i, corners, nodes);
            triangles->InsertNextCell(3);
            for (vtkIdType k = 0; k < 3; ++k) triangles->InsertCellPoint(before + nodes[k]);
        }
    }
    auto all = vtkSmartPointer<vtkPolyData>::New();
    all->SetPoints(points);
    all->SetPolys(triangles);
    return all;
}

}  // namespace

void set_number(vtkPolyData& data, char const* name, double number) {
    vtkNew<vtkDoubleArray> value;
    value->SetName(name);
    value->InsertNextValue(number);
    data.GetFieldData()->AddArray(value);
}

void set_time(vtkPolyData& data, FrameSource const& source, double time) {
    // Frames are at whole steps: if rounding puts a frame just before the end of a cycle, it belongs to the
    // next cycle, and to its stage.
    constexpr double rounding = 1e-9;
    double turns = source.angular_frequency * time / (2.0 * std::numbers::pi);
    set_number(data, "TimeValue", time);
    if (!source.parts.empty()) {
        scenario::DrivePart const& part = part_at(source.parts, time + rounding / source.parts[0].frequency);
        turns = part.first_cycle + (time - part.start) / part.cycle_time();
        set_number(data, "stage", part.stage + 1);
    }
    double const cycle = std::floor(turns + rounding);
    set_number(data, "cycle", cycle);
    set_number(data, "vibration_phase", 360.0 * std::max(0.0, turns - cycle));
}

void GrainWriter::write(std::filesystem::path const& path, GrainFrame& frame, double surface, double time) {
    TroughState const trough = trough_state(source_, time);
    auto const trough_x = static_cast<float>(trough.vx);
    auto const trough_z = static_cast<float>(trough.vz);
    mean_velocity_ = mean_velocity_of(frame);
    std::size_t const grains = frame.grains();
    bool const spins = frame.spin.size() == 3 * grains;
    relative_ = frame.velocity;
    from_mean_.resize(grains);
    height_.resize(grains);
    turns_.resize(spins ? grains : 0);
    for (std::size_t i = 0; i < grains; ++i) {
        from_mean_[i] = rounded(frame.velocity[3 * i] - mean_velocity_, speed_grain);
        height_[i] = rounded(frame.position[3 * i + 2] - surface, height_grain);
        if (spins) turns_[i] = static_cast<float>(frame.spin[3 * i + 1] / source_.angular_frequency);
        relative_[3 * i] -= trough_x;
        relative_[3 * i + 2] -= trough_z;
    }
    scales_.add(from_mean_, turns_, height_);
    for (std::size_t i = 0; i < grains; ++i) {
        float const* const p = &frame.position[3 * i];
        double const r = frame.radius[i];
        if (!space_) space_ = {p[0] - r, p[0] + r, p[2] - r, p[2] + r};
        space_ = {std::min(space_->left, p[0] - r), std::max(space_->right, p[0] + r),
                  std::min(space_->bottom, p[2] - r), std::max(space_->top, p[2] + r)};
    }

    vtkNew<vtkPoints> points;
    points->SetData(view_of<vtkFloatArray>(frame.position, "Points", 3));
    data_->SetPoints(points);
    set_vertices(*data_, grains);
    vtkPointData& values = *data_->GetPointData();
    values.AddArray(view_of<vtkFloatArray>(frame.radius, "radius", 1));
    values.AddArray(view_of<vtkFloatArray>(frame.velocity, "velocity", 3));
    values.AddArray(view_of<vtkFloatArray>(relative_, "velocity_relative_to_trough", 3));
    values.AddArray(view_of<vtkFloatArray>(from_mean_, "velocity_from_mean", 1));
    values.AddArray(view_of<vtkFloatArray>(height_, "height", 1));
    values.RemoveArray("type");
    if (!source_.materials.empty() && frame.type.size() == grains)
        values.AddArray(view_of<vtkIntArray>(frame.type, "type", 1));
    values.RemoveArray("spin");
    values.RemoveArray("spin_over_omega");
    if (spins) {
        values.AddArray(view_of<vtkFloatArray>(frame.spin, "spin", 3));
        values.AddArray(view_of<vtkFloatArray>(turns_, "spin_over_omega", 1));
    }
    values.AddArray(view_of<vtkIntArray>(frame.id, "id", 1));
    set_time(*data_, source_, time);
    write_vtp(path, *data_);
}

TroughWriter::TroughWriter(FrameSource const& source, std::vector<std::filesystem::path> const& meshes)
    : source_(source) {
    for (auto const& path : meshes) {
        auto const mesh = read_stl(path);
        part_.insert(part_.end(), static_cast<std::size_t>(mesh->GetNumberOfCells()),
                     static_cast<int>(&path - meshes.data()));
        rest_ = rest_ ? joined(*rest_, *mesh) : mesh;
    }
    moved_->ShallowCopy(rest_);
    if (meshes.size() > 1) moved_->GetCellData()->AddArray(view_of<vtkIntArray>(part_, "part", 1));
}

std::array<double, 6> TroughWriter::bounds() const {
    std::array<double, 6> bounds{};
    rest_->GetBounds(bounds.data());
    return bounds;
}

void TroughWriter::write(std::filesystem::path const& path, TroughPosition const& position, double time) {
    vtkNew<vtkPoints> points;
    points->SetNumberOfPoints(rest_->GetNumberOfPoints());
    for (vtkIdType i = 0; i < rest_->GetNumberOfPoints(); ++i) {
        double const* const node = rest_->GetPoint(i);
        points->SetPoint(i, node[0] + position.x, node[1], node[2] + position.z);
    }
    moved_->SetPoints(points);
    set_time(*moved_, source_, time);
    write_vtp(path, *moved_);
}

void write_contacts(std::filesystem::path const& path, FrameSource const& source, ContactFrame& frame,
                    double time) {
    std::size_t const contacts = frame.contacts();
    std::vector<float> normal(contacts), tangential(contacts), force(3 * contacts);
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> lines;
    for (std::size_t i = 0; i < contacts; ++i) {
        float const* const n = &frame.normal_force[3 * i];
        float const* const t = &frame.tangential_force[3 * i];
        normal[i] = std::hypot(n[0], n[1], n[2]);
        tangential[i] = std::hypot(t[0], t[1], t[2]);
        for (std::size_t axis = 0; axis < 3; ++axis) force[3 * i + axis] = n[axis] + t[axis];
        vtkIdType const ends[2] = {points->InsertNextPoint(&frame.start[3 * i]),
                                   points->InsertNextPoint(&frame.end[3 * i])};
        lines->InsertNextCell(2, ends);
    }
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    data->SetLines(lines);
    vtkCellData& values = *data->GetCellData();
    values.AddArray(view_of<vtkFloatArray>(normal, "normal_force", 1));
    values.AddArray(view_of<vtkFloatArray>(tangential, "tangential_force", 1));
    values.AddArray(view_of<vtkFloatArray>(force, "force", 3));
    values.AddArray(view_of<vtkFloatArray>(frame.overlap, "overlap", 1));
    values.AddArray(view_of<vtkIntArray>(frame.first, "first_grain", 1));
    values.AddArray(view_of<vtkIntArray>(frame.second, "second_grain", 1));
    set_time(*data, source, time);
    write_vtp(path, *data);
}

void write_profile(std::filesystem::path const& path, FrameSource const& source, GrainFrame const& frame,
                   std::vector<float> const& relative_velocity, double surface, double time) {
    double const area = (frame.box[1] - frame.box[0]) * source.width;
    Profile profile = profile_of(frame, relative_velocity, surface, area);
    vtkNew<vtkPolyData> data;
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> line;
    auto const slabs = static_cast<vtkIdType>(profile.height.size());
    if (slabs > 0) line->InsertNextCell(static_cast<int>(slabs));
    for (vtkIdType i = 0; i < slabs; ++i) {
        double const height = profile.height[static_cast<std::size_t>(i)] + surface;
        line->InsertCellPoint(points->InsertNextPoint(frame.box[0], frame.box[3], height));
    }
    data->SetPoints(points);
    data->SetLines(line);
    vtkPointData& values = *data->GetPointData();
    values.AddArray(view_of<vtkDoubleArray>(profile.height, "height", 1));
    values.AddArray(view_of<vtkDoubleArray>(profile.solid_fraction, "solid_fraction", 1));
    values.AddArray(view_of<vtkDoubleArray>(profile.velocity, "velocity_relative_to_trough_x", 1));
    set_time(*data, source, time);
    write_vtp(path, *data);
}

}  // namespace vibrotrough::view
