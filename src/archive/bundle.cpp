#include "archive/bundle.hpp"

#include "archive/bundle_files.hpp"
#include "archive/crate.hpp"
#include "archive/zip_file.hpp"
#include "campaign/state/campaign_folder.hpp"
#include "campaign/state/left_aside.hpp"
#include "campaign/state/result_summary.hpp"
#include "compare/compared_cases.hpp"
#include "compare/exports.hpp"
#include "compare/table.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/version.hpp"

#include <algorithm>
#include <fstream>
#include <map>
#include <mutex>
#include <tuple>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::archive {
namespace {

namespace fs = std::filesystem;

using Json = nlohmann::ordered_json;

constexpr char const* readme =
    R"(A campaign of Vibrotrough: simulations with LIGGGHTS (DEM) of a granular layer on a vibrating trough, compared
with the point-mass theory of vibratory conveying.

  archive.json             versions of the programs that took part
  campaign.toml            the input, and the files that it names beside it
  certificate.json         what the probes of the engine showed
  cases/<id>/              scenario.toml (the input of one case), result.h5 (its result with all cycles),
                           packing-<n>/ (the decks that LIGGGHTS ran: settle.liggghts, then in.liggghts)
  campaign.h5              all cases in one table, with units
  observables.json         own quantities with the functions that measured them, where there are any
  tables/                  measured conveying beside the theory: compare.csv, compare.json, compare.txt
  report/                  figures and report, where they were made
  ro-crate-metadata.json   a description for machines (https://w3id.org/ro/crate/1.1)
  SHA256SUMS               checksums: sha256sum -c SHA256SUMS

The files of the folder from which this bundle was made can be read with HDF5's tools and any text editor.
Unpacked, it is a campaign's folder: 'vibrotrough compare FOLDER' prints the table from the results.
)";

/// Writes the files of a bundle and keeps their list.
class Bundle {
  public:
    explicit Bundle(fs::path const& output) : zip_(output) {}

    void add(std::string const& name, std::string_view content) {
        zip_.add(name, content);
        files_.push_back({name, core::sha256_hex(content), content.size()});
    }
    void add_files(fs::path const& folder, std::vector<std::string> const& names) {
        for (std::string const& name : names) add(name, core::read_file(folder / name));
    }
    std::vector<ListedFile> const& files() const { return files_; }
    bool has(std::string_view start) const {
        return std::ranges::any_of(files_, [&](auto const& one) { return one.name.starts_with(start); });
    }
    /// Adds the checksums of all files and gives the bundle its name.
    void finish() {
        std::string sums;
        for (ListedFile const& file : files_) sums += file.sha256 + "  " + file.name + "\n";
        zip_.add(checksums_file, sums);
        zip_.finish();
    }

  private:
    ZipWriter zip_;
    std::vector<ListedFile> files_;
};

void refuse_unfinished_work(campaign::Plan const& plan, campaign::Activity const& activity) {
    bool const is_alive = std::ranges::any_of(
        activity.packings, [](auto const& one) { return one.state != campaign::PackingActivity::ended; });
    if (!activity.has_driver && !is_alive) return;
    throw core::InputError(fmt::format(
        "packings of {} are being simulated or wait for it; archive it when 'vibrotrough run' has ended",
        plan.folder.string()));
}

[[noreturn]] void throw_damaged(fs::path const& result) {
    throw core::InputError(fmt::format(
        "{} is damaged; delete it and run the campaign again, which makes it anew", result.string()));
}

void refuse_damaged_results(std::vector<campaign::CaseOverview> const& cases) {
    for (campaign::CaseOverview const& one : cases) {
        std::error_code missing;
        if (one.result || !fs::exists(one.planned->result_file(), missing)) continue;
        throw_damaged(one.planned->result_file());
    }
}

/// A bundle is published, and nobody counts its cases: that some have no result is for the person to say.
void refuse_to_leave_out(std::vector<campaign::CaseOverview> const& cases) {
    auto const has_no_result = [](campaign::CaseOverview const& one) { return !one.result; };
    auto const left_out = std::ranges::count_if(cases, has_no_result);
    if (left_out == 0) return;
    campaign::CaseOverview const& first = *std::ranges::find_if(cases, has_no_result);
    throw core::InputError(fmt::format(
        "{} of {} cases {} no result ({}{}: {}); simulate them with 'vibrotrough run', or "
        "archive the others with --partial",
        left_out, cases.size(), left_out == 1 ? "has" : "have", left_out == 1 ? "" : "the first is ",
        first.planned->id, first.fault.empty() ? first.label() : first.fault));
}

void refuse_to_replace(fs::path const& output) {
    // PKWARE's APPNOTE.TXT, 4.3.7: the name of the first file stands at byte 30.
    std::string head(30 + std::string_view(facts_file).size(), '\0');
    std::ifstream(output, std::ios::binary).read(head.data(), static_cast<std::streamsize>(head.size()));
    std::error_code missing;
    if (!fs::exists(output, missing) || (head.starts_with("PK\3\4") && head.ends_with(facts_file))) return;
    throw core::InputError(fmt::format(
        "{} is there already and is not a bundle; choose another file with --output", output.string()));
}

/// With what the results of a campaign were made, and when.
struct Making {
    /// Number of results by the versions of program, commit and engine.
    std::map<std::tuple<std::string, std::string, std::string>, int> versions = {};
    std::string begun = {}, ended = {};  ///< ISO 8601; empty without a result
    std::size_t results = 0;

