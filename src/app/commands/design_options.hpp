#pragma once

#include "app/commands/exciter_options.hpp"
#include "app/commands/material_options.hpp"
#include "app/commands/theory/drive_space.hpp"
#include "learn/atlas_design_model.hpp"
#include "learn/risk_design.hpp"
#include "learn/surface_design_model.hpp"

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace vibrotrough::app {

/// The options of `vibrotrough design` that describe its task.
struct DesignOptions {
    QuantityOptions quantities;         ///< of the task, its material and its answer
    Text mass_flow, posterior;          ///< to be carried; in place of the friction
    DriveTexts drive;                   ///< among which it chooses
    ExciterOptions exciter;             ///< and springs
    MaterialOptions material;           ///< a name, or a kind of grains
    std::vector<std::string> models;    ///< point-mass, rolling-layer, atlas, surface
    std::string surface;                ///< folder of the campaign of the surface
    std::vector<std::string> places;    ///< KEY=VALUE of the surface's other inputs
    std::string objective = "fastest";  ///< what to be best at

    /// Declares the options of the command.
    void add_to(CLI::App& command);
    /// The task with its models. @throws core::InputError when an option is missing, wrong or contradicts
    /// another
    learn::DesignTask task() const;
    /// Puts what a named material usually is in place of what was not given. Before task().
    /// @throws core::InputError for grains that no model knows
    void take_material() { material.fill_in(quantities, posterior.has_value()); }
    /// Whether the material decides by which model, since the user names none.
    bool material_chooses_model() const;

  private:
    void add_material(CLI::App& command);
    void add_limits(CLI::App& command);
    learn::KnownGrains read_grains() const;
    learn::KnownFriction read_friction(std::string& calibrated_model) const;
    std::vector<learn::DesignModel> read_models(learn::KnownFriction const& known) const;
    learn::DesignModel read_surface(learn::KnownFriction const& known) const;
    void choose_models(learn::DesignTask& task) const;
    void keep_to_drive(learn::DesignTask& task) const;
};

}  // namespace vibrotrough::app
