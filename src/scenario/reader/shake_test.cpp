#include "scenario/reader/shake_test.hpp"

#include "core/hash.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <sstream>
#include <vector>

#include <fmt/format.h>
#include <toml++/toml.h>

namespace vibrotrough::scenario {
namespace {

/// The same layer on a level trough that vibrates along its own surface as a sinusoid.
Scenario shaken(Scenario scenario, double machine_number) {
    Trough& trough = scenario.trough;
    trough.inclination = 0;
    trough.vibration_angle = 0;
    trough.along_phase = 0;
    trough.harmonics.clear();
    trough.waveform.reset();
    trough.given = {};
    trough.frequency = std::sqrt(machine_number * gravity / trough.amplitude) / (2 * std::numbers::pi);
    scenario.output.frames_per_cycle = 0;
    return scenario;
}

/// The keys of a campaign of one case, "section.key", with their values as TOML.
using Keys = std::map<std::string, std::string>;

Keys keys_of(Scenario const& scenario) {
    Keys keys;
    toml::table const root = toml::parse(to_toml(scenario));
    for (auto const& [section, content] : root) {
        for (auto const& [key, value] : *content.as_table()) {
            std::ostringstream text;
            value.visit([&](auto const& node) { text << node; });
            keys.emplace(std::string(section.str()) + "." + std::string(key.str()), text.str());
        }
    }
    keys.emplace("grains.shape", "\"sphere\"");  // to_toml leaves this key out for spheres
    return keys;
}

/// The keys whose values differ between the layers. All layers have the same keys, because a design sets a
/// key in every case or in none.
std::set<std::string> differing(std::vector<Keys> const& layers) {
    std::set<std::string> names;
    for (Keys const& one : layers) {
        for (auto const& [name, value] : one) {
            if (layers.front().at(name) != value) names.insert(name);
        }
    }
    return names;
}

}  // namespace

std::string shake_test_campaign(std::filesystem::path const& campaign_file, double machine_number) {
    std::string const name = campaign_file.filename().string();
    std::set<std::string> known;
    std::vector<Keys> layers;
    std::string text;
    for (Scenario const& one : read_campaign(campaign_file).cases) {
        if (!known.insert(layer_key(one)).second) continue;
        Scenario const test = shaken(one, machine_number);
        if (layers.empty())
            text = fmt::format("# The layers of {} shaken along a level trough\n{}", name, to_toml(test));
        layers.push_back(keys_of(test));
    }
    std::set<std::string> const names = differing(layers);
    for (Keys const& layer : layers) {
        if (names.empty()) break;
        text += "\n[[points]]\n";
        for (std::string const& key : names) text += fmt::format("\"{}\" = {}\n", key, layer.at(key));
    }
    return text;
}

std::string layer_key(Scenario const& scenario) {
    Scenario same = scenario;
    same.campaign = "any";
    same.trough.inclination = 0;
    same.trough.vibration_angle = 0;
    same.trough.amplitude = 0.001;
    same.trough.frequency = 1;
    same.trough.along_phase = 0;
    same.trough.harmonics.clear();
    same.trough.waveform.reset();
    same.trough.given = {};
    same.measure = {};
    same.output = {};
    std::string all = to_toml(same);
    for (NamedFile const& file : named_files(same)) all += file.content;
    return core::sha256_hex(all).substr(0, 12);
}

}  // namespace vibrotrough::scenario
