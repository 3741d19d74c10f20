#pragma once

#include "learn/risk_design.hpp"

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace vibrotrough::learn {

/// What a model promised of a layer, and what its simulation says. Half-widths are of 95 % intervals. That of
/// the simulation contains its numerical errors; that of the promise does not, since a model that rests on
/// simulations has the same ones.
struct ComparedLayer {
    double friction;                         ///< of the material on the trough
    std::string model;                       ///< that promised it
    double promised, promised_half_width;    ///< velocity efficiency
    double simulated, simulated_half_width;  ///< velocity efficiency

    /// Whether they differ by no more than both half-widths, combined in squares.
    bool agrees() const;
};

/// A machine that was simulated at its own depth.
struct SimulatedMachine {
    std::string campaign;               ///< path of its campaign file
    theory::Drive drive;                ///< of the machine
    double depth;                       ///< m, of its layer
    std::vector<ComparedLayer> layers;  ///< by friction, and within a friction by model
    /// That it carries the mass flow, by the corrected models; nothing where their error is not known.
    std::optional<double> probability;
};

/// How a verification ended.
enum class Verdict {
    verified,    ///< the simulation agrees with the promise, and the mass flow is reached
    no_machine,  ///< by the corrected models, no machine within the limits reaches the mass flow
    budget,      ///< the core time was not enough
    too_many,    ///< it was not found among the machines that are simulated at most
    no_speed,    ///< a layer has no steady speed, or no result
};

/// The machines that were simulated for a task until simulation and promise agreed.
struct Verification {
    Verdict verdict = Verdict::budget;       ///< how it ended
    std::string why = {};                    ///< it ended so, for people: a sentence without a full stop
    std::vector<SimulatedMachine> machines;  ///< in the order in which they were proposed
    double core_time = 0;                    ///< s, of all packings
};

/// The verdict with its reason.
std::string verification_sentence(DesignTask const& task, Verification const& verification);

/// The machines, promises and simulations for people, after the verdict in a sentence.
std::string verification_text(DesignTask const& task, Verification const& verification);

/// All numbers for programs: `verdict` (verified, no-machine, budget, too-many,
/// no-speed), `why`, `core_hours`,
/// `machines`.
nlohmann::ordered_json verification_json(Verification const& verification);

}  // namespace vibrotrough::learn
