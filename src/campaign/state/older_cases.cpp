#include "campaign/state/older_cases.hpp"

#include "campaign/state/campaign_folder.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "deck/commands.hpp"

#include <fmt/format.h>

namespace vibrotrough::campaign {
namespace {

namespace fs = std::filesystem;

using Files = std::map<std::string, std::string>;

constexpr char const* current_id_file = "current_id.txt";

/// The files of the first packing's deck that lie in its folder.
Files read_deck(fs::path const& packing_folder) {
    Files names;
    std::error_code missing;
    for (auto const& entry : fs::directory_iterator(packing_folder, missing)) {
        std::string const name = entry.path().filename().string();
        if (name == deck::drive_file || name == deck::settle_file || name == deck::control_file ||
            name.ends_with(".stl"))
            names[name] = {};
    }
    return deck::read_files(packing_folder, names);
}

/// The frozen scenario as the old program hashed it: under a name that all campaigns share.
std::string anonymous(std::string const& toml) {
    constexpr std::string_view start = "[campaign]\nname = \"";
    if (!toml.starts_with(start)) return toml;
    std::size_t const end = toml.find('"', start.size());
    return std::string(start) + "any" + (end == std::string::npos ? "" : toml.substr(end));
}

/// The same of the deck, whose first line ends in the campaign's name.
std::string anonymous_deck(std::string content) {
    constexpr std::string_view before = ", campaign ";
    std::size_t const end = content.find('\n');
    std::size_t const name = content.rfind(before, end);
    if (end == std::string::npos || name == std::string::npos) return content;
    return content.replace(name + before.size(), end - name - before.size(), "any");
}

std::string older_id(std::string const& toml, std::string const& engine_version, Files const& deck) {
    std::string all = anonymous(toml) + engine_version;
    for (auto const& [name, content] : deck)
        all += name + (name == deck::drive_file ? anonymous_deck(content) : content);
    return core::sha256_hex(all).substr(0, 12);
}

std::string identity(std::string const& commands, scenario::MeasurementPlan const& measure) {
    return fmt::format("{} {} {} {}", commands, measure.packings, measure.confidence, measure.half_width);
}

}  // namespace

OlderCases::OlderCases(fs::path const& campaign_folder, std::string const& engine_version,
                       std::set<std::string> const& new_ids)
    : folder_(campaign_folder / "cases"), engine_version_(engine_version), new_ids_(new_ids) {}

std::optional<std::string> OlderCases::find(std::string const& id, prepare::PreparedCase const& prepared) {
    std::error_code missing;
    if (fs::is_directory(folder_ / id, missing)) return {};
    if (!have_read_) read_folders();
    if (auto const known = ids_by_current_id_.find(id); known != ids_by_current_id_.end())
        return known->second;
    if (ids_by_identity_.empty()) return {};
    std::string const commands = deck::digest_of_commands(deck::make_deck(prepared, {1}).files);
    auto const found = ids_by_identity_.find(identity(commands, prepared.scenario.measure));
    return found == ids_by_identity_.end() ? std::nullopt : std::optional(found->second);
}

void OlderCases::read_folders() {
    have_read_ = true;
    std::error_code missing;
    for (auto const& entry : fs::directory_iterator(folder_, missing)) {
        std::string const name = entry.path().filename().string();
        if (!is_case_id(name) || new_ids_.contains(name)) continue;
        if (fs::is_regular_file(entry.path() / current_id_file, missing)) {
            std::string const current = core::read_file(entry.path() / current_id_file, core::largest_note);
            ids_by_current_id_[current.substr(0, current.find('\n'))] = name;
            continue;
        }
        if (!fs::is_regular_file(entry.path() / "packing-1" / deck::drive_file, missing)) continue;
        try {
            std::string const toml = core::read_file(entry.path() / "scenario.toml", core::largest_note);
            Files const deck = read_deck(entry.path() / "packing-1");
            if (older_id(toml, engine_version_, deck) != name) continue;
            auto const frozen = scenario::read_campaign(entry.path() / "scenario.toml");
            ids_by_identity_[identity(deck::digest_of_commands(deck), frozen.cases.front().measure)] = name;
        } catch (core::Error const&) {
            // Damaged: the case is run again under its new id.
        }
    }
}

void write_current_id(fs::path const& case_folder, std::string const& current_id) {
    core::write_file_atomically(case_folder / current_id_file, current_id + "\n");
}

std::string older_packing_key(Files const& settle_files, std::string const& engine_version) {
    std::string all = engine_version;
    for (auto const& [name, content] : settle_files) all += name + content;
    return core::sha256_hex(all).substr(0, 12);
}

}  // namespace vibrotrough::campaign
