#include "evaluate/packing_files.hpp"

#include "core/hash.hpp"
#include "core/note.hpp"
#include "measure/cycle_series.hpp"

#include <algorithm>

namespace vibrotrough::evaluate {
namespace {

namespace fs = std::filesystem;
namespace note = core::note;
using note::Json;

constexpr char const* marker_file = "packing.json";

core::TextFile read_if_there(fs::path const& path) {
    std::error_code missing;
    if (!fs::is_regular_file(path, missing)) return {path, {}};
    return path.filename() == "cycles.csv" ? measure::cycles_text(path) : core::read_text_file(path);
}

std::string digest_of_layer(PackingFiles const& files) {
    std::vector<std::string> names;
    for (core::TextFile const& file : files.snapshots) names.push_back(file.path.filename().string());
    std::vector<std::string_view> pieces{files.phases.content};
    for (std::size_t i = 0; i < files.snapshots.size(); ++i) {
        // An open trough and a screen have no phases.
        bool const stands_alone =
            std::ranges::any_of(std::initializer_list<std::string_view>{"along.", "left.", "passed."},
                                [&](std::string_view start) { return names[i].starts_with(start); });
        if (files.phases.content.empty() && !stands_alone) continue;
        pieces.emplace_back(names[i]);
        pieces.emplace_back(files.snapshots[i].content);
    }
    return core::sha256_hex(pieces);
}

}  // namespace

PackingFiles read_packing_files(fs::path const& folder) {
    PackingFiles files{
        folder, read_if_there(folder / "cycles.csv"), read_if_there(folder / "phases.csv"), {}, {}, {}};
    std::error_code missing;
    for (auto const& entry : fs::directory_iterator(folder, missing)) {
        std::string const name = entry.path().filename().string();
        bool const is_dump =
            (name.starts_with("left.") || name.starts_with("passed.")) && name.ends_with(".dump");
        if (is_dump || name.starts_with("profiles.") || name.starts_with("surface.") ||
            name.starts_with("along."))
            files.snapshots.push_back(core::read_text_file(entry.path()));
    }
    std::ranges::sort(files.snapshots, {}, &core::TextFile::path);
    if (!files.cycles.content.empty()) files.cycles_sha256 = core::sha256_hex(files.cycles.content);
    files.layer_sha256 = digest_of_layer(files);
    return files;
}

bool has_marker(fs::path const& packing_folder) {
    std::error_code missing;
    return fs::is_regular_file(packing_folder / marker_file, missing);
}

PackingMarker parse_marker(std::string_view text, PackingFiles const& files) {
    Json const json = note::parse(text);
    if (note::text(json, "cycles_sha256") != files.cycles_sha256 ||
        note::text(json, "layer_sha256") != files.layer_sha256)
        throw note::Fault("it belongs to other files");
    double const wall_time = note::number(json, "wall_time", 0);
    PackingMarker marker{wall_time,
                         note::text(json, "started"),
                         note::text(json, "finished"),
                         note::text(json, "program_version"),
                         note::text(json, "git_commit"),
                         note::text(json, "host"),
                         note::text_if_any(json, "engine_certificate"),
                         json.contains("core_time") ? note::number(json, "core_time", 0) : wall_time,
                         {},
                         note::text_if_any(json, "deck_sha256")};
    if (json.contains("start_efficiency")) marker.start_efficiency = note::number(json, "start_efficiency");
    return marker;
}

std::optional<PackingMarker> read_marker(PackingFiles const& files) {
    if (files.cycles_sha256.empty() || !has_marker(files.folder)) return {};
    try {
        return parse_marker(core::read_file(files.folder / marker_file, core::largest_note), files);
    } catch (note::Fault const&) {
        return {};
    }
}

std::optional<PackingMarker> read_marker(fs::path const& packing_folder) {
    if (!has_marker(packing_folder)) return {};
    return read_marker(read_packing_files(packing_folder));
}

std::string to_json(PackingFiles const& files, PackingMarker const& marker) {
    Json json{{"wall_time", marker.wall_time},
              {"core_time", marker.core_time},
              {"started", marker.started},
              {"finished", marker.finished},
              {"program_version", marker.program_version},
              {"git_commit", marker.git_commit},
              {"host", marker.host},
              {"engine_certificate", marker.engine_certificate},
              {"cycles_sha256", files.cycles_sha256},
              {"layer_sha256", files.layer_sha256}};
    if (!marker.deck_sha256.empty()) json["deck_sha256"] = marker.deck_sha256;
    if (marker.start_efficiency) json["start_efficiency"] = *marker.start_efficiency;
    return json.dump(2) + "\n";
}

void write_marker(PackingFiles const& files, PackingMarker const& marker) {
    core::write_file_atomically(files.folder / marker_file, to_json(files, marker));
}

void remove_marker(fs::path const& packing_folder) {
    fs::remove(packing_folder / marker_file);
}

}  // namespace vibrotrough::evaluate
