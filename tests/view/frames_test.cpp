#include "view/frames.hpp"

#include "core/atomic_file.hpp"
#include "frame_export.hpp"

#include <cmath>
#include <fstream>
#include <numbers>
#include <regex>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

namespace vibrotrough::view {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

constexpr double time_step = 2.4493014e-5;
constexpr double omega = 2.0 * std::numbers::pi / (3000 * time_step);
constexpr double amplitude_x = 0.00536656;
constexpr double amplitude_z = 0.00268328;

/// Three frames of a real run (500 grains, 10 frames per cycle), copied so that a test may damage them.
class Frames : public FrameExport {
  protected:
    Frames()
        : FrameExport(VIEW_TEST_DATA,
                      {.folder = {},
                       .trough = {},
                       .time_step = time_step,
                       .angular_frequency = omega,
                       .drive = {.along = {{1, amplitude_x, 0}}, .normal = {{1, amplitude_z, 0}}},
                       .width = 0.018,
                       .caption = "throw number 2, \"quoted\""}) {
        theory::Conveyor conveyor{};
        conveyor.point = {.throw_number = 2.0, .tan_vibration_angle = 0.5, .friction = 0.23};
        source.point_mass = TheoryMotion{theory::solve(conveyor), amplitude_x, amplitude_z};
    }

    /// Times and files of a collection.
    std::vector<std::pair<double, std::string>> collection(std::string const& name) const {
        std::string const text = core::read_file(target / name);
        std::regex const entry("timestep=\"([^\"]+)\" part=\"0\" file=\"([^\"]+)\"");
        std::vector<std::pair<double, std::string>> entries;
        for (std::sregex_iterator found(text.begin(), text.end(), entry), end; found != end; ++found) {
            entries.emplace_back(std::stod((*found)[1]), (*found)[2]);
        }
        return entries;
    }

    void write(std::string const& name, std::string const& text) const {
        std::ofstream(source.folder / name, std::ios::binary | std::ios::trunc) << text;
    }
};

double component(vtkPolyData& data, char const* name, vtkIdType point, int axis) {
    return data.GetPointData()->GetArray(name)->GetComponent(point, axis);
}

TEST_F(Frames, CollectionsHaveTrueTimes) {
    ExportedFrames const exported = export_frames(source, target);
    EXPECT_EQ(exported.frames, 3);
    EXPECT_EQ(exported.grains, target / "grains.pvd");
    EXPECT_EQ(exported.trough, target / "trough.pvd");
    EXPECT_EQ(exported.point_mass, target / "point_mass.pvd");
    EXPECT_EQ(exported.profile, target / "profile.pvd");
    for (std::string const name : {"grains", "trough", "point_mass", "profile"}) {
        auto const entries = collection(name + ".pvd");
        ASSERT_EQ(entries.size(), 3u);
        for (int i = 0; i < 3; ++i) {
            auto const& [time, file] = entries[static_cast<std::size_t>(i)];
            // Exact: the same product, printed with enough digits to be read back as the same double.
            EXPECT_EQ(time, (60000 + 300 * i) * time_step);
            auto const data = read(file);
            ASSERT_NE(data->GetFieldData()->GetArray("TimeValue"), nullptr);
            EXPECT_EQ(data->GetFieldData()->GetArray("TimeValue")->GetComponent(0, 0), time);
        }
    }
}

TEST_F(Frames, GrainsAreThoseOfTheDump) {
    export_frames(source, target);
    auto const data = read("grains/000001.vtp");
    ASSERT_EQ(data->GetNumberOfPoints(), 500);
    EXPECT_EQ(data->GetNumberOfVerts(), 500);
    std::ifstream dump(source.folder / "frames.60300.dump");
    std::string line;
    for (int i = 0; i < 9; ++i) std::getline(dump, line);
    int id = 0;
    int type = 0;
    double x[3];
    double v[3];
    double radius = 0.0;
    // Six digits of the dump fit a float, whose relative rounding is 6e-8.
    auto const near = [](double read, double written) {
        return std::abs(read - written) <= 6e-8 * std::abs(written);
    };
    for (vtkIdType i = 0; i < 500; ++i) {
        dump >> id >> type >> x[0] >> x[1] >> x[2] >> v[0] >> v[1] >> v[2] >> radius;
        ASSERT_TRUE(dump.good());
        EXPECT_EQ(component(*data, "id", i, 0), id);
        EXPECT_PRED2(near, component(*data, "radius", i, 0), radius);
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_PRED2(near, data->GetPoint(i)[axis], x[axis]);
            EXPECT_PRED2(near, component(*data, "velocity", i, axis), v[axis]);
        }
    }
}

