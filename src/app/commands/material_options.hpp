#pragma once

#include "app/commands/option_table.hpp"
#include "learn/plant.hpp"

#include <optional>
#include <string>

namespace vibrotrough::app {

/// The text of a table of input_templates/plant, such as "motors.csv".
std::string_view plant_table(std::string_view name);

/// The options that name a material, or a kind of grains, in place of numbers.
class MaterialOptions {
  public:
    /// Declares the options of a command.
    void add_to(CLI::App& command, std::string const& group);
    /// Whether any was given.
    bool is_any() const { return material_ || kind_; }
    /// Puts the ranges of a named material in place of the options that were not given, and one diameter in
    /// place of a range of sizes.
    /// @throws core::InputError when the name is unknown, and for grains that no model here knows
    void fill_in(QuantityOptions& quantities, bool is_friction_known = false);

    /// Why no model knows the grains, so that an answer has no probability; nothing where one does.
    std::optional<std::string> const& why_unknown() const { return why_unknown_; }
    /// "maize (EN 1991-4; size typical)"; empty without --material.
    std::string const& told() const { return told_; }
    /// m, the sizes of a mix of grains.
    std::optional<theory::Range> const& sizes() const { return sizes_; }

  private:
    std::string fill_in_material(QuantityOptions& quantities, bool is_friction_known);
    void read_size(QuantityOptions& quantities, std::string& kind);

    Text material_, kind_;
    std::optional<std::string> why_unknown_;
    std::string told_;
    std::optional<theory::Range> sizes_;
};

}  // namespace vibrotrough::app
