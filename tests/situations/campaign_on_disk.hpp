#pragma once

#include "core/temporary_folder.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace vibrotrough::situations {

/// The velocity efficiency of each case, by id; none of a case without a result.
using Efficiencies = std::map<std::string, std::optional<double>>;

/// A small campaign as a run leaves it, made without an engine: two cases with results, one packing, and
/// every other file that commands read. Files are changed and put back.
class CampaignOnDisk {
  public:
    CampaignOnDisk();

    std::filesystem::path const& folder() const { return folder_; }   ///< of the campaign
    std::vector<std::string> const& files() const { return names_; }  ///< below the folder, sorted
    /// What a file of it held at the beginning.
    std::string const& content(std::string const& name) const { return contents_.at(name); }
    Efficiencies const& truth() const { return truth_; }  ///< of the unchanged campaign

    /// Replaces the bytes of a file. Its time and its inode stay, so that only the bytes tell.
    void rot(std::string const& name, std::string const& bytes) const;
    /// Removes whatever has the name of a file.
    void remove(std::string const& name) const;
    /// Puts back what was changed under these names.
    void restore(std::vector<std::string> const& names) const;

  private:
    core::TemporaryFolder own_;
    std::filesystem::path folder_ = own_.path() / "campaign";
    std::vector<std::string> names_;
    std::map<std::string, std::string> contents_;
    Efficiencies truth_;
};

/// What the commands that show a campaign make of the folder.
struct Answer {
    std::string fault;  ///< what they did that they must not do; empty when they held
};

/// How far a campaign is looked at.
enum class Depth {
    shown,      ///< as status and compare do
    published,  ///< and as report and archive do
};

/// Asks what the commands ask.
Answer ask(CampaignOnDisk const& campaign, Depth depth, std::filesystem::path const& scratch);

}  // namespace vibrotrough::situations
