#include "campaign/state/run_files.hpp"

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
constexpr std::array<std::string_view, 21> names{
    "settle.liggghts", "in.liggghts",     "control.in",      "trough.stl", "plate.stl",    "left.stl",
    "right.stl",       "back.stl",        "end.stl",         "cycles.csv", "phases.csv",   "rolling.csv",
    "impacts.csv",     "checkpoints.txt", "settled.restart", "engine.out", "log.liggghts", ".engine",
    "packing.json",    "checkpoint.json", "settled.json"};

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
           is_numbered(name, "passed.", ".dump") || is_numbered(name, "wear.", ".vtk") ||
           is_numbered(name, "grain_contacts.", ".dump") || is_numbered(name, "floor_contacts.", ".dump") ||
           is_numbered(name, "masses.", ".dump") || is_numbered(name, "part.", ".stl");
}

bool is_frame_file(std::string_view name) {
    return name == "frames.csv" || is_numbered(name, "frames.", ".dump") ||
           is_numbered(name, "contacts.", ".dump") || is_numbered(name, "trough_contacts.", ".dump");
}

}  // namespace vibrotrough::campaign
