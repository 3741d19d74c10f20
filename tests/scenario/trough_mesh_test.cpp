#include "scenario/model/trough_mesh.hpp"

#include "scenario/model/surface_repair.hpp"
#include "test_meshes.hpp"

#include <cmath>
#include <cstdint>
#include <fstream>
#include <numbers>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vibrotrough::scenario {
namespace {

using testing::HasSubstr;

constexpr double pi = std::numbers::pi;

std::shared_ptr<TroughMesh const> read(std::vector<Triangle> const& mesh) {
    return read_trough_mesh({{"a.stl", stl_text("a", mesh)}});
}

std::string error_of_text(std::string const& content) {
    try {
        read_trough_mesh({{"a.stl", content}});
    } catch (std::invalid_argument const& wrong) {
        return wrong.what();
    }
    return "no error";
}

std::string error_of(std::vector<Triangle> const& mesh) {
    return error_of_text(stl_text("a", mesh));
}

std::string binary_stl(std::vector<Triangle> const& mesh) {
    std::string bytes(80, 'x');
    auto const count = static_cast<std::uint32_t>(mesh.size());
    bytes.append(reinterpret_cast<char const*>(&count), sizeof count);
    for (Triangle const& triangle : mesh) {
        std::array<float, 12> numbers{};
        for (std::size_t k = 0; k < 9; ++k) numbers[3 + k] = static_cast<float>(triangle[k / 3][k % 3]);
        bytes.append(reinterpret_cast<char const*>(numbers.data()), sizeof numbers);
        bytes.append(2, '\0');
    }
    return bytes;
}

double area_of(std::vector<Triangle> const& mesh) {
    double sum = 0;
    for (Triangle const& t : mesh) {
        double const x =
            (t[1][1] - t[0][1]) * (t[2][2] - t[0][2]) - (t[1][2] - t[0][2]) * (t[2][1] - t[0][1]);
        double const y =
            (t[1][2] - t[0][2]) * (t[2][0] - t[0][0]) - (t[1][0] - t[0][0]) * (t[2][2] - t[0][2]);
        double const z =
            (t[1][0] - t[0][0]) * (t[2][1] - t[0][1]) - (t[1][1] - t[0][1]) * (t[2][0] - t[0][0]);
        sum += std::hypot(x, y, z) / 2;
    }
    return sum;
}

// A V of 45 degrees holds h^2 per length below the level h, and w h - w^2 / 4 once it is full (w: its width).
TEST(TroughMesh, VolumeBelowALevel) {
    auto const mesh = read(short_vee());
    EXPECT_EQ(mesh->extent, (Point{36, 18, 9}));
    // The grid of 100 places leaves (18 / 100)^2 / 12 per length at the bottom, and cuts the last cell.
    EXPECT_NEAR(mesh->volume_below(5), 36 * 25.0, 36 * 0.1);
    EXPECT_NEAR(mesh->volume_below(20), 36 * (18 * 20.0 - 81), 1e-9 * 36 * 279);
    EXPECT_EQ(mesh->volume_below(0), 0);
    EXPECT_FALSE(mesh->hole());
    EXPECT_NEAR(mesh->mismatch_along, 0, 1e-12);
    EXPECT_NEAR(mesh->mismatch_across, 0, 1e-12);
    EXPECT_FALSE(mesh->has_upright_sides);
}

TEST(TroughMesh, TextAndBinaryAreTheSame) {
    auto const text = read(short_vee()), binary = read_trough_mesh({{"b.stl", binary_stl(short_vee())}});
    EXPECT_EQ(text->triangles, binary->triangles);
    // What is kept is text that reads back as the same mesh.
    EXPECT_EQ(read_trough_mesh(binary->files)->triangles, binary->triangles);
}

// Several files are parts of one mesh: the same triangles as in one file, and the names of the files.
TEST(TroughMesh, SeveralFilesArePartsOfTheMesh) {
    std::vector<Triangle> floor, liner;
    add_rectangle(floor, {0, 0, 0}, {30, 0, 0}, {30, 20, 0}, {0, 20, 0});
    add_rectangle(liner, {30, 0, 0}, {40, 0, 0}, {40, 20, 0}, {30, 20, 0});
    auto const one = read_trough_mesh({{"a.stl", stl_text("floor", floor) + stl_text("wear_plate", liner)}});
    auto const two =
        read_trough_mesh({{"floor.stl", stl_text("CAD", floor)}, {"wear plate.stl", binary_stl(liner)}});
    EXPECT_EQ(two->triangles, one->triangles);
    EXPECT_EQ(two->parts, one->parts) << "not the solids' own names";
    EXPECT_EQ(two->part_of, one->part_of);
    EXPECT_EQ(two->names(), "floor.stl, wear plate.stl");
    // What is kept reads back as the same mesh.
    EXPECT_EQ(read_trough_mesh(two->files)->triangles, one->triangles);
    auto const refusal = [](std::vector<NamedFile> const& files) -> std::string {
        try {
            read_trough_mesh(files);
        } catch (std::invalid_argument const& error) {
            return error.what();
        }
        return "";
    };
    NamedFile const good{"floor.stl", stl_text("a", floor)};
    EXPECT_THAT(refusal({good, good}), testing::HasSubstr("two files would be the solid 'floor'"));
    EXPECT_THAT(refusal({good, {"b.stl", "no STL"}}), testing::StartsWith("in b.stl, it is neither"));
}

// Text files of CAD programs may hold a solid for each part of a trough. Names become such as a campaign file
// may have.
TEST(TroughMesh, SolidsOfATextArePartsOfTheMesh) {
    std::vector<Triangle> floor, liner, end;
    add_rectangle(floor, {0, 0, 0}, {30, 0, 0}, {30, 20, 0}, {0, 20, 0});
    add_rectangle(liner, {30, 0, 0}, {40, 0, 0}, {40, 20, 0}, {30, 20, 0});
    add_rectangle(end, {40, 0, 0}, {50, 0, 0}, {50, 20, 0}, {40, 20, 0});
    std::string const text =
        stl_text("floor sheet 2 mm", floor) + stl_text("Liner", liner) + stl_text("vertex", end);
    auto const mesh = read_trough_mesh({{"a.stl", text}});
    EXPECT_THAT(mesh->parts, testing::ElementsAre("floor_sheet_2_mm", "Liner", "vertex"));
    EXPECT_THAT(mesh->part_of, testing::ElementsAre(0, 0, 1, 1, 2, 2));
    EXPECT_EQ(mesh->extent, (Point{50, 20, 0})) << "they have one origin";
    EXPECT_DOUBLE_EQ(mesh->share_in_plan("Liner"), 200.0 / 1000);  // of 600 + 200 + 200 mm2
    EXPECT_EQ(mesh->share_in_plan("rubber"), 0);
    EXPECT_THAT(read_trough_mesh({{"a.stl", stl_text("one", floor) + stl_text("one", liner)}})->parts,
                testing::ElementsAre("one"));
    EXPECT_THAT(read_trough_mesh({{"b.stl", binary_stl(short_vee())}})->part_of,
                testing::ElementsAre(0, 0, 0, 0));
    // Solids without triangles are none, also those that seem to begin with "end solid".
    std::string const odd =
        stl_text("empty", {}) + stl_text("C:\\a\"b&", floor) + "end solid\n" + stl_text("", liner);
    EXPECT_THAT(read_trough_mesh({{"a.stl", odd}})->parts, testing::ElementsAre("C__a_b_", "unnamed"));
    EXPECT_THAT(read_trough_mesh({{"a.stl", odd}})->part_of, testing::ElementsAre(0, 0, 1, 1));
    std::string many;
    for (int i = 0; i < 101; ++i) many += fmt::format("solid {}\nendsolid\n", i);
    EXPECT_THAT(error_of_text(many), HasSubstr("it has more than 100 solids"));
}

TEST(TroughMesh, StepsWallsAndHolesAreSeen) {
    std::vector<Triangle> step;
    add_rectangle(step, {0, 0, 0}, {30, 0, 2}, {30, 20, 2}, {0, 20, 0});
    EXPECT_NEAR(read(step)->mismatch_along, 2, 1e-12);
    std::vector<Triangle> channel;
    add_rectangle(channel, {0, 0, 0}, {30, 0, 0}, {30, 20, 0}, {0, 20, 0});
    EXPECT_FALSE(read(channel)->has_upright_sides);
    add_rectangle(channel, {0, 0, 0}, {30, 0, 0}, {30, 0, 15}, {0, 0, 15});
    EXPECT_THAT(error_of(channel), HasSubstr("in only one of its sides"));
    add_rectangle(channel, {0, 20, 0}, {30, 20, 0}, {30, 20, 15}, {0, 20, 15});
    EXPECT_TRUE(read(channel)->has_upright_sides);
    EXPECT_EQ(read(channel)->floor_top, 0) << "grains are poured between the walls";
    std::vector<Triangle> rib = channel;
    add_rectangle(rib, {10, 10, 0}, {20, 10, 0}, {20, 10, 12}, {10, 10, 12});
    EXPECT_EQ(read(rib)->floor_top, 12) << "and above a rib";
    channel.pop_back();
    channel.pop_back();
    add_rectangle(channel, {0, 20, 0}, {30, 20, 0}, {30, 20, 9}, {0, 20, 9});
    EXPECT_THAT(error_of(channel), HasSubstr("do not reach from the surface to the top"));
    std::vector<Triangle> plate{{Point{0, 0, 0}, Point{30, 0, 0}, Point{30, 20, 0}}};
    EXPECT_EQ(read(plate)->has_end_plates, (std::array{false, false}));
    plate.push_back({Point{30, 0, 0}, Point{30, 20, 0}, Point{30, 20, 9}});
    EXPECT_EQ(read(plate)->has_end_plates, (std::array{false, true}));

    std::vector<Triangle> slab;  // a sheet with its thickness, as CAD programs export it
    add_rectangle(slab, {0, 0, 0}, {30, 0, 0}, {30, 20, 0}, {0, 20, 0});
    add_rectangle(slab, {0, 0, 5}, {30, 0, 5}, {30, 20, 5}, {0, 20, 5});
    EXPECT_THAT(error_of(slab), HasSubstr("two surfaces above each other"));

    std::vector<Triangle> gap;
    add_rectangle(gap, {0, 0, 0}, {10, 0, 0}, {10, 20, 0}, {0, 20, 0});
    add_rectangle(gap, {12, 0, 0}, {30, 0, 0}, {30, 20, 0}, {12, 20, 0});
    ASSERT_TRUE(read(gap)->hole());
    EXPECT_NEAR((*read(gap)->hole())[0], 10, 0.1);  // a place of the grid
}

// Cutting edges in the middle keeps the surface: the same area, no long edge, and nodes of both sides of a
// cut edge fit, so that each edge inside the surface belongs to two triangles.
TEST(TroughMesh, IsDividedWithoutGaps) {
    std::vector<Triangle> const fine = divided(short_vee(), 4);
    EXPECT_NEAR(area_of(fine), area_of(short_vee()), 1e-9);
    std::map<std::pair<Point, Point>, int> edges;
    for (Triangle const& t : fine) {
        for (std::size_t k = 0; k < 3; ++k) {
            Point const a = std::min(t[k], t[(k + 1) % 3]), b = std::max(t[k], t[(k + 1) % 3]);
            EXPECT_LE(std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]), 4);
            ++edges[{a, b}];
        }
    }
    for (auto const& [edge, count] : edges) {
        auto const both_at = [&edge = edge](std::size_t k, double value) {
            return edge.first[k] == value && edge.second[k] == value;
        };
        bool const is_border = both_at(0, 5) || both_at(0, 41) || both_at(1, -9) || both_at(1, 9);
        EXPECT_EQ(count, is_border ? 1 : 2);
    }
}