    void add(store::Provenance const& made) {
        ++results;
        ++versions[{made.program_version, made.git_commit, made.engine_version}];
        if (begun.empty() || made.started < begun) begun = made.started;
        ended = std::max(ended, made.finished);
    }
};

/// archive.json.
std::string archive_facts(campaign::Plan const& plan, Making const& making) {
    Json by = Json::array();
    for (auto const& [version, count] : making.versions) {
        by.push_back({{"program_version", std::get<0>(version)},
                      {"git_commit", std::get<1>(version)},
                      {"engine_version", std::get<2>(version)},
                      {"cases", count}});
    }
    Json const facts{{"format", "vibrotrough archive"},
                     {"schema_version", 1},
                     {"campaign", plan.name},
                     {"archived_with",
                      {{"program_version", core::program_version()}, {"git_commit", core::program_commit()}}},
                     {"engine_version", plan.engine_version},
                     {"cases", plan.cases.size()},
                     {"results", making.results},
                     {"results_made_with", by}};
    return facts.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

CrateFacts crate_facts(campaign::Plan const& plan, std::vector<campaign::CaseOverview> const& cases,
                       Making const& making, BundleWords const& words) {
    CrateFacts facts;
    facts.begun = making.begun;
    facts.ended = making.ended;
    facts.campaign = plan.name;
    facts.authors = words.authors;
    facts.license = words.license;
    facts.program_version = core::program_version();
    facts.git_commit = core::program_commit();
    facts.engine_version = plan.engine_version;
    for (campaign::CaseOverview const& one : cases) {
        std::string const& label = one.planned->label;
        facts.cases.push_back({one.planned->id, label.empty() ? std::string(one.label())
                                                              : fmt::format("{}: {}", label, one.label())});
    }
    return facts;
}

}  // namespace

BundleReport write_bundle(campaign::Plan const& plan, campaign::Activity const& activity,
                          fs::path const& output, BundleWords const& words) {
    refuse_unfinished_work(plan, activity);
    refuse_to_replace(output);
    Making making;
    std::mutex mutex;
    std::vector<fs::path> rotten;
    auto const note = [&](std::size_t, campaign::CaseOverview const& one, store::CaseRecord const* record) {
        if (record == nullptr) return;
        bool const is_sound = campaign::is_summary_of_result(*one.planned, *record);
        std::lock_guard const lock(mutex);
        making.add(record->provenance);
        if (!is_sound) rotten.push_back(one.planned->result_file());
    };
    compare::ComparedCases const compared = compare::compared_cases(plan, activity, note);
    refuse_damaged_results(compared.cases);
    if (!rotten.empty()) throw_damaged(std::ranges::min(rotten));
    if (!words.partial) refuse_to_leave_out(compared.cases);

    Bundle bundle(output);
    bundle.add(facts_file, archive_facts(plan, making));
    bundle.add("README.txt", readme);
    bundle.add("tables/compare.csv", compare::to_csv(compared.rows, compared.columns));
    bundle.add("tables/compare.json", compare::to_json(compared.rows, compared.columns));
    bundle.add("tables/compare.txt", compare::to_table(compared.rows, {}, compared.columns));
    bundle.add_files(plan.folder, files_of_campaign(plan));
    for (campaign::PlannedCase const& planned : plan.cases)
        bundle.add_files(plan.folder, files_of_case(plan, planned));
    CrateFacts facts = crate_facts(plan, compared.cases, making, words);
    facts.files = bundle.files();
    bundle.add("ro-crate-metadata.json", crate_metadata(facts));
    bundle.finish();

    BundleReport report;
    report.left_aside = campaign::describe_left_aside(plan, compared.cases);
    report.results = making.results;
    report.files = bundle.files().size() + 1;
    report.bytes = fs::file_size(output);
    report.campaign_file = bundle.has("campaign.h5") ? campaign::CampaignFileState::up_to_date
                                                     : campaign::campaign_file_state(plan);
    report.has_report = bundle.has("report/");
    return report;
}

}  // namespace vibrotrough::archive
