#pragma once

#include "campaign/schedule/forecast.hpp"

namespace vibrotrough::campaign {

/// How fast the user's machines simulate, for forecasts of campaigns without a result.
struct MachineSpeed {
    double grain_steps;  ///< of a small layer per second and core
    bool is_measured;    ///< in the last campaign of plain layers; else deck::usual_speed
};

/// What the last campaign of plain layers showed, wherever it ran.
MachineSpeed machine_speed();

/// Notes what a run of plain layers has shown, beside the certificates of engines
/// (engine::certificate_folder()). A run of a few core-seconds shows nothing. What cannot be noted is not:
/// only forecasts rest on it.
void note_machine_speed(WorkOfRun const& work);

}  // namespace vibrotrough::campaign
