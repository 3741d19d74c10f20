#include "campaign/state/run_files.hpp"

#include "core/own_folder.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace vibrotrough::campaign {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view digits = "0123456789";

/// Whether a name is `start`, a number, `end`.
bool is_numbered(std::string_view name, std::string_view start, std::string_view end) {
    if (name.size() <= start.size() + end.size() || !name.starts_with(start) || !name.ends_with(end))
        return false;
    name.remove_prefix(start.size());
    name.remove_suffix(end.size());
    return name.find_first_not_of(digits) == std::string_view::npos;
}

/// Files of the decks, of the engine, and of the program, in this order.
constexpr std::array<std::string_view, 19> names{
    "settle.liggghts", "in.liggghts",     "control.in",      "trough.stl",  "plate.stl",
    "left.stl",        "right.stl",       "back.stl",        "end.stl",     "cycles.csv",
    "phases.csv",      "checkpoints.txt", "settled.restart", "engine.out",  "log.liggghts",
    ".engine",         "packing.json",    "checkpoint.json", "settled.json"};

/// The names in a folder, none when there is no folder.
std::vector<std::string> entries_of(fs::path const& folder) {
    std::vector<std::string> found;
    std::error_code missing;
    if (core::is_link(folder)) return found;
    for (auto const& entry : fs::directory_iterator(folder, missing))
        found.push_back(entry.path().filename().string());
    std::ranges::sort(found);
    return found;
}

/// Removes a file or a link. A folder of that name is not the program's.
void remove_unless_folder(fs::path const& path) {
    std::error_code missing;
    if (fs::symlink_status(path, missing).type() != fs::file_type::directory) core::remove_file(path);
}

}  // namespace

bool is_run_file(std::string_view name) {
    // A file that is being written, or that a killed process left.
    if (auto const part = name.find(".part-"); part != std::string_view::npos && part > 0) {
        std::string_view const rest = name.substr(part);
        bool const is_of_process = rest.find_last_not_of(digits) + 1 < rest.size();
        return is_of_process && is_run_file(name.substr(0, part));
    }
    return std::ranges::find(names, name) != names.end() || is_numbered(name, "checkpoint.", ".restart") ||
           is_numbered(name, "profiles.", ".txt") || is_numbered(name, "surface.", ".txt") ||
           is_numbered(name, "along.", ".txt") || is_numbered(name, "left.", ".dump") ||
           is_numbered(name, "passed.", ".dump") || is_numbered(name, "part.", ".stl");
}

bool is_frame_file(std::string_view name) {
    return name == "frames.csv" || is_numbered(name, "frames.", ".dump") ||
           is_numbered(name, "contacts.", ".dump") || is_numbered(name, "trough_contacts.", ".dump");
}

void remove_run_files(fs::path const& folder) {
    for (std::string const& name : entries_of(folder)) {
        if (is_run_file(name)) remove_unless_folder(folder / name);
    }
    fs::path const dump = folder / "dump";
    if (core::is_link(dump)) return core::remove_file(dump);
    for (std::string const& name : entries_of(dump)) {
        if (is_frame_file(name)) remove_unless_folder(dump / name);
    }
    core::remove_if_empty(dump);
}

void replace_run(fs::path const& made, fs::path const& place, std::string_view last) {
    if (core::is_link(place)) core::remove_file(place);
    remove_run_files(place);
    core::remove_if_empty(place);
    std::error_code missing;
    if (!fs::exists(fs::symlink_status(place, missing))) return core::rename_entry(made, place);
    for (std::string const& name : entries_of(made)) {
        if (name != last) core::rename_entry(made / name, place / name);
    }
    if (fs::exists(made / last, missing)) core::rename_entry(made / last, place / last);
    core::remove_tree(made);
}

}  // namespace vibrotrough::campaign
