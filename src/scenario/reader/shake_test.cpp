#include "scenario/reader/shake_test.hpp"

#include "core/hash.hpp"
#include "scenario/reader/written_campaign.hpp"

#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include <fmt/format.h>

namespace vibrotrough::scenario {
namespace {

/// Makes a trough level and its motion a sinusoid along its own surface.
void level(Trough& trough) {
    trough.inclination = 0;
    trough.vibration_angle = 0;
    trough.along_phase = 0;
    trough.harmonics.clear();
    trough.waveform.reset();
    trough.waveform_order.reset();
    trough.given = {};
}

/// The same layer on such a trough.
Scenario shaken(Scenario scenario, double machine_number) {
    Trough& trough = scenario.trough;
    level(trough);
    trough.frequency = std::sqrt(machine_number * trough.gravity / trough.amplitude) / (2 * std::numbers::pi);
    scenario.output.frames_per_cycle = 0;
    return scenario;
}

}  // namespace

std::string shake_test_campaign(std::filesystem::path const& campaign_file, double machine_number) {
    std::string const name = campaign_file.filename().string();
    std::set<std::string> known;
    std::vector<Scenario> layers;
    for (Scenario const& one : read_campaign(campaign_file).cases) {
        require_steady_drive(one, "friction-test");
        if (known.insert(layer_key(one)).second) layers.push_back(shaken(one, machine_number));
    }
    return campaign_toml(layers, fmt::format("The layers of {} shaken along a level trough", name));
}

std::string layer_key(Scenario const& scenario) {
    Scenario same = scenario;
    same.campaign = "any";
    level(same.trough);
    same.trough.amplitude = 0.001;
    same.trough.frequency = 1;
    same.trough.width = {};
    same.measure = {};
    same.output = {};
    std::string all = to_toml(same);
    for (NamedFile const& file : named_files(same)) all += file.content;
    return core::sha256_hex(all).substr(0, 12);
}

}  // namespace vibrotrough::scenario
