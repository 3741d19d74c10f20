// The module in a program without VTK, in place of all its other files.

#include "core/error.hpp"
#include "view/frames.hpp"
#include "view/scene.hpp"
#include "view/theory_map_vtk.hpp"
#include "view/vtk.hpp"

namespace vibrotrough::view {
namespace {

[[noreturn]] void refuse() {
    throw core::MissingError(
        "this program was built without VTK and writes no files for ParaView; run this command, on the same "
        "files, with a program that was built with VTK (cmake -DVIBROTROUGH_VIEW=ON)");
}

}  // namespace

bool has_vtk() {
    return false;
}

std::string vtk_name() {
    return "no VTK (VIBROTROUGH_VIEW=OFF: no files for ParaView)";
}

std::string vtk_help() {
    return "This program was built without VTK and writes no files for ParaView. A program that was built "
           "with VTK (cmake -DVIBROTROUGH_VIEW=ON) does so from the same files.\n\n";
}

void require_vtk() {
    refuse();
}

Colour colour_named(std::string_view /*name*/) {
    refuse();
}

ExportedFrames export_frames(FrameSource const& /*source*/, std::filesystem::path const& /*target*/,
                             std::function<void(int written, int all)> const& /*progressed*/) {
    refuse();
}

void write_theory_image(std::filesystem::path const& /*path*/, theory::Map const& /*map*/) {
    refuse();
}

void write_theory_boundaries(std::filesystem::path const& /*path*/, theory::Map const& /*map*/) {
    refuse();
}

}  // namespace vibrotrough::view
