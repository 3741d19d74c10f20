#include "core/atomic_file.hpp"
#include "frame_export.hpp"

#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

namespace vibrotrough::view {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Two frames with contacts of a real run (60 grains of 1400 kg/m3, 4 frames per cycle): the settled layer
/// before the first step, and the layer in flight a quarter of a cycle later.
class Contacts : public FrameExport {
  protected:
    Contacts()
        : FrameExport(VIEW_TEST_CONTACTS,
                      {.folder = {},
                       .trough = {},
                       .time_step = 5.195752952985837e-05,
                       .angular_frequency = 2 * std::numbers::pi * 19.246488604223018,
                       .drive = {.along = {{1, 0.002683281573, 0}}, .normal = {{1, 0.001341640787, 0}}},
                       .width = 0.015,
                       .caption = ""}) {}

    void damage(std::string const& name, std::string const& from, std::string const& to) const {
        std::string text = core::read_file(source.folder / name);
        text.replace(text.find(from), from.size(), to);
        std::ofstream(source.folder / name, std::ios::trunc) << text;
    }
};

/// The radius of each grain by its number.
std::map<int, double> radii_of(vtkPolyData& grains) {
    std::map<int, double> radii;
    for (vtkIdType i = 0; i < grains.GetNumberOfPoints(); ++i)
        radii[static_cast<int>(grains.GetPointData()->GetArray("id")->GetComponent(i, 0))] =
            grains.GetPointData()->GetArray("radius")->GetComponent(i, 0);
    return radii;
}

// At rest the vertical forces on each grain sum to its weight m g. A settled layer trembles: the largest
// imbalance of a grain in such layers was seen to be 1 % of its weight, that of the layer 0.4 %.
TEST_F(Contacts, BalanceTheWeightOfEachGrain) {
    ExportedFrames const exported = export_frames(source, target);
    EXPECT_EQ(exported.contacts, target / "contacts.pvd");
    auto const contacts = read("contacts/000000.vtp"), grains = read("grains/000000.vtp");
    auto const radii = radii_of(*grains);
    vtkCellData& values = *contacts->GetCellData();
    std::map<int, double> force;
    double on_layer = 0, weight_of_layer = 0;
    for (vtkIdType i = 0; i < contacts->GetNumberOfLines(); ++i) {
        double const fz = values.GetArray("force")->GetComponent(i, 2);
        int const first = static_cast<int>(values.GetArray("first_grain")->GetComponent(i, 0)),
                  second = static_cast<int>(values.GetArray("second_grain")->GetComponent(i, 0));
        force[first] += fz;
        force[second] -= fz;
    }
    on_layer = -force[0];
    for (auto const& [id, radius] : radii) {
        double const weight = 1400 * 4.0 / 3 * std::numbers::pi * std::pow(radius, 3) * 9.81;
        weight_of_layer += weight;
        EXPECT_NEAR(force[id] / weight, 1, 0.03) << "grain " << id;
    }
    EXPECT_NEAR(on_layer / weight_of_layer, 1, 0.01);
}

// The line of a contact is as long as the radii less the overlap, also through the periodic boundaries; its
// forces are at right angles: F^2 = N^2 + T^2.
TEST_F(Contacts, AreLinesBetweenCentres) {
    export_frames(source, target);
    auto const contacts = read("contacts/000000.vtp"), grains = read("grains/000000.vtp");
    auto radii = radii_of(*grains);
    radii[0] = 0;  // the trough
    vtkCellData& values = *contacts->GetCellData();
    auto const value = [&](char const* name, vtkIdType i) {
        return values.GetArray(name)->GetComponent(i, 0);
    };
    ASSERT_EQ(contacts->GetNumberOfPoints(), 2 * contacts->GetNumberOfLines());
    int outside = 0, with_trough = 0;
    for (vtkIdType i = 0; i < contacts->GetNumberOfLines(); ++i) {
        std::array<double, 3> start{}, end{};
        contacts->GetPoint(2 * i, start.data());
        contacts->GetPoint(2 * i + 1, end.data());
        double const length = std::hypot(end[0] - start[0], end[1] - start[1], end[2] - start[2]);
        int const first = static_cast<int>(value("first_grain", i)),
                  second = static_cast<int>(value("second_grain", i));
        // Six digits of coordinates up to 0.015 m: 5e-8 m each.
        EXPECT_NEAR(length, radii.at(first) + radii.at(second) - value("overlap", i), 3e-7);
        double const n = value("normal_force", i), t = value("tangential_force", i);
        double const* const f = values.GetArray("force")->GetTuple3(i);
        // Six digits of each component.
        EXPECT_NEAR(std::hypot(f[0], f[1], f[2]), std::hypot(n, t), 1e-5 * std::hypot(n, t));
        outside += end[0] < 0 || end[0] > 0.015 || end[1] < 0 || end[1] > 0.015 ? 1 : 0;
        with_trough += second == 0 ? 1 : 0;
    }
    EXPECT_GT(outside, 5);
    EXPECT_GT(with_trough, 10);
    EXPECT_THAT(core::read_file(target / "contacts/000000.vtp"), testing::Not(HasSubstr("<AppendedData")));
    EXPECT_EQ(contacts->GetFieldData()->GetArray("TimeValue")->GetComponent(0, 0), 0.0);
}

// While the engine writes the last frame, its contacts may be missing or cut.
TEST_F(Contacts, OfAnUnfinishedFrameAreLeftOut) {
    fs::remove(source.folder / "trough_contacts.250.dump");
    EXPECT_EQ(export_frames(source, target).frames, 2);
    std::string collection = core::read_file(target / "contacts.pvd");
    EXPECT_THAT(collection, HasSubstr("contacts/000000.vtp"));
    EXPECT_THAT(collection, testing::Not(HasSubstr("contacts/000001.vtp")));
    fs::resize_file(source.folder / "contacts.0.dump", 5000);
    export_frames(source, target);
    EXPECT_THAT(core::read_file(target / "contacts.pvd"), testing::Not(HasSubstr("DataSet")));
}

TEST_F(Contacts, AreChecked) {
    damage("contacts.0.dump", " c_overlaps[16]", "");
    EXPECT_THAT(refusal(), HasSubstr("contacts.0.dump:10: "));
    damage("trough_contacts.250.dump", "250", "500");
    EXPECT_THAT(refusal(), HasSubstr("contacts.0.dump:10: "));
    fs::remove(source.folder / "contacts.0.dump");
    EXPECT_THAT(refusal(),
                HasSubstr("trough_contacts.250.dump: it should have 16 columns and be of step 250"));
}

TEST_F(Contacts, AreOnlyThereWhenTheyWereWritten) {
    for (char const* name : {"contacts.0.dump", "contacts.250.dump"}) fs::remove(source.folder / name);
    EXPECT_TRUE(export_frames(source, target).contacts.empty());
    EXPECT_FALSE(fs::exists(target / "contacts.pvd"));
}

}  // namespace
}  // namespace vibrotrough::view