// Only a mixture has materials to colour by: the type of the dump, and in the scene the names of the types.
TEST_F(Frames, MaterialsHaveTypesAndNames) {
    export_frames(source, target);
    EXPECT_EQ(read("grains/000001.vtp")->GetPointData()->GetArray("type"), nullptr);
    source.materials = {{1, "grains"}, {3, "fines"}};
    source.colour = Colour::material;
    ExportedFrames const exported = export_frames(source, target);
    EXPECT_EQ(component(*read("grains/000001.vtp"), "type", 7, 0), 1);
    std::string const scene = core::read_file(exported.scene);
    EXPECT_THAT(scene, HasSubstr("[(1, \"grains\"), (3, \"fines\"), ]"));
    EXPECT_THAT(scene, HasSubstr("or \"material\""));
}

// Relative velocity = velocity - A omega cos(omega t), along x and z.
TEST_F(Frames, VelocityRelativeToTheTrough) {
    export_frames(source, target);
    auto const data = read("grains/000002.vtp");
    double const cosine = std::cos(omega * 60600 * time_step);
    double const trough[3] = {amplitude_x * omega * cosine, 0.0, amplitude_z * omega * cosine};
    for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            // Two roundings to float of speeds below 1 m/s: 6e-8 each.
            EXPECT_NEAR(component(*data, "velocity_relative_to_trough", i, axis),
                        component(*data, "velocity", i, axis) - trough[axis], 1.2e-7);
        }
    }
}

// Velocity from the mean = v_x - sum(R^3 v_x) / sum(R^3), so that its sum weighted with R^3 vanishes; height
// = z - (height of the trough's surface).
TEST_F(Frames, VelocityFromTheMeanAndHeight) {
    export_frames(source, target);
    auto const data = read("grains/000002.vtp");
    EXPECT_EQ(data->GetPointData()->GetArray("spin"), nullptr);  // these dumps have none
    double moved = 0.0, volume = 0.0;
    double const first = component(*data, "velocity", 0, 0) - component(*data, "velocity_from_mean", 0, 0);
    for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) {
        double const cube = std::pow(component(*data, "radius", i, 0), 3);
        volume += cube;
        moved += cube * component(*data, "velocity_from_mean", i, 0);
        // Both are rounded: speeds to 1/16384 m/s, at most half of it off each, and heights to 1/131072 m.
        EXPECT_NEAR(component(*data, "velocity", i, 0) - component(*data, "velocity_from_mean", i, 0), first,
                    6.2e-5);
        EXPECT_NEAR(component(*data, "height", i, 0), data->GetPoint(i)[2] - 0.00255195, 3.9e-6);
    }
    EXPECT_NEAR(moved / volume, 0.0, 3.1e-5);
}

