#pragma once

#include "scenario/model/drive.hpp"

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

/// @file
/// Drives in stages: each [[stages]] is a time in which the trough has one drive, or stands still.

namespace vibrotrough::scenario {

struct Scenario;
struct Stage;

/// One of [[stages]] as the campaign file gives it. What it does not give about the drive is that of the
/// stage before, and of the first stage that of [trough].
struct GivenStage {
    std::optional<int> cycles = {};                      ///< its length, with the ramp
    std::optional<double> time = {};                     ///< s, its length, with the ramp
    std::optional<int> ramp_cycles = {};                 ///< length of the ramp at its beginning
    std::optional<double> ramp = {};                     ///< s, length of the ramp at its beginning
    bool standstill = false;                             ///< the trough stands still
    std::optional<double> vibration_angle = {};          ///< rad
    std::optional<double> tan_vibration_angle = {};      ///< tan(beta)
    std::optional<double> amplitude = {};                ///< m
    std::optional<double> throw_number = {};             ///< Gamma
    std::optional<double> machine_number = {};           ///< K
    std::optional<double> frequency = {};                ///< Hz
    std::optional<double> along_phase = {};              ///< rad
    std::shared_ptr<Waveform const> waveform = nullptr;  ///< a measured motion
    std::optional<double> mass_flow = {};                ///< kg/s, fed into an open trough
};

/// The stages of a case in their order; none when its drive has no stages. A length that is given as a time
/// becomes a whole number of cycles, and so does a ramp.
std::vector<Stage> stages(Scenario const& scenario);

/// The duration of each cycle of all stages, s.
std::vector<double> cycle_durations(std::vector<Stage> const& stages);

/// For what works with steady drives and layers only.
/// @param what  that it is, the begin of the message
/// @throws core::InputError when the drive has stages, or grains leave the layer through a screen
void require_steady_drive(Scenario const& scenario, std::string_view what);

/// Cycles of all stages.
int cycles_of(std::vector<Stage> const& stages);

}  // namespace vibrotrough::scenario
