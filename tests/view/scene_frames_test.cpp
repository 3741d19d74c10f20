#include "core/atomic_file.hpp"
#include "frame_export.hpp"
#include "view/frames.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <numbers>
#include <regex>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

namespace vibrotrough::view {
namespace {

namespace fs = std::filesystem;

constexpr double frame_step = 2.4493014e-5;                               // s
constexpr double turning = 2.0 * std::numbers::pi / (3000 * frame_step);  // rad/s

/// Three frames of a real run, a tenth of a cycle apart, beginning at the start of cycle 20: what the scene
/// shows beside grains and trough.
class SceneFrames : public FrameExport {
  protected:
    SceneFrames()
        : FrameExport(VIEW_TEST_DATA,
                      {.folder = {},
                       .trough = {},
                       .time_step = frame_step,
                       .angular_frequency = turning,
                       .drive = {.along = {{1, 0.00536656, 0}}, .normal = {{1, 0.00268328, 0}}},
                       .width = 0.018,
                       .caption = {}}) {}
};

// Walls are one object that moves as the trough does; a trough without walls has no such files.
TEST_F(SceneFrames, WallsMoveWithTheTrough) {
    EXPECT_EQ(export_frames(source, target).walls, "");
    EXPECT_FALSE(fs::exists(target / "walls.pvd"));
    for (double const y : {0.0, 0.018}) {
        scenario::Triangle const one{{{0, y, 0}, {0.036, y, 0}, {0.036, y, 0.02}}},
            other{{{0, y, 0}, {0.036, y, 0.02}, {0, y, 0.02}}};
        std::string const name = y == 0 ? "left.stl" : "right.stl";
        std::ofstream(source.folder / name) << scenario::stl_text("wall", {one, other});
        source.walls.push_back(source.folder / name);
    }
    EXPECT_EQ(export_frames(source, target).walls, target / "walls.pvd");
    EXPECT_TRUE(fs::exists(target / "walls.pvd"));
    auto const rest = read("walls/000000.vtp"), moved = read("walls/000002.vtp");
    ASSERT_EQ(moved->GetNumberOfPolys(), 4);
    ASSERT_EQ(moved->GetNumberOfPoints(), 8);
    EXPECT_EQ(rest->GetBounds()[3], 0.018F);
    for (vtkIdType i = 0; i < 8; ++i) {
        EXPECT_NEAR(moved->GetPoint(i)[0] - rest->GetPoint(i)[0], 0.0051039, 4e-9);
        EXPECT_EQ(moved->GetPoint(i)[1], rest->GetPoint(i)[1]);
        EXPECT_NEAR(moved->GetPoint(i)[2] - rest->GetPoint(i)[2], 0.00255195, 4e-9);
    }
}

// With stages cycles are those of the stages, whatever frequency the first drive has.
TEST_F(SceneFrames, KnowStageAndItsCycle) {
    double const frequency = turning / (2 * std::numbers::pi);
    source.parts = {{1, false, 0, 30, 0, 30 / frequency, frequency, frequency, {}, source.drive}};
    source.steps_per_cycle = 3000;
    source.angular_frequency = 1.7 * turning;
    export_frames(source, target);
    auto const grains = read("grains/000002.vtp");
    vtkFieldData& facts = *grains->GetFieldData();
    EXPECT_EQ(facts.GetArray("stage")->GetComponent(0, 0), 2);
    EXPECT_EQ(facts.GetArray("cycle")->GetComponent(0, 0), 20);
    EXPECT_NEAR(facts.GetArray("vibration_phase")->GetComponent(0, 0), 72, 1e-9);
}

// The camera is told where the grains of all frames are, not only of the first.
TEST_F(SceneFrames, SceneKnowsWhereAllGrainsAre) {
    ExportedFrames const exported = export_frames(source, target);
    std::array<double, 4> space{1, -1, 1, -1};
    for (int i = 0; i < 3; ++i) {
        auto const grains = read(fmt::format("grains/{:06}.vtp", i));
        for (vtkIdType k = 0; k < grains->GetNumberOfPoints(); ++k) {
            double const r = grains->GetPointData()->GetArray("radius")->GetComponent(k, 0);
            double const* const p = grains->GetPoint(k);
            space = {std::min(space[0], p[0] - r), std::max(space[1], p[0] + r), std::min(space[2], p[2] - r),
                     std::max(space[3], p[2] + r)};
        }
    }
    std::string const scene = core::read_file(exported.scene);
    std::smatch found;
    std::regex const numbers("GRAIN_SPACE: Any = \\(([^,]+), ([^,]+), ([^,]+), ([^)]+)\\)");
    ASSERT_TRUE(std::regex_search(scene, found, numbers));
    for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(std::stod(found[k + 1]), space[k]);
}

}  // namespace
}  // namespace vibrotrough::view
