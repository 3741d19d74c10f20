#pragma once

#include "campaign/state/overview.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace vibrotrough::archive {

/// The first file of every bundle: what it is, and the versions of all that took part.
constexpr char const* facts_file = "archive.json";
/// The last file of every bundle: the SHA-256 of all others, as sha256sum writes and checks them.
constexpr char const* checksums_file = "SHA256SUMS";

/// What the user says of a bundle.
struct BundleWords {
    std::vector<std::string> authors;  ///< names of persons
    std::string license;               ///< address of a licence's text; empty: none is named
    bool partial = false;              ///< whether cases without a result may be left out
};

/// What went into a bundle.
struct BundleReport {
    std::size_t files = 0;    ///< all of them
    std::size_t results = 0;  ///< cases that have one
    std::uint64_t bytes = 0;  ///< of the bundle
    /// Of campaign.h5, which the bundle holds if it is up to date.
    campaign::CampaignFileState campaign_file = campaign::CampaignFileState::missing;
    bool has_report = false;  ///< whether figures or a report are there
    std::string left_aside =
        {};  ///< what of the campaign's folder is not in it (campaign::describe_left_aside)
};

/// Writes a campaign as one ZIP file for the supplement of a paper: the frozen campaign, the decks of the
/// packings, results, certificate, tables, figures and report where there are any, versions, checksums, and
/// metadata by RO-Crate 1.1. The same campaign makes the same bytes.
/// @param activity  what the executors know of the campaign
/// @param output    the file; a bundle of this name is replaced, and no other file
/// @throws core::InputError when packings are still simulated, when a result is damaged (each is
/// read whole), when a case has no result and `words` do not allow it, or when there is another file of this
/// name
/// @throws core::MissingError when a file cannot be read (it may be a symbolic link) or the disk refuses
BundleReport write_bundle(campaign::Plan const& plan, campaign::Activity const& activity,
                          std::filesystem::path const& output, BundleWords const& words);

}  // namespace vibrotrough::archive
