#pragma once

#include "app/commands/material_options.hpp"
#include "app/commands/option_table.hpp"
#include "app/commands/predict_layers.hpp"
#include "learn/machine_prediction.hpp"

namespace vibrotrough::app {

/// The options of `vibrotrough predict` that describe a machine which exists, in place of a campaign file.
class MachineOptions {
  public:
    /// Declares the options of the command.
    void add_to(CLI::App& command);
    /// Whether any of them was given.
    bool is_any() const;
    /// Prints what the models say of the machine.
    /// @return whether its layer is known
    /// @throws core::InputError when an option is wrong or missing
    bool predict(PredictionFormat format);

  private:
    learn::ExistingMachine machine() const;
    void tell_unusual(learn::ExistingMachine const& machine) const;

    QuantityOptions quantities_;
    MaterialOptions material_;
    Text rpm_;
};

}  // namespace vibrotrough::app
