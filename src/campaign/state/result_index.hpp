#pragma once

#include "campaign/state/plan.hpp"
#include "store/case_record.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace vibrotrough::campaign {

/// The summaries of a campaign's results, so that thousands need not be read whole at every look. A cache
/// beside the results, DIR/.index: an entry counts only while size, time and inode of its result.h5 are what
/// they were when that file was read whole or written. A file that is damaged or of another version of the
/// program is made anew. It may be deleted at any time.
class ResultIndex {
  public:
    explicit ResultIndex(Plan const& plan);

    /// The case's summary (store::summary_of) if its result.h5 is there and whole.
    std::optional<store::CaseRecord> find(PlannedCase const& planned);

    /// Takes in the result that this process has just put in its place.
    void remember(PlannedCase const& planned, store::CaseRecord const& record);

    /// Whether results were read that the file did not know.
    bool has_changed() const { return changed_; }

    /// Writes the file when it has changed. A folder that may only be read keeps its old one.
    void save();

  private:
    struct Stamp {
        std::int64_t size, time, inode;
        auto operator<=>(Stamp const&) const = default;
    };
    struct Entry {
        Stamp stamp;
        std::vector<std::uint8_t> summary;  ///< store::pack_summary
    };
    static std::optional<Stamp> stamp_of(std::filesystem::path const& file);
    void load();

    std::filesystem::path file_;
    std::map<std::string, Entry> entries_;
    bool changed_ = false;
};

}  // namespace vibrotrough::campaign