// spin is that of the dump, and spin_over_omega its component across the trough over omega.
TEST_F(Frames, SpinIsThatOfTheDump) {
    std::string const text = core::read_file(source.folder / "frames.60600.dump");
    std::string changed;
    std::istringstream lines(text);
    int number = 0;
    for (std::string line; std::getline(lines, line); ++number) {
        if (number == 8) line += "omegax omegay omegaz ";
        if (number > 8) line += fmt::format("{} {} 1e-60 ", number, -2.0 * number);
        changed += line + "\n";
    }
    write("frames.60600.dump", changed);
    export_frames(source, target);
    auto const data = read("grains/000002.vtp");
    for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) {
        double const line = 9.0 + static_cast<double>(i);
        EXPECT_EQ(component(*data, "spin", i, 0), line);
        EXPECT_EQ(component(*data, "spin", i, 1), -2.0 * line);
        EXPECT_EQ(component(*data, "spin", i, 2), 0.0);  // below the smallest float
        EXPECT_FLOAT_EQ(static_cast<float>(component(*data, "spin_over_omega", i, 0)),
                        static_cast<float>(-2.0 * line / omega));
    }
    EXPECT_EQ(read("grains/000001.vtp")->GetPointData()->GetArray("spin"), nullptr);
    write("frames.60600.dump", changed.replace(changed.find("omegaz"), 6, "omega_"));
    EXPECT_THAT(refusal(), HasSubstr("exactly one 'omegaz'"));
}

TEST_F(Frames, TroughIsMovedByTheRowOfTheTable) {
    export_frames(source, target);
    auto const rest = read("trough/000000.vtp");  // at phase 0
    auto const moved = read("trough/000002.vtp");
    ASSERT_EQ(rest->GetNumberOfPoints(), moved->GetNumberOfPoints());
    EXPECT_EQ(moved->GetNumberOfPolys(), 144);
    for (vtkIdType i = 0; i < rest->GetNumberOfPoints(); ++i) {
        // Floats of coordinates up to 0.05 m: rounding 2e-9 m each.
        EXPECT_NEAR(moved->GetPoint(i)[0] - rest->GetPoint(i)[0], 0.0051039, 4e-9);
        EXPECT_NEAR(moved->GetPoint(i)[1] - rest->GetPoint(i)[1], 0.0, 4e-9);
        EXPECT_NEAR(moved->GetPoint(i)[2] - rest->GetPoint(i)[2], 0.00255195, 4e-9);
    }
}

TEST_F(Frames, NoFileHasAppendedData) {
    export_frames(source, target);
    int files = 0;
    for (auto const& entry : fs::recursive_directory_iterator(target)) {
        if (entry.path().extension() != ".vtp") continue;
        ++files;
        std::string const text = core::read_file(entry.path());
        EXPECT_THAT(text, testing::Not(HasSubstr("<AppendedData"))) << entry.path();
        EXPECT_THAT(text, AllOf(HasSubstr("format=\"binary\""), HasSubstr("vtkZLibDataCompressor")));
    }
    EXPECT_EQ(files, 4 * 3);
}

// Frames are a tenth of a cycle apart, beginning at the start of cycle 20.
TEST_F(Frames, KnowCycleAndPhase) {
    export_frames(source, target);
    for (std::string const object : {"grains", "trough", "point_mass", "profile"}) {
        for (int i = 0; i < 3; ++i) {
            auto const data = read(fmt::format("{}/{:06}.vtp", object, i));
            vtkFieldData& facts = *data->GetFieldData();
            EXPECT_EQ(facts.GetArray("cycle")->GetComponent(0, 0), 20.0);
            // 60000 steps of 2.4e-5 s: 126 rad, accurate to 1e-14 rad.
            EXPECT_NEAR(facts.GetArray("vibration_phase")->GetComponent(0, 0), 36.0 * i, 1e-9);
        }
    }
}

TEST_F(Frames, ProfileHoldsAllGrains) {
    export_frames(source, target);
    auto const grains = read("grains/000001.vtp"), profile = read("profile/000001.vtp");
    double volume = 0;
    for (vtkIdType i = 0; i < grains->GetNumberOfPoints(); ++i)
        volume += 4.0 / 3.0 * std::numbers::pi * std::pow(component(*grains, "radius", i, 0), 3);
    double const thickness = 2 * component(*profile, "height", 0, 0);
    double slabs = 0;
    for (vtkIdType i = 0; i < profile->GetNumberOfPoints(); ++i)
        slabs += component(*profile, "solid_fraction", i, 0) * thickness * 0.036 * 0.018;
    EXPECT_NEAR(slabs, volume, 1e-9 * volume);
    EXPECT_EQ(profile->GetNumberOfLines(), 1);
}

