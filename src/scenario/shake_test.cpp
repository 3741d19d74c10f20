#include "scenario/shake_test.hpp"

#include "core/atomic_file.hpp"
#include "core/hash.hpp"

#include <array>
#include <sstream>
#include <string_view>

#include <toml++/toml.h>

namespace vibrotrough {
namespace {

/// Keys that say how the trough moves and how it stands.
constexpr std::array drive_keys{
    "trough.inclination",  "trough.tan_inclination", "trough.vibration_angle", "trough.tan_vibration_angle",
    "trough.throw_number", "trough.machine_number",  "trough.frequency",       "output.frames_per_cycle"};

void erase(toml::table& root, std::string_view path) {
    std::size_t const dot = path.find('.');
    if (toml::table* const section = root[path.substr(0, dot)].as_table())
        section->erase(path.substr(dot + 1));
    if (toml::table* const sweep = root["sweep"].as_table()) sweep->erase(path);
}

/// The first of the amplitudes that were swept takes the place of the sweep.
void keep_one_amplitude(toml::table& root, toml::table& trough) {
    toml::table* const sweep = root["sweep"].as_table();
    toml::node const* const swept = sweep ? sweep->get("trough.amplitude") : nullptr;
    if (!swept) return;
    toml::array const* const list = swept->as_array();
    toml::node const* const first = list ? list->get(0) : swept->as_table()->get("from");
    trough.insert_or_assign("amplitude", *first->as_string());
    sweep->erase("trough.amplitude");
}

}  // namespace

std::string shake_test_campaign(std::filesystem::path const& campaign_file, double machine_number) {
    read_campaign(campaign_file);  // from here on the file is known to be right
    toml::table root = toml::parse(read_file(campaign_file));
    toml::table& trough = *root["trough"].as_table();
    keep_one_amplitude(root, trough);
    for (char const* const key : drive_keys) erase(root, key);
    trough.insert_or_assign("tan_inclination", 0.0);
    trough.insert_or_assign("tan_vibration_angle", 0.0);
    trough.insert_or_assign("machine_number", machine_number);
    std::ostringstream text;
    text << "# The layers of " << campaign_file.filename().string() << " shaken along a level trough\n"
         << root << "\n";
    return text.str();
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
    same.measure = {};
    same.output = {};
    std::string all = to_toml(same);
    for (NamedFile const& file : named_files(same)) all += file.content;
    return sha256_hex(all).substr(0, 12);
}

}  // namespace vibrotrough
