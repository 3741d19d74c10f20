#pragma once

#include "campaign/execute/campaign_driver.hpp"

#include <filesystem>
#include <memory>
#include <string>

namespace spdlog {
class logger;
}

namespace vibrotrough::app {

/// Shows progress as JSON lines on standard error: an object per line, "event" says which:
/// progress (at most one a second), case_ended.
class JsonProgress : public campaign::Observer {
  public:
    void progressed(campaign::Progress const& progress) override;
    void case_ended(campaign::PlannedCase const& planned, core::Outcome outcome,
                    std::string const& message) override;

  private:
    double shown_ = -1;
};

/// Shows nothing.
class NoProgress : public campaign::Observer {
  public:
    void progressed(campaign::Progress const&) override {}
    void case_ended(campaign::PlannedCase const&, core::Outcome, std::string const&) override {}
};

/// The campaign's log file, DIR/campaign.log: a line with its time per event, added to at every run. A disk
/// that takes no more stops the log, not the campaign.
class CampaignLog {
  public:
    explicit CampaignLog(std::filesystem::path const& folder);
    void info(std::string const& line) const;
    void warn(std::string const& line) const;

  private:
    std::shared_ptr<spdlog::logger> logger_;  ///< none when the file cannot be opened
};

/// Writes to the log what it hands on to another observer.
class LoggingObserver : public campaign::Observer {
  public:
    /// @param folder  of the campaign; the log is opened with the first event, when the folder is this
    /// driver's
    LoggingObserver(campaign::Observer& next, std::filesystem::path folder);
    void progressed(campaign::Progress const& progress) override;
    void case_ended(campaign::PlannedCase const& planned, core::Outcome outcome,
                    std::string const& message) override;

  private:
    CampaignLog const& log();

    campaign::Observer& next_;
    std::filesystem::path folder_;
    std::unique_ptr<CampaignLog> log_;
};

}  // namespace vibrotrough::app
