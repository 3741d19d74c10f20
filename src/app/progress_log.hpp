#pragma once

#include "campaign/execute/campaign_driver.hpp"

#include <filesystem>
#include <memory>
#include <string>

namespace vibrotrough::app {

/// Prints progress as JSON on standard error, one object per line. Its member "event" is "progress" (at most
/// once a second, and once more when all cases have ended), "case_ended" or "noticed".
class JsonProgress : public campaign::Observer {
  public:
    /// Prints the progress, at most once a second but in any case when nothing is left to do.
    void progressed(campaign::Progress const& progress) override;
    /// Prints that a case has ended.
    void case_ended(campaign::PlannedCase const& planned, core::Outcome outcome,
                    std::string const& message) override;
    /// Prints it.
    void noticed(campaign::PlannedCase const& planned, std::string const& message) override;

  private:
    double shown_ = -1;  ///< s, elapsed time of the latest progress line; negative before the first
};

/// Prints nothing.
class NoProgress : public campaign::Observer {
  public:
    /// Does nothing.
    void progressed(campaign::Progress const&) override {}
    /// Does nothing.
    void case_ended(campaign::PlannedCase const&, core::Outcome, std::string const&) override {}
};

/// The log file of a campaign, DIR/campaign.log. Every run adds one line per event with its time in UTC. When
/// the disk is full, the log ends but the campaign continues.
class CampaignLog {
  public:
    /// The log file in the folder of a campaign.
    explicit CampaignLog(std::filesystem::path const& folder) : file_(folder / "campaign.log") {}
    /// Adds a line of level info.
    void info(std::string const& line) const;
    /// Adds a line of level warning.
    void warn(std::string const& line) const;

  private:
    void add(char const* level, std::string const& line) const;

    std::filesystem::path file_;
};

/// Writes the events of a run to the log and passes them on to another observer.
class LoggingObserver : public campaign::Observer {
  public:
    /// @param next    the other observer; it must live longer than this one
    /// @param folder  of the campaign. The log is opened at the first event, when this process has locked the
    ///                folder.
    LoggingObserver(campaign::Observer& next, std::filesystem::path folder);
    /// Passes the progress on.
    void progressed(campaign::Progress const& progress) override;
    /// Writes that a case has ended to the log, and passes it on.
    void case_ended(campaign::PlannedCase const& planned, core::Outcome outcome,
                    std::string const& message) override;
    /// Writes it to the log, and passes it on.
    void noticed(campaign::PlannedCase const& planned, std::string const& message) override;
    /// Writes that the run stops to the log, and passes it on.
    void stopping() override;

  private:
    CampaignLog const& log();  ///< begins the log

    campaign::Observer& next_;
    std::filesystem::path folder_;
    std::unique_ptr<CampaignLog> log_;
};

}  // namespace vibrotrough::app
