#pragma once

#include "app/commands/option_table.hpp"
#include "learn/exciter.hpp"
#include "learn/plant.hpp"

#include <optional>

namespace vibrotrough::app {

/// The options of `vibrotrough design` that describe what moves the trough.
class ExciterOptions {
  public:
    /// Declares the options of the command.
    void add_to(CLI::App& command);
    /// The machine; nothing without --trough-mass.
    /// @throws core::InputError when an option is wrong, or one that needs the mass stands alone
    std::optional<learn::MovedMachine> machine() const;
    /// The text of --exciter.
    Text const& exciter() const { return exciter_; }
    /// The kind of drive that was asked for, or that unbalance motors are; nothing: any.
    std::optional<learn::DriveKind> drive() const;
    /// The kinds of drives that are usual.
    static std::vector<learn::DriveKind> const& drive_kinds();

  private:
    QuantityOptions quantities_;
    Text exciter_, motors_, drive_;
};

}  // namespace vibrotrough::app
