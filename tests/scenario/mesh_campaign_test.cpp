#include "core/temporary_folder.hpp"
#include "example_campaign.hpp"
#include "scenario/reader/written_campaign.hpp"
#include "single_case.hpp"
#include "test_meshes.hpp"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vibrotrough::scenario {
namespace {

using testing::HasSubstr;

/// Campaigns with a mesh in their folder.
class MeshCampaign : public testing::Test {
  protected:
    Scenario scenario(std::string const& text) const {
        std::ofstream(folder_.path() / "c.toml") << text;
        return read_campaign(folder_.path() / "c.toml").cases.front();
    }
    void write(std::string const& name, std::vector<Triangle> const& mesh) const {
        write_text(name, stl_text("mesh", mesh));
    }
    void write_text(std::string const& name, std::string const& text) const {
        std::ofstream(folder_.path() / name) << text;
    }
    std::string error(std::string const& text) const {
        try {
            scenario(text);
        } catch (core::InputError const& wrong) {
            return wrong.what();
        }
        return "no error";
    }
    static std::string on_mesh(std::string text = example_campaign) {
        return with("[grains]", "mesh = \"vee.stl\"\n\n[grains]", std::move(text));
    }

    core::TemporaryFolder const folder_;
};

TEST_F(MeshCampaign, TheLevelGivesTheGrains) {
    write("vee.stl", short_vee());
    Scenario const s = scenario(on_mesh());
    // 12 mm above the lowest point: 36 mm (18 mm 12 mm - (18 mm)^2 / 4), 0.58 of it grains.
    double const volume = 0.036 * (0.018 * 0.012 - 0.018 * 0.018 / 4);
    EXPECT_NEAR(s.layer.grains * mean_grain_volume(s), 0.58 * volume, 2 * mean_grain_volume(s));
    EXPECT_EQ(layer_height(s), 0.012);
    int const grains = s.layer.grains;
    Scenario const counted =
        scenario(on_mesh(with("height = \"12 mm\"", fmt::format("grains = {}", grains))));
    EXPECT_NEAR(layer_height(counted), 0.012, 5e-5) << "half of a grain's volume over the plan, and the grid";
    EXPECT_THAT(to_toml(s), HasSubstr("mesh = \"vee.stl\"\nmesh_unit = \"mm\"\n"));
    EXPECT_EQ(named_files(s).front().name, "vee.stl");
    EXPECT_EQ(to_toml(scenario(example_campaign)).find("mesh"), std::string::npos);
}

// A pair of a material and a solid gives the coefficients of one on the other; all else is as on the trough.
// The theory takes the mean over the trough in plan.
TEST_F(MeshCampaign, PairsGiveSolidsAFrictionOfTheirOwn) {
    std::vector<Triangle> left, right;
    add_rectangle(left, {5, -9, 9}, {41, -9, 9}, {41, 0, 0}, {5, 0, 0});
    add_rectangle(right, {5, 0, 0}, {41, 0, 0}, {41, 9, 9}, {5, 9, 9});
    write_text("vee.stl", stl_text("steel", left) + stl_text("rubber", right));
    std::string const rubber = "\n[[pairs]]\nmaterials = [\"rubber\", \"grains\"]\nfriction = 0.8\n";
    Scenario const s = scenario(on_mesh() + rubber);
    EXPECT_THAT(own_parts(s), testing::ElementsAre("rubber"));
    Material const grains = materials(s).front();
    EXPECT_EQ(contact_with_trough(s, grains, "rubber").friction, 0.8);
    EXPECT_EQ(contact_with_trough(s, grains, "rubber").restitution, s.trough.restitution);
    EXPECT_EQ(contact_with_trough(s, grains, "steel").friction, s.trough.friction);

    // The same from two files, which are written back, kept and read from what is kept.
    write("steel.stl", left);
    write("rubber.stl", right);
    std::string const list = "mesh = [\"steel.stl\", \"rubber.stl\"]\n";
    Scenario const two = scenario(with("mesh = \"vee.stl\"\n", list, on_mesh()) + rubber);
    EXPECT_EQ(two.trough.mesh->triangles, s.trough.mesh->triangles);
    EXPECT_EQ(contact_with_trough(two, grains, "rubber").friction, 0.8);
    EXPECT_THAT(to_toml(two), HasSubstr(list));
    EXPECT_EQ(word_of(two, "trough.mesh"), "steel.stl, rubber.stl");
    ASSERT_EQ(named_files(two).size(), 2u);
    auto const kept = parse_campaign(to_toml(two), "k", {{}, named_files(two)});
    EXPECT_EQ(to_toml(kept.cases.front()), to_toml(two));
    EXPECT_THAT(error(with("mesh = \"vee.stl\"\n", "mesh = [\"steel.stl\", \"../a.stl\"]\n", on_mesh())),
                HasSubstr("../a.stl"));
    EXPECT_THAT(error(on_mesh() + "[sweep]\n\"trough.mesh\" = [[\"steel.stl\", \"rubber.stl\"]]\n"),
                HasSubstr("a list cannot be swept"));
    EXPECT_NEAR(mean_trough_friction(s), (0.8 + s.trough.friction) / 2, 1e-15);  // half of the plan each
    EXPECT_THAT(to_toml(s), HasSubstr(rubber));
    EXPECT_THAT(own_parts(scenario(on_mesh())), testing::IsEmpty());

    EXPECT_THAT(error(on_mesh() + "\n[[pairs]]\nmaterials = [\"ruber\", \"grains\"]\nfriction = 0.8\n"),
                HasSubstr("the mesh's solids are: steel, rubber"));
    EXPECT_THAT(error(on_mesh() + "\n[[pairs]]\nmaterials = [\"rubber\", \"steel\"]\nfriction = 0.8\n"),
                HasSubstr("or one and a solid of the trough's mesh"));
    EXPECT_THAT(
        error(on_mesh() + rubber + "\n[[pairs]]\nmaterials = [\"grains\", \"steel\"]\nrestitution = 0.8\n"),
        HasSubstr("every solid of the mesh has coefficients of its own"));
}

TEST_F(MeshCampaign, MistakesAreNamed) {
    write("vee.stl", short_vee());
    EXPECT_THAT(error(on_mesh(with("length = \"36 mm\"", "length = \"35 mm\""))),
                HasSubstr("trough.mesh: vee.stl: it is 36 mm long, and layer.length is 35 mm"));
    EXPECT_THAT(error(on_mesh(with("restitution = 0.5", "restitution = 0.5\nmesh_unit = \"m\""))),
                HasSubstr("write mesh_unit = \"mm\""));
    EXPECT_THAT(error(on_mesh(with("restitution = 0.5", "restitution = 0.5\nside_wall_friction = 0.1"))),
                HasSubstr("does not go with trough.mesh"));
    EXPECT_THAT(error(on_mesh(with("height = \"12 mm\"", "block = \"point\""))),
                HasSubstr("a block needs the flat floor"));
    EXPECT_THAT(error(with("[grains]", "mesh = \"no.stl\"\n\n[grains]")), HasSubstr("there is no file"));
    EXPECT_THAT(error(with("[grains]", "mesh = \"../vee.stl\"\n\n[grains]")),
                HasSubstr("not an allowed value"));
    EXPECT_THAT(error(with("[grains]", "mesh = []\n\n[grains]")),
                HasSubstr("trough.mesh: is not a list of 1 to 30 texts"));
    EXPECT_THAT(error(with("[grains]", "mesh_unit = \"m\"\n\n[grains]")),
                HasSubstr("trough.mesh_unit: needs trough.mesh"));
    for (auto const& [written, meant] : {std::pair{"in", "inch"},
                                         {"inches", "inch"},
                                         {"MM", "mm"},
                                         {"centimetre", "cm"},
                                         {"meters", "m"},
                                         {"furlong", "mm"}})
        EXPECT_THAT(
            error(on_mesh(with("restitution = 0.5",
                               "restitution = 0.5\nmesh_unit = \"" + std::string(written) + "\""))),
            HasSubstr("write mesh_unit = \"" + std::string(meant) + "\"; allowed: mm, m, cm or inch"));
    std::vector<Triangle> slope;
    add_rectangle(slope, {0, 0, 0}, {36, 0, 2}, {36, 18, 2}, {0, 18, 0});
    write("vee.stl", slope);
    EXPECT_THAT(error(on_mesh()), HasSubstr("its two ends along the trough differ by 2 mm in height"));
    std::vector<Triangle> closed = short_vee();
    add_rectangle(closed, {41, -9, 9}, {41, 9, 9}, {41, 9, 12}, {41, -9, 12});
    write("vee.stl", closed);
    EXPECT_THAT(error(on_mesh()),
                HasSubstr("there is an upright plate in one of its ends, which are joined"));
    std::vector<Triangle> tilted;
    add_rectangle(tilted, {0, 0, 0}, {36, 0, 0}, {36, 18, 2}, {0, 18, 2});
    write("vee.stl", tilted);
    EXPECT_THAT(error(on_mesh()), HasSubstr("its two sides differ by 2 mm in height"));
    std::vector<Triangle> gap;
    add_rectangle(gap, {0, 0, 0}, {20, 0, 0}, {20, 18, 0}, {0, 18, 0});
    add_rectangle(gap, {22, 0, 0}, {36, 0, 0}, {36, 18, 0}, {22, 18, 0});
    write("vee.stl", gap);
    EXPECT_THAT(error(on_mesh()),
                testing::AllOf(HasSubstr("there is a hole in plan at x = 20"), HasSubstr("is a [screen]")));
}

}  // namespace
}  // namespace vibrotrough::scenario
