#include "view/scene.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "view/scene_template.hpp"

#include <algorithm>
#include <numbers>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace vibrotrough::view {
namespace {

void replace_all(std::string& text, std::string_view from, std::string const& to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
        text.replace(at, from.size(), to);
    }
}

/// Converts the text to a Python string literal.
std::string python_literal(std::string_view text) {
    std::string literal = "\"";
    for (char const c : text) {
        if (c == '"' || c == '\\') literal += '\\';
        literal += c == '\n' ? ' ' : c;
    }
    return literal + '"';
}

}  // namespace

std::filesystem::path write_scene(FrameSource const& source, std::filesystem::path const& target) {
    std::string script(scene_template);
    // The colour scale is set by the largest speed of the trough, so that colours are comparable between
    // frames and cases.
    double speed = scenario::largest_speed({source.drive.along, {}}, source.angular_frequency);
    if (!(speed > 0.0)) speed = largest_speed(source.drive, source.angular_frequency);
    std::pair<std::string_view, std::string> const values[] = {
        {"\"@CAPTION@\"", python_literal(source.caption)},
        {"\"@FREQUENCY@\"", fmt::format("{}", source.angular_frequency / (2.0 * std::numbers::pi))},
        {"\"@SPEED@\"", fmt::format("{}", speed > 0.0 ? speed : 1.0)},
    };
    for (auto const& [name, value] : values) replace_all(script, name, value);
    core::write_file_atomically(target / "view_case.py", script);

    std::filesystem::path const starter = target / "view.sh";
    core::write_file_atomically(starter, scene_starter);
    std::error_code failure;
    std::filesystem::permissions(starter, std::filesystem::perms{0755}, failure);
    if (failure) {
        throw core::MissingError(
            fmt::format("cannot make {} executable ({})", starter.string(), failure.message()));
    }
    return target / "view_case.py";
}

}  // namespace vibrotrough::view
