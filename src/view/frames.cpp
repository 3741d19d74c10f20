#include "view/frames.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "view/dump_reader.hpp"
#include "view/scene.hpp"
#include "view/trough_motion.hpp"
#include "view/vtk_files.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkTypeInt32Array.h>

namespace vibrotrough::view {
namespace {

namespace fs = std::filesystem;

struct Dump {
    long step;
    fs::path path;
};

/// The step of "frames.<step>.dump".
std::optional<long> step_of(std::string const& name) {
    std::string_view constexpr prefix = "frames.";
    std::string_view constexpr suffix = ".dump";
    if (!name.starts_with(prefix) || !name.ends_with(suffix) || name.size() <= prefix.size() + suffix.size())
        return {};
    long step = 0;
    char const* const stop = name.data() + name.size() - suffix.size();
    auto const [after, failure] = std::from_chars(name.data() + prefix.size(), stop, step);
    return failure == std::errc{} && after == stop ? std::optional(step) : std::nullopt;
}

/// All dumps of the folder by step.
std::vector<Dump> find_dumps(fs::path const& folder) {
    std::error_code failure;
    fs::directory_iterator const files(folder, failure);
    if (failure) {
        throw MissingError(
            fmt::format("cannot open the folder {} ({}); set output.frames_per_cycle to at least 1 "
                        "and run the case",
                        folder.string(), failure.message()));
    }
    std::vector<Dump> dumps;
    for (fs::directory_entry const& file : files) {
        if (auto const step = step_of(file.path().filename().string())) dumps.push_back({*step, file.path()});
    }
    std::sort(dumps.begin(), dumps.end(), [](Dump const& a, Dump const& b) { return a.step < b.step; });
    return dumps;
}

/// Where the trough is at every dump. Only the last dump may lack a row, or the last row a dump: the engine
/// may be writing it.
std::vector<TroughPosition> match(std::vector<Dump>& dumps, fs::path const& table) {
    std::vector<TroughPosition> positions = read_trough_motion(table);
    std::size_t const frames = std::min(dumps.size(), positions.size());
    for (std::size_t i = 0; i < frames; ++i) {
        if (dumps[i].step != positions[i].step) {
            throw InputError(
                fmt::format("{} and the dumps beside it do not fit (frame {} is step {} there and {} "
                            "here); run the case again",
                            table.string(), i + 1, positions[i].step, dumps[i].step));
        }
    }
    if (dumps.size() > frames + 1 || positions.size() > frames + 1) {
        throw InputError(fmt::format("{} has {} rows for {} dumps beside it; run the case again",
                                     table.string(), positions.size(), dumps.size()));
    }
    dumps.resize(frames);
    positions.resize(frames);
    return positions;
}

/// LIGGGHTS sums A omega cos(omega t) dt, which is off A sin(omega t) by at most A pi / n for n steps per
/// cycle (1.3 % of A at n = 500). More than this share of A means that phase or amplitude are others.
constexpr double motion_tolerance = 0.05;

void check_motion(FrameSource const& source, TroughPosition const& position) {
    double const sine =
        std::sin(source.angular_frequency * static_cast<double>(position.step) * source.time_step);
    double const miss =
        std::hypot(position.x - source.amplitude_x * sine, position.z - source.amplitude_z * sine);
    if (miss > motion_tolerance * std::hypot(source.amplitude_x, source.amplitude_z)) {
        throw InputError(
            fmt::format("{}: at step {} the trough is {:.3g} m from where A sin(omega t) puts it (the "
                        "frames belong to another drive); run the case again",
                        (source.folder / "frames.csv").string(), position.step, miss));
    }
}

void set_time(vtkPolyData& data, double time) {
    vtkNew<vtkDoubleArray> value;
    value->SetName("TimeValue");
    value->InsertNextValue(time);
    data.GetFieldData()->AddArray(value);
}

/// A VTK array that shows the values without owning them.
template <typename Array, typename Value>
vtkSmartPointer<Array> view_of(std::vector<Value>& values, char const* name, int components) {
    auto array = vtkSmartPointer<Array>::New();
    array->SetName(name);
    array->SetNumberOfComponents(components);
    array->SetArray(values.data(), static_cast<vtkIdType>(values.size()), 1);
    return array;
}

/// One vertex cell per grain: points without cells are not shown by ParaView.
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

/// Writes the grains of one frame after another.
class GrainWriter {
  public:
    explicit GrainWriter(FrameSource const& source) : source_(source) {}

