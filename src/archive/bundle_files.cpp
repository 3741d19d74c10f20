#include "archive/bundle_files.hpp"

#include "campaign/state/case_state.hpp"
#include "campaign/state/observables.hpp"
#include "deck/deck.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

namespace vibrotrough::archive {
namespace {

namespace fs = std::filesystem;

/// Collects files below a campaign's folder.
class Collection {
  public:
    explicit Collection(fs::path folder) : folder_(std::move(folder)) {}

    /// Adds a file if there is one.
    void add(std::string const& name) {
        std::error_code missing;
        if (!fs::exists(folder_ / name, missing) || fs::is_directory(folder_ / name, missing)) return;
        files_.push_back(name);
    }

    /// Adds all files below a folder but hidden ones. Links to folders are not followed.
    void add_all(std::string const& name) {
        std::error_code missing;
        std::vector<std::string> found;
        for (auto entry = fs::recursive_directory_iterator(folder_ / name, missing);
             !missing && entry != fs::recursive_directory_iterator(); entry.increment(missing)) {
            bool const is_hidden = entry->path().filename().string().starts_with('.');
            if (is_hidden) {
                entry.disable_recursion_pending();
            } else {
                found.push_back(entry->path().lexically_relative(folder_).generic_string());
            }
        }
        std::ranges::sort(found);
        for (std::string const& file : found) add(file);
    }

    std::vector<std::string> take() { return std::move(files_); }

  private:
    fs::path folder_;
    std::vector<std::string> files_;
};

/// The names of the files that the cases and the campaign file name; they are frozen in the campaign's
/// folder.
std::set<std::string> frozen_names(campaign::Plan const& plan) {
    std::set<std::string> names;
    for (fs::path const& file : plan.files) names.insert(file.filename().string());
    for (campaign::PlannedCase const& planned : plan.cases) {
        for (scenario::NamedFile const& file : named_files(planned.scenario())) names.insert(file.name);
    }
    return names;
}

}  // namespace

std::vector<std::string> files_of_campaign(campaign::Plan const& plan) {
    Collection collection(plan.folder);
    for (char const* name : {"campaign.toml", "engine.json", "certificate.json", "friction.json",
                             "numerics.json", campaign::observables_file})
        collection.add(name);
    for (std::string const& name : frozen_names(plan)) collection.add(name);
    collection.add_all("added");
    if (campaign::campaign_file_state(plan) == campaign::CampaignFileState::up_to_date)
        collection.add("campaign.h5");
    collection.add_all("report");
    return collection.take();
}

std::vector<std::string> files_of_case(campaign::Plan const& plan, campaign::PlannedCase const& planned) {
    Collection collection(plan.folder);
    std::string const folder = "cases/" + planned.id + "/";
    for (char const* name : {"scenario.toml", "result.h5", "failure.json"}) collection.add(folder + name);
    for (scenario::NamedFile const& file : named_files(planned.scenario()))
        collection.add(folder + file.name);
    // The decks of all packings consist of files of the same names.
    auto const deck = deck::make_deck(*planned.prepared, {1}).files;
    for (int const packing : started_packings(planned)) {
        for (auto const& [name, content] : deck)
            collection.add(fmt::format("{}packing-{}/{}", folder, packing, name));
    }
    return collection.take();
}

}  // namespace vibrotrough::archive