// What changes nothing of the surface is mended and said: a copy (turned, too), a triangle without area,
// corners that rounding has moved, and a corner in the edge of another triangle.
TEST(TroughMesh, WhatIsHarmlessIsMended) {
    std::vector<Triangle> mesh = short_vee();
    mesh.push_back({mesh[1][2], mesh[1][1], mesh[1][0]});
    mesh.push_back({{{5, 0, 0}, {20, 0, 0}, {41, 0, 0}}});
    mesh[2][1][1] += 1e-5;
    auto const mended = read(mesh);
    EXPECT_NEAR(area_of(mended->triangles), area_of(short_vee()), 1e-3);
    ASSERT_EQ(mended->repairs.size(), 3u);
    EXPECT_THAT(mended->repairs[0], HasSubstr("1 corner was joined with another"));
    EXPECT_THAT(mended->repairs[1],
                HasSubstr("1 triangle without area was left out: triangle 6 at (5, 0, 0)"));
    EXPECT_THAT(mended->repairs[2], HasSubstr("1 copy of a triangle was left out: triangle 5"));

    std::vector<Triangle> split = short_vee();
    split[0] = {{{5, -9, 9}, {41, -9, 9}, {23, -4.5, 4.5}}};
    split.push_back({{{41, -9, 9}, {41, 0, 0}, {23, -4.5, 4.5}}});
    auto const divided_there = read(split);
    ASSERT_EQ(divided_there->repairs.size(), 1u);
    EXPECT_THAT(divided_there->repairs[0],
                HasSubstr("1 edge was divided where a corner lies in it: at (23, -4.5, 4.5)"));
    EXPECT_EQ(divided_there->triangles.size(), 6u);
    EXPECT_NEAR(area_of(divided_there->triangles), area_of(short_vee()), 1e-9);
}

