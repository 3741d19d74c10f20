#pragma once

#include "core/parallel.hpp"
#include "learn/risk_design.hpp"
#include "learn/verification.hpp"

#include <string>

namespace vibrotrough::app {

/// How a design is verified.
struct VerificationOptions {
    std::string output = "runs/design";        ///< folder of the campaigns and their results
    double budget = 3600;                      ///< core-seconds of all simulations
    std::string engine;                        ///< path of the engine; empty for the one on the PATH
    bool quiet = false;                        ///< show no progress
    int jobs = core::count_available_cores();  ///< cores to use
};

/// A design and how it was verified.
struct VerifiedDesign {
    learn::DesignTask task;            ///< with corrected models
    learn::RiskDesign design;          ///< of the machine that was verified, or of the last one
    learn::Verification verification;  ///< what was simulated
    bool is_interrupted = false;       ///< by a signal; the same call goes on
};

/// The machine that a task's models propose, simulated or not.
/// @throws core::InputError when no machine keeps the limits of the task
learn::RiskDesign propose_machine(learn::DesignTask const& task);

/// Simulates the machine that a task's models propose, at its own depth and with grains of its diameter, at
/// the median of the friction and at the ends of its central 95 %; corrects the models with what the layers
/// say, and repeats, until a machine's simulation agrees with what was promised of it and the mass flow is
/// reached with the task's confidence, or there is no such machine, or the next one would exceed the budget.
///
/// Each machine has its campaign file machine_N.toml and its results machine_N in the folder, so that the
/// same call later finds what is there.
/// @param task  with the diameter of the grains
/// @throws core::InputError when no machine keeps the limits of the task
/// @throws core::MissingError when there is no usable engine or the disk refuses
VerifiedDesign verify_design(learn::DesignTask const& task, VerificationOptions const& options);

}  // namespace vibrotrough::app
