#include "view/scene.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/template.hpp"
#include "view/scene_template.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::view {
namespace {

/// The scene's template is a Python program, so that it can be checked as one: its tags are texts.
constexpr core::TemplateTags tags{"\"@", "@\""};

/// In the order of the enumeration.
constexpr std::array<std::string_view, 6> colour_names{"velocity", "spin", "height",
                                                       "trough",   "size", "material"};

/// Converts the text to a Python string literal.
std::string python_literal(std::string_view text) {
    std::string literal = "\"";
    for (char const c : text) {
        if (c == '"' || c == '\\') literal += '\\';
        literal += c == '\n' ? ' ' : c;
    }
    return literal + '"';
}

/// The list of types and names of the materials as Python has it.
std::string python_materials(FrameSource const& source) {
    std::string list;
    for (auto const& [type, name] : source.materials)
        list += fmt::format("({}, {}), ", type, python_literal(name));
    return "[" + list + "]";
}

}  // namespace

std::string_view name_of(Colour colour) {
    return colour_names.at(static_cast<std::size_t>(colour));
}

Colour colour_named(std::string_view name) {
    auto const found = std::ranges::find(colour_names, name);
    if (found != colour_names.end()) return static_cast<Colour>(found - colour_names.begin());
    throw core::InputError(fmt::format("grains cannot be coloured by '{}'; choose one of {}", name,
                                       fmt::join(colour_names, ", ")));
}

std::filesystem::path write_scene(FrameSource const& source, ColourScales const& scales,
                                  std::optional<GrainSpace> const& space,
                                  std::filesystem::path const& target) {
    // The trough's own largest speed sets the colours of velocities relative to it and the width of a chart.
    double speed = scenario::largest_speed({source.drive.along, {}}, source.angular_frequency);
    if (!(speed > 0.0)) speed = largest_speed(source.drive, source.angular_frequency);
    core::TemplateData data;
    data.set("CAPTION", python_literal(source.caption));
    data.set("FREQUENCY", fmt::format("{}", source.angular_frequency / (2.0 * std::numbers::pi)));
    data.set("SPEED", fmt::format("{}", speed > 0.0 ? speed : 1.0));
    data.set("COLOUR", python_literal(name_of(source.colour)));
    data.set("MATERIALS", python_materials(source));
    data.set("VELOCITY_REACH", fmt::format("{}", scales.velocity()));
    data.set("SPIN_REACH", fmt::format("{}", scales.spin()));
    data.set("HEIGHT_REACH", fmt::format("{}", scales.height()));
    data.set("GRAIN_SPACE",
             space ? fmt::format("({}, {}, {}, {})", space->left, space->right, space->bottom, space->top)
                   : "None");
    core::write_file_atomically(target / "view_case.py", core::render(scene_template, data, tags));

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
