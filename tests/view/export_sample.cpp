// Exports the sample's frames into a folder, for the tests that open it in ParaView: the whole sample, and in
// the folder "poor" exports without frames, with one frame, without grains without a periodic point mass, or
// with a wall.

#include "view/frames.hpp"
#include "view/theory_map_vtk.hpp"

#include <cstdio>
#include <exception>
#include <fstream>
#include <numbers>

namespace {

namespace fs = std::filesystem;
using namespace vibrotrough;

constexpr double time_step = 2.4493014e-5;

view::FrameSource sample(fs::path const& dumps) {
    theory::Conveyor conveyor{};
    conveyor.point = {.throw_number = 2.0, .tan_vibration_angle = 0.5, .friction = 0.23};
    return {.folder = dumps,
            .trough = {dumps / "trough.stl"},
            .time_step = time_step,
            .angular_frequency = 2.0 * std::numbers::pi / (3000 * time_step),
            .drive = {.along = {{1, 0.00536656, 0}}, .normal = {{1, 0.00268328, 0}}},
            .width = 0.018,
            .point_mass = view::TheoryMotion{theory::solve(conveyor), 0.00536656, 0.00268328},
            .caption = "throw number 2, vibration angle 26.6\u00b0"};
}

constexpr char const* header = "# SI\nstep,trough_x,trough_z\n";

void export_poor(fs::path const& dumps, fs::path const& folder) {
    view::FrameSource source = sample(dumps);
    fs::path const work = folder / "dumps";
    fs::remove_all(folder);
    fs::create_directories(work);
    source.folder = work;
    std::ofstream(work / "frames.csv") << header;
    view::export_frames(source, folder / "none");

    std::ofstream(work / "frames.csv") << header << "60000,0,0\n";
    fs::copy(dumps / "frames.60000.dump", work);
    view::export_frames(source, folder / "one");

    std::ofstream(work / "frames.60000.dump") << "ITEM: TIMESTEP\n60000\nITEM: NUMBER OF ATOMS\n0\nITEM: BOX "
                                                 "BOUNDS pp pp ff\n0 0.036\n0 0.018\n0 1\n"
                                                 "ITEM: ATOMS id type x y z vx vy vz radius \n";
    view::export_frames(source, folder / "no_grains");

    source = sample(dumps);
    source.point_mass.reset();
    view::export_frames(source, folder / "no_point_mass");

    scenario::Triangle const one{{{0, 0, 0}, {0.036, 0, 0}, {0.036, 0, 0.1}}},
        other{{{0, 0, 0}, {0.036, 0, 0.1}, {0, 0, 0.1}}};
    std::ofstream(work / "left.stl") << scenario::stl_text("wall", {one, other});
    source.walls = {work / "left.stl"};
    view::export_frames(source, folder / "walls");
}

void export_maps(fs::path const& folder) {
    fs::create_directories(folder);
    theory::Inputs inputs;
    inputs.set(theory::Input::friction, 0.35);
    theory::Map const map = theory::solve_map(inputs, {theory::Input::throw_number, 0.5, 3, 6},
                                              {theory::Input::vibration_angle_deg, 10, 50, 5}, {.jobs = 1});
    view::write_theory_image(folder / "map.vti", map);
    view::write_theory_boundaries(folder / "modes.vtp", map);
}

void export_contacts(fs::path const& dumps, fs::path const& folder) {
    view::FrameSource const source{
        .folder = dumps,
        .trough = {dumps / "trough.stl"},
        .time_step = 5.195752952985837e-05,
        .angular_frequency = 2.0 * std::numbers::pi * 19.246488604223018,
        .drive = {.along = {{1, 0.002683281573, 0}}, .normal = {{1, 0.001341640787, 0}}},
        .width = 0.015,
        .caption = "contacts"};
    view::export_frames(source, folder);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 4) {
        std::fprintf(stderr, "usage: view_export_sample DUMPS FOLDER DUMPS_WITH_CONTACTS\n");
        return 2;
    }
    try {
        fs::path const folder = argv[2];
        view::ExportedFrames const exported = view::export_frames(sample(argv[1]), folder);
        std::printf("%d frames, %s\n", exported.frames, exported.scene.c_str());
        export_poor(argv[1], folder / "poor");
        export_maps(folder / "maps");
        export_contacts(argv[3], folder / "contacts");
        return 0;
    } catch (std::exception const& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
