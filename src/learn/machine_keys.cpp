#include "learn/machine_keys.hpp"

#include "scenario/model/scenario.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace vibrotrough::learn {
namespace {

using theory::Drive;

constexpr std::array<MachineKey, 9> machine_keys{{
    {"trough.frequency", [](Drive const& d) { return d.frequency; }},
    {"trough.amplitude", [](Drive const& d) { return d.amplitude; }},
    {"trough.stroke", [](Drive const& d) { return 2 * d.amplitude; }},
    {"trough.vibration_angle", [](Drive const& d) { return d.vibration_angle; }},
    {"trough.tan_vibration_angle", [](Drive const& d) { return std::tan(d.vibration_angle); }},
    {"trough.inclination", [](Drive const& d) { return d.inclination; }},
    {"trough.tan_inclination", [](Drive const& d) { return std::tan(d.inclination); }},
    {"trough.machine_number", [](Drive const& d) { return d.machine_number(scenario::gravity); }},
    {"trough.throw_number", [](Drive const& d) { return d.throw_number(scenario::gravity); }},
}};

}  // namespace

MachineKey const* machine_key(std::string_view key) {
    auto const found = std::ranges::find(machine_keys, key, &MachineKey::key);
    return found == machine_keys.end() ? nullptr : &*found;
}

}  // namespace vibrotrough::learn