TEST_F(Frames, WithoutAPeriodicMotionThereIsNoPointMass) {
    source.point_mass.reset();
    export_frames(source, target);
    EXPECT_TRUE(collection("point_mass.pvd").empty());
    EXPECT_EQ(collection("profile.pvd").size(), 3u);
}

TEST_F(Frames, SceneKnowsItsCase) {
    ExportedFrames const exported = export_frames(source, target);
    std::string const scene = core::read_file(exported.scene);
    EXPECT_THAT(scene, HasSubstr("CAPTION = \"throw number 2, \\\"quoted\\\"\"\n"));
    EXPECT_THAT(scene, HasSubstr(fmt::format("FREQUENCY = {}", omega / (2.0 * std::numbers::pi))));
    EXPECT_THAT(scene, testing::Not(HasSubstr("\"@")));
    EXPECT_EQ(fs::status(target / "view.sh").permissions() & fs::perms::owner_exec, fs::perms::owner_exec);
}

TEST_F(Frames, HalfWrittenLastFrameIsLeftOut) {
    std::string const whole = core::read_file(source.folder / "frames.60600.dump");
    for (double const share : {0.0, 0.001, 0.003, 0.5, 0.9}) {
        write("frames.60600.dump",
              whole.substr(0, static_cast<std::size_t>(share * static_cast<double>(whole.size()))));
        EXPECT_EQ(export_frames(source, target).frames, 2) << share;
        EXPECT_EQ(collection("grains.pvd").size(), 2u);
        EXPECT_EQ(collection("trough.pvd").size(), 2u);
    }
    write("frames.60600.dump", whole.substr(0, whole.size() - 1));
    EXPECT_EQ(export_frames(source, target).frames, 2);
    write("frames.60600.dump", whole);
    EXPECT_EQ(export_frames(source, target).frames, 3);
}

TEST_F(Frames, HalfWrittenTableLeavesOutTheLastFrame) {
    std::string const table = core::read_file(source.folder / "frames.csv");
    write("frames.csv", table.substr(0, table.size() - 3));
    EXPECT_EQ(export_frames(source, target).frames, 2);
}

TEST_F(Frames, HalfWrittenFrameInBetweenIsAnError) {
    std::string const whole = core::read_file(source.folder / "frames.60300.dump");
    write("frames.60300.dump", whole.substr(0, whole.size() / 2));
    EXPECT_THAT(refusal(), AllOf(HasSubstr("frames.60300.dump"), HasSubstr("ends early")));
}

TEST_F(Frames, GarbageNamesFileAndLine) {
    std::string const good = core::read_file(source.folder / "frames.60300.dump");
    auto const with = [&](std::string const& from, std::string const& to) {
        std::string text = good;
        text.replace(text.find(from), from.size(), to);
        write("frames.60300.dump", text);
        return refusal();
    };
    EXPECT_THAT(with("\n2 1 ", "\n2 x "), HasSubstr("frames.60300.dump:11: 'x "));
    EXPECT_THAT(with("\n3 1 0", "\n3 1 nan 0"), HasSubstr("frames.60300.dump:12: 'nan"));
    EXPECT_THAT(with("\n3 1 0", "\n3 1 1 0"),
                AllOf(HasSubstr("frames.60300.dump:12: '"), HasSubstr("this line")));
    EXPECT_THAT(with("ITEM: TIMESTEP", "<html>"), HasSubstr("frames.60300.dump:1: '<html>'"));
    EXPECT_THAT(with("id type", "if type"), AllOf(HasSubstr("frames.60300.dump:9: "), HasSubstr("'id'")));
    EXPECT_THAT(with("\n60300\n", "\n60301\n"), HasSubstr("frames.60300.dump:2: "));
    EXPECT_THAT(with("\n500\n", "\n499\n"),
                AllOf(HasSubstr("frames.60300.dump:509: "), HasSubstr("last row")));
    EXPECT_THAT(with("\n500\n", "\n-5\n"), HasSubstr("frames.60300.dump:4: "));
    // The header states more grains than the file contains: a truncated file in the middle of the run.
    EXPECT_THAT(with("\n500\n", "\n4000000000000\n"), HasSubstr("ends early"));
}

