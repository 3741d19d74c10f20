#pragma once

#include "campaign/execute/campaign_driver.hpp"

#include <chrono>
#include <string>
#include <vector>

namespace vibrotrough::app {

/// Prints the progress of a campaign on standard error: one line per running packing and a line of totals. On
/// a terminal, these lines are updated in place. Elsewhere they are printed every ten seconds. Every case
/// that ends gets a line of its own.
class ProgressPrinter : public campaign::Observer {
  public:
    /// Finds out whether standard error is a terminal.
    ProgressPrinter();
    /// Removes the lines from the terminal.
    ~ProgressPrinter() override;

    /// Prints or updates the lines of progress.
    void progressed(campaign::Progress const& progress) override;
    /// Prints a line about a case that has ended.
    void case_ended(campaign::PlannedCase const& planned, core::Outcome outcome,
                    std::string const& message) override;
    /// Prints a line about it.
    void noticed(campaign::PlannedCase const& planned, std::string const& message) override;
    /// Says that the run stops, and how to stop it at once.
    void stopping() override;

  private:
    void clear_lines();

    bool terminal_;
    std::vector<std::string> lines_;
    std::chrono::steady_clock::time_point printed_;
};

/// A duration in s as minutes and seconds, "1:05", or with hours, "2:00:10".
std::string clock_time(double seconds);

}  // namespace vibrotrough::app