// A strip of 1 x 600 has angles of 0.1 degrees, below the engine's 0.26. A row of triangles with legs of 1
// and 9 to 15 has 3 degrees at least, and the same area.
TEST(TroughMesh, NeedlesBecomeStout) {
    std::vector<Triangle> strips;
    for (int i = 0; i < 4; ++i) {
        double const y = i, z = 0.1 * i * i;
        add_rectangle(strips, {0, y, z}, {600, y, z}, {600, y + 1, 0.1 * (i + 1) * (i + 1)},
                      {0, y + 1, 0.1 * (i + 1) * (i + 1)});
    }
    auto const stout = divided(without_needles(strips, 15), 15);
    EXPECT_NEAR(area_of(stout), area_of(strips), 1e-9 * area_of(strips));
    double least = pi;
    for (Triangle const& triangle : stout) least = std::min(least, smallest_angle(triangle));
    EXPECT_GT(least * 180 / pi, 2);
}

TEST(TroughMesh, WhatIsWrongIsSaid) {
    auto const error = [](std::string const& content) { return error_of_text(content); };
    EXPECT_EQ(error(""), "it is neither a text nor a binary STL");
    EXPECT_EQ(error("solid a\nendsolid a\n"), "it has no triangles");
    EXPECT_EQ(error("solid a\nvertex 1 2 x\n"), "a corner of triangle 1 is not three numbers");
    EXPECT_EQ(error("solid vertex of a chute\n" + stl_text("a", short_vee()).substr(8)), "no error");
    std::string capitals = "\xEF\xBB\xBF" + stl_text("a", short_vee());
    std::ranges::transform(capitals, capitals.begin(), [](unsigned char c) { return std::toupper(c); });
    EXPECT_EQ(error(capitals), "no error");
    EXPECT_EQ(error("solid a\nvertex 1 2 3\n"), "its last triangle has fewer than three corners");
    EXPECT_EQ(error(stl_text("a", {{{{0, 0, 0}, {1, 1, 0}, {2, 2, 0}}}})),
              "none of its triangles has an area");
    std::string const text = stl_text("a", short_vee());
    EXPECT_EQ(error(text.substr(0, text.find("endfacet"))),
              "it ends within triangle 1, so that a part of it is missing");
    EXPECT_EQ(error(text.substr(0, text.find("endsolid"))),
              "it ends without a line 'endsolid': the file was cut");
    EXPECT_THAT(error("solid a\nvertex 0,5 1,25 2\n"), HasSubstr("triangle 1 has decimal commas (0,5)"));
    EXPECT_EQ(error(stl_text("a", {{{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}}}})),
              "its surface has no length or no width");
    EXPECT_THAT(error("solid a\nvertex nan 0 0\nvertex 1 0 0\nvertex 0 1 0\n"), HasSubstr("triangle 1"));
    std::string const whole = binary_stl(short_vee());
    EXPECT_EQ(error(whole.substr(0, whole.size() - 1)),
              "it is a binary STL of 4 triangles by its header, but it has room for 3.98; a part of it may "
              "be missing");
}

}  // namespace
}  // namespace vibrotrough::scenario