TEST_F(Frames, DamagedTableNamesFileAndLine) {
    std::string const good = core::read_file(source.folder / "frames.csv");
    auto const with = [&](std::string const& from, std::string const& to) {
        std::string text = good;
        text.replace(text.find(from), from.size(), to);
        write("frames.csv", text);
        return refusal();
    };
    EXPECT_THAT(with("step,trough_x", "step,x"), HasSubstr("frames.csv:2: "));
    EXPECT_THAT(with("60300,", "60300;"), HasSubstr("frames.csv:4: "));
    EXPECT_THAT(with("60300,", "59000,"), HasSubstr("frames.csv:4: "));
    EXPECT_THAT(with("60300,", "60299,"), AllOf(HasSubstr("frames.csv"), HasSubstr("step 60299")));
}

TEST_F(Frames, AnotherDriveIsNoticed) {
    source.angular_frequency = 1.37 * omega;
    EXPECT_THAT(refusal(), AllOf(HasSubstr("frames.csv"), HasSubstr("another drive")));
    source.angular_frequency = omega;
    source.drive.along[0].amplitude *= 1.2;
    EXPECT_THAT(refusal(), AllOf(HasSubstr("frames.csv"), HasSubstr("another drive")));
}

TEST_F(Frames, NoFramesAndNoGrainsStillOpen) {
    for (auto const* name : {"frames.60000.dump", "frames.60300.dump", "frames.60600.dump"}) {
        fs::remove(source.folder / name);
    }
    write("frames.csv", "# SI\nstep,trough_x,trough_z\n");
    EXPECT_EQ(export_frames(source, target).frames, 0);
    EXPECT_TRUE(collection("grains.pvd").empty());

    write("frames.csv", "# SI\nstep,trough_x,trough_z\n0,0,0\n");
    write("frames.0.dump",
          "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n0\nITEM: BOX BOUNDS pp pp ff\n0 1\n0 1\n0 1\n"
          "ITEM: ATOMS id type x y z vx vy vz radius \n");
    EXPECT_EQ(export_frames(source, target).frames, 1);
    EXPECT_EQ(read("grains/000000.vtp")->GetNumberOfPoints(), 0);
    EXPECT_EQ(read("profile/000000.vtp")->GetNumberOfPoints(), 0);
    EXPECT_GT(read("point_mass/000000.vtp")->GetNumberOfPoints(), 0);
    EXPECT_GT(read("trough/000000.vtp")->GetNumberOfPoints(), 0);
}

TEST_F(Frames, SaysWhatIsMissing) {
    EXPECT_THROW(export_frames(source, "/proc/no_such_folder"), core::MissingError);
    fs::path const dump = source.folder;
    source.folder = own_folder.path() / "none";
    EXPECT_THROW(export_frames(source, target), core::MissingError);
    source.folder = dump;
    source.trough = {own_folder.path() / "none.stl"};
    EXPECT_THROW(export_frames(source, target), core::MissingError);
    source.trough = {dump / "frames.csv"};
    EXPECT_THROW(export_frames(source, target), core::InputError);
    source.trough = {dump / "trough.stl"};
    fs::remove(dump / "frames.csv");
    EXPECT_THROW(export_frames(source, target), core::MissingError);
}

}  // namespace
}  // namespace vibrotrough::view
