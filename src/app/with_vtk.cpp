#include "app/with_vtk.hpp"

#include "core/error.hpp"
#include "core/limits.hpp"
#include "core/own_program.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <string_view>

#include <fmt/format.h>
#include <unistd.h>

namespace vibrotrough::app {
namespace {

namespace fs = std::filesystem;

enum class Need { nothing, text, files };

/// What of VTK a command line needs.
Need need_of(int argc, char** argv) {
    std::string_view const first = argc > 1 ? argv[1] : "", second = argc > 2 ? argv[2] : "";
    if (first == "export" || (first == "theory" && second == "map")) return Need::files;
    constexpr std::array<std::string_view, 2> pages{"manual", "completion"};
    bool const is_page = first.starts_with('-') || std::ranges::find(pages, first) != pages.end();
    return is_page ? Need::text : Need::nothing;
}

}  // namespace

void continue_with_vtk(std::string_view name, int argc, char** argv) {
    Need const need = need_of(argc, argv);
    if (name.empty() || need == Need::nothing) return;
    auto const own = core::find_own_program();
    fs::path const program = own ? own->parent_path() / name : fs::path(name);
    if (own) ::execv(program.c_str(), argv);
    int const failure = own ? errno : ENOENT;
    if (need == Need::text) return;
    throw core::MissingError(
        fmt::format("cannot start {}, the part of this program that writes files for ParaView ({}); install "
                    "Vibrotrough again",
                    program.string(), core::reason_of(failure)));
}

}  // namespace vibrotrough::app
