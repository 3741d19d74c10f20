#include "app/version_text.hpp"

#include "app/build_data.hpp"
#include "core/error.hpp"
#include "core/version.hpp"
#include "engine/engine.hpp"
#include "view/vtk.hpp"

#include <fmt/format.h>

namespace vibrotrough::app {
namespace {

std::string engine_line() {
    try {
        engine::Engine const engine = engine::find_engine({});
        return fmt::format("{}, {}", engine.program.string(), engine.version);
    } catch (core::Error const& error) {
        return fmt::format("none ({})", error.what());
    }
}

}  // namespace

std::string version_text() {
    return fmt::format("vibrotrough {} ({})\ncompiler   {}\nlibraries  {}, {}\nengine     {}",
                       core::program_version(), core::program_commit(), build_compiler, build_libraries,
                       view::vtk_name(), engine_line());
}

}  // namespace vibrotrough::app
