#pragma once

#include "campaign/execute/campaign_driver.hpp"

#include <chrono>
#include <string>
#include <vector>

namespace vibrotrough::app {

/// Shows a campaign's progress on standard error: a line per running packing and a total,
/// which renew themselves on a terminal, plain lines
/// (one per ended case, and one every ten seconds) elsewhere.
class ProgressPrinter : public campaign::Observer {
  public:
    ProgressPrinter();
    ~ProgressPrinter() override;

    void progressed(campaign::Progress const& progress) override;
    void case_ended(campaign::PlannedCase const& planned, core::Outcome outcome,
                    std::string const& message) override;

  private:
    void clear_lines();

    bool terminal_;
    std::vector<std::string> lines_;
    std::chrono::steady_clock::time_point printed_;
};

/// "1:05", "2:00:10".
std::string clock_time(double seconds);

}  // namespace vibrotrough::app
