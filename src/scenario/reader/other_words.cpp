#include "scenario/reader/other_words.hpp"

#include "scenario/reader/keys.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <utility>

namespace vibrotrough::scenario {
namespace {

using Word = std::pair<std::string_view, std::string_view>;

/// Words, in small letters, and the key that each means. Of several rows with a word, that of the section in
/// which it is written counts, else the first.
constexpr std::array keys_of_words{
    Word{"polydispersity", "grains.diameter_spread"},
    Word{"spread", "grains.diameter_spread"},
    Word{"size_spread", "grains.diameter_spread"},
    Word{"size_distribution", "grains.size_law"},
    Word{"distribution", "grains.size_law"},
    Word{"psd", "grains.size_law"},
    Word{"mu", "trough.friction"},
    Word{"mu", "grains.friction"},
    Word{"friction_coefficient", "trough.friction"},
    Word{"friction_coefficient", "grains.friction"},
    Word{"coefficient_of_friction", "trough.friction"},
    Word{"coefficient_of_friction", "grains.friction"},
    Word{"e", "trough.restitution"},
    Word{"e", "grains.restitution"},
    Word{"restitution_coefficient", "trough.restitution"},
    Word{"restitution_coefficient", "grains.restitution"},
    Word{"rolling", "grains.rolling_friction"},
    Word{"mu_r", "grains.rolling_friction"},
    Word{"k", "trough.machine_number"},
    Word{"machine_factor", "trough.machine_number"},
    Word{"acceleration", "trough.machine_number"},
    Word{"gamma", "trough.throw_number"},
    Word{"throw_factor", "trough.throw_number"},
    Word{"throw", "trough.throw_number"},
    Word{"speed", "trough.frequency"},
    Word{"rpm", "trough.frequency"},
    Word{"turns", "trough.frequency"},
    Word{"rotational_speed", "trough.frequency"},
    Word{"f", "trough.frequency"},
    Word{"omega", "trough.frequency"},
    Word{"r", "trough.amplitude"},
    Word{"peak_to_peak", "trough.stroke"},
    Word{"angle", "trough.vibration_angle"},
    Word{"drive_angle", "trough.vibration_angle"},
    Word{"throw_angle", "trough.vibration_angle"},
    Word{"beta", "trough.vibration_angle"},
    Word{"alpha", "trough.inclination"},
    Word{"slope", "trough.inclination"},
    Word{"tilt", "trough.inclination"},
    Word{"stl", "trough.mesh"},
    Word{"depth", "layer.height"},
    Word{"thickness", "layer.height"},
    Word{"depth_in_diameters", "layer.diameters"},
    Word{"height_in_diameters", "layer.diameters"},
    Word{"count", "layer.grains"},
    Word{"number", "layer.grains"},
    Word{"particles", "layer.grains"},
    Word{"n", "layer.grains"},
    Word{"size", "grains.diameter"},
    Word{"d", "grains.diameter"},
    Word{"d50", "grains.diameter"},
    Word{"radius", "grains.diameter"},
    Word{"rho", "grains.density"},
    Word{"young", "grains.youngs_modulus"},
    Word{"stiffness", "grains.youngs_modulus"},
    Word{"nu", "grains.poisson_ratio"},
    Word{"poisson", "grains.poisson_ratio"},
    Word{"seeds", "measure.packings"},
    Word{"repetitions", "measure.packings"},
    Word{"replicates", "measure.packings"},
    Word{"precision", "measure.half_width"},
    Word{"tolerance", "measure.half_width"},
    Word{"cycles", "measure.max_cycles"},
    Word{"frames", "output.frames_per_cycle"},
    Word{"time_step", "solver.rayleigh_fraction"},
    Word{"timestep", "solver.rayleigh_fraction"},
    Word{"dt", "solver.rayleigh_fraction"},
};

constexpr std::array sections_of_words{
    Word{"drive", "trough"},       Word{"vibration", "trough"}, Word{"machine", "trough"},
    Word{"conveyor", "trough"},    Word{"particles", "grains"}, Word{"particle", "grains"},
    Word{"material", "grains"},    Word{"bed", "layer"},        Word{"box", "layer"},
    Word{"simulation", "measure"},
};

std::string in_small_letters(std::string_view text) {
    std::string small(text);
    std::ranges::transform(small, small.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return small;
}

bool is_in_section(std::string_view path, std::string_view section) {
    return path.starts_with(section) && path.size() > section.size() && path[section.size()] == '.';
}

/// The only key outside of lists with this last name; empty when there are several or none.
std::string_view only_key_named(std::string_view name) {
    std::string_view found;
    for (Key const& key : all_keys()) {
        if (last_name(key.path) != name || is_list_section(key.path.substr(0, key.path.find('.')))) continue;
        if (!found.empty()) return {};
        found = key.path;
    }
    return found;
}

/// The key of the same entry of a list that a word means in a section, such as materials.1.friction for
/// materials.1.mu; empty when it means none.
std::string_view key_of_entry(std::string_view path, std::string_view name) {
    std::string_view const entry = path.substr(0, path.rfind('.') + 1);
    auto const key_of = [&](std::string const& last) {
        auto const found = std::ranges::find(all_keys(), std::string(entry) + last, &Key::path);
        return found == all_keys().end() ? std::string_view{} : found->path;
    };
    for (auto const& [word, meant] : keys_of_words) {
        if (word != name) continue;
        std::string const last(last_name(meant)), of_trough = "trough_" + last;
        for (std::string const& one : {is_in_section(meant, "trough") ? of_trough : last, last})
            if (std::string_view const key = key_of(one); !key.empty()) return key;
    }
    return {};
}

}  // namespace

std::string_view key_in_other_words(std::string_view path) {
    std::string_view const first = path.substr(0, path.find('.'));
    std::string const name = in_small_letters(last_name(path));
    if (is_list_section(first)) return key_of_entry(path, name);
    std::string_view meant;
    for (auto const& [word, key] : keys_of_words) {
        if (word != name) continue;
        if (is_in_section(key, first)) return key;
        if (meant.empty()) meant = key;
    }
    return meant.empty() ? only_key_named(name) : meant;
}

std::string_view section_in_other_words(std::string_view name) {
    auto const found = std::ranges::find(sections_of_words, in_small_letters(name), &Word::first);
    return found == sections_of_words.end() ? std::string_view{} : found->second;
}

}  // namespace vibrotrough::scenario
