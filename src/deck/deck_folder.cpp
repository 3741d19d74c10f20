#include "deck/deck_folder.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::deck {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr char const* format_name = "vibrotrough deck";

[[noreturn]] void refuse(fs::path const& path, std::string const& what) {
    throw core::InputError(
        fmt::format("{} {}, and it would be replaced; move it away, or choose another folder with --output",
                    path.string(), what));
}

/// The digests of each file that were written here, {"path": ["...", ...]}; empty when nothing was.
Json read_written(fs::path const& folder) {
    fs::path const path = folder / written_file;
    if (!fs::exists(fs::symlink_status(path))) return Json::object();
    if (!core::is_link(path)) {
        Json const json = Json::parse(core::read_file(path, core::largest_note), nullptr, false);
        if (json.is_object() && json.value("format", Json()) == format_name &&
            json.value("files", Json()).is_object())
            return json["files"];
    }
    refuse(path, "is not a file of this program");
}

/// The digest of a file that may be replaced; empty when there is none, or when it has this content already.
std::string replaceable(fs::path const& path, std::string const& content, Json const& known) {
    if (!fs::exists(fs::symlink_status(path))) return {};
    if (core::is_link(path)) refuse(path, "is a symbolic link");
    std::string const before = core::read_file(path, core::largest_note);
    if (before == content) return {};
    std::string const digest = core::sha256_hex(before);
    if (known.is_array() && std::ranges::find(known, Json(digest)) != known.end()) return digest;
    refuse(path, "is not what 'vibrotrough deck' wrote there");
}

}  // namespace

void write_case(fs::path const& folder, std::map<std::string, std::string> const& files) {
    Json const written = read_written(folder);
    Json both = Json::object(), last = Json::object();
    for (auto const& [name, content] : files) {
        last[name] = both[name] = Json::array({core::sha256_hex(content)});
        std::string const before = replaceable(folder / name, content, written.value(name, Json::array()));
        if (!before.empty()) both[name].push_back(before);
    }
    core::make_folder(folder);
    auto const write_digests = [&](Json const& digests) {
        core::replace_file(folder / written_file,
                           Json{{"format", format_name}, {"files", digests}}.dump(2) + "\n");
    };
    // While the files are written, both the old and the new ones are known, so that after a crash none of
    // them seems to be a person's.
    write_digests(both);
    for (auto const& [name, content] : files) {
        core::make_folder((folder / name).parent_path());
        core::replace_file(folder / name, content);
    }
    if (both != last) write_digests(last);
}

bool is_as_written(fs::path const& folder, std::string const& name, std::string const& content) {
    std::error_code missing;
    fs::path const path = folder / written_file;
    if (!fs::is_regular_file(path, missing)) return false;
    Json const json = Json::parse(core::read_file(path, core::largest_note), nullptr, false);
    if (!json.is_object() || !json.value("files", Json()).is_object()) return false;
    Json const known = json["files"].value(name, Json());
    return known.is_array() && std::ranges::find(known, Json(core::sha256_hex(content))) != known.end();
}

void make_frame_folder(Deck const& deck, fs::path const& folder) {
    if (deck.files.at(drive_file).find(" dump/") != std::string::npos) core::make_folder(folder / "dump");
}

}  // namespace vibrotrough::deck
