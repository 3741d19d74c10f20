#include "view/vtk.hpp"

namespace vibrotrough::view {

bool has_vtk() {
    return true;
}

std::string vtk_name() {
    return "VTK " VIBROTROUGH_VTK_VERSION;
}

std::string vtk_help() {
    return "";
}

void require_vtk() {}

}  // namespace vibrotrough::view