    void write(fs::path const& path, GrainFrame& frame, double time) {
        // Velocity of the trough: d/dt of A sin(omega t).
        double const rate = source_.angular_frequency * std::cos(source_.angular_frequency * time);
        auto const trough_x = static_cast<float>(source_.amplitude_x * rate);
        auto const trough_z = static_cast<float>(source_.amplitude_z * rate);
        relative_ = frame.velocity;
        for (std::size_t i = 0; i < relative_.size(); i += 3) {
            relative_[i] -= trough_x;
            relative_[i + 2] -= trough_z;
        }

        vtkNew<vtkPoints> points;
        points->SetData(view_of<vtkFloatArray>(frame.position, "Points", 3));
        data_->SetPoints(points);
        set_vertices(*data_, frame.grains());
        vtkPointData& values = *data_->GetPointData();
        values.AddArray(view_of<vtkFloatArray>(frame.radius, "radius", 1));
        values.AddArray(view_of<vtkFloatArray>(frame.velocity, "velocity", 3));
        values.AddArray(view_of<vtkFloatArray>(relative_, "velocity_relative_to_trough", 3));
        values.AddArray(view_of<vtkIntArray>(frame.id, "id", 1));
        set_time(*data_, time);
        write_vtp(path, *data_);
    }

  private:
    FrameSource const& source_;
    std::vector<float> relative_;
    vtkNew<vtkPolyData> data_;
};

/// Writes the trough, moved, of one frame after another.
class TroughWriter {
  public:
    explicit TroughWriter(fs::path const& stl) : rest_(read_stl(stl)) { moved_->ShallowCopy(rest_); }

    void write(fs::path const& path, TroughPosition const& position, double time) {
        vtkNew<vtkPoints> points;
        points->SetNumberOfPoints(rest_->GetNumberOfPoints());
        for (vtkIdType i = 0; i < rest_->GetNumberOfPoints(); ++i) {
            double const* const node = rest_->GetPoint(i);
            points->SetPoint(i, node[0] + position.x, node[1], node[2] + position.z);
        }
        moved_->SetPoints(points);
        set_time(*moved_, time);
        write_vtp(path, *moved_);
    }

  private:
    vtkSmartPointer<vtkPolyData> rest_;
    vtkNew<vtkPolyData> moved_;
};

}  // namespace

ExportedFrames export_frames(FrameSource const& source, fs::path const& target) {
    std::vector<Dump> dumps = find_dumps(source.folder);
    std::vector<TroughPosition> const positions = match(dumps, source.folder / "frames.csv");
    for (TroughPosition const& position : positions) check_motion(source, position);
    TroughWriter trough(source.trough);
    GrainWriter grains(source);

    ExportedFrames exported{0, target / "grains.pvd", target / "trough.pvd", {}};
    make_folder(target / "grains");
    make_folder(target / "trough");
    exported.scene = write_scene(source, target);
    std::vector<CollectionEntry> grain_files;
    std::vector<CollectionEntry> trough_files;
    auto const write_collections = [&] {
        write_collection(exported.trough, trough_files);
        write_collection(exported.grains, grain_files);
    };
    write_collections();

    DumpReader reader;
    GrainFrame frame;
    auto written = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < dumps.size(); ++i) {
        if (reader.read(dumps[i].path, frame) == DumpState::unfinished) {
            if (i + 1 == dumps.size()) break;
            throw InputError(
                fmt::format("{} ends early though later frames are there (the file is damaged); run its "
                            "case again",
                            dumps[i].path.string()));
        }
        if (frame.step != dumps[i].step) {
            throw InputError(
                fmt::format("{}:2: holds step {}, which its name contradicts; run its case again",
                            dumps[i].path.string(), frame.step));
        }
        double const time = static_cast<double>(frame.step) * source.time_step;
        std::string const name = fmt::format("{:06}.vtp", i);
        grains.write(target / "grains" / name, frame, time);
        trough.write(target / "trough" / name, positions[i], time);
        grain_files.push_back({time, "grains/" + name});
        trough_files.push_back({time, "trough/" + name});
        ++exported.frames;
        if (auto const now = std::chrono::steady_clock::now(); now - written > std::chrono::seconds(1)) {
            write_collections();
            written = now;
        }
    }
    write_collections();
    return exported;
}

}  // namespace vibrotrough::view
