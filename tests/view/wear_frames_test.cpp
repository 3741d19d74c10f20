#include "core/error.hpp"
#include "frame_export.hpp"
#include "measure/wear.hpp"

#include <fstream>
#include <numbers>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>

namespace vibrotrough::view {
namespace {

/// Three frames of a real run at the steps 60000, 60300 and 60600; its cycles are taken to have 300 steps.
class WornTrough : public FrameExport {
  protected:
    static constexpr int steps_per_cycle = 300;

    WornTrough()
        : FrameExport(VIEW_TEST_DATA,
                      {.folder = {},
                       .trough = {},
                       .time_step = 2.4493014e-5,
                       .angular_frequency = 2.0 * std::numbers::pi / (3000 * 2.4493014e-5),
                       .drive = {.along = {{1, 0.00536656, 0}}, .normal = {{1, 0.00268328, 0}}},
                       .width = 0.018,
                       .caption = "worn",
                       .steps_per_cycle = steps_per_cycle}) {
        source.wear = source.folder;
        export_frames(source, target);
        triangles = static_cast<int>(read("trough/000000.vtp")->GetNumberOfCells());
    }

    /// Writes the wear at the end of a cycle: of triangle i this much, plus i.
    void write(int cycle, double wear, int count) const {
        std::string points, numbers, wears, areas;
        for (int i = 0; i < count; ++i) {
            points += "0 0 0 1 0 0 0 1 0 \n";
            numbers += fmt::format("{} ", i);
            wears += fmt::format("{} ", wear + i);
            areas += "1e-6 ";
        }
        std::ofstream(source.wear / measure::wear_file(cycle * steps_per_cycle)) << fmt::format(
            "POINTS {} float\n{}meshid 1 {} int\n{}\nwear 1 {} double\n{}\narea 1 {} double\n{}\n", 3 * count,
            points, count, numbers, count, wears, count, areas);
    }

    /// The wear of the last triangle in a frame; none when the trough has none.
    std::optional<double> last(int frame) const {
        auto const trough = read(fmt::format("trough/{:06}.vtp", frame));
        vtkDataArray* const wear = trough->GetCellData()->GetArray("wear");
        if (wear == nullptr) return {};
        return wear->GetComponent(triangles - 1, 0);
    }

    int triangles = 0;
};

TEST_F(WornTrough, HasNoWearWithoutItsFiles) {
    EXPECT_EQ(last(0), std::nullopt);
    EXPECT_EQ(last(2), std::nullopt);
}

// What the grains wore when they were poured in is taken off.
TEST_F(WornTrough, HasTheWearSinceTheDriveBegan) {
    write(0, 5, triangles);
    for (int cycle = 200; cycle <= 202; ++cycle) write(cycle, 3.5 * cycle, triangles);
    export_frames(source, target);
    EXPECT_EQ(last(0), 695.0);
    EXPECT_EQ(last(1), 698.5);
    EXPECT_EQ(last(2), 702.0);
}

// The engine may be writing the last one: what was known before stays.
TEST_F(WornTrough, KeepsItsWearUntilTheNextFileIsWhole) {
    write(0, 5, triangles);
    for (int cycle = 200; cycle <= 201; ++cycle) write(cycle, 3.5 * cycle, triangles);
    std::ofstream(source.wear / measure::wear_file(202 * steps_per_cycle)) << "POINTS 3 float\n0 0";
    export_frames(source, target);
    EXPECT_EQ(last(2), 698.5);
}

TEST_F(WornTrough, IsThatOfTheMesh) {
    write(0, 5, triangles + 1);
    write(200, 7, triangles + 1);
    EXPECT_THAT(refusal(), testing::HasSubstr(fmt::format("but the trough has {}", triangles)));
}

}  // namespace
}  // namespace vibrotrough::view
