#include "campaign/packing_outputs.hpp"

#include "core/hash.hpp"

#include <algorithm>

namespace vibrotrough::campaign {
namespace {

namespace fs = std::filesystem;

core::TextFile read_if_there(fs::path const& path) {
    std::error_code missing;
    return fs::is_regular_file(path, missing) ? core::read_text_file(path) : core::TextFile{path, {}};
}

}  // namespace

PackingOutputs read_outputs(fs::path const& folder) {
    PackingOutputs outputs{
        folder, read_if_there(folder / "cycles.csv"), read_if_there(folder / "phases.csv"), {}};
    std::error_code missing;
    for (auto const& entry : fs::directory_iterator(folder, missing)) {
        std::string const name = entry.path().filename().string();
        if (name.starts_with("profiles.") || name.starts_with("surface."))
            outputs.snapshots.push_back(core::read_text_file(entry.path()));
    }
    std::ranges::sort(outputs.snapshots, {}, &core::TextFile::path);
    return outputs;
}

std::string PackingOutputs::digest_of_cycles() const {
    return cycles.content.empty() ? std::string() : core::sha256_hex(cycles.content);
}

std::string PackingOutputs::digest_of_layer() const {
    std::vector<std::string> names;
    for (core::TextFile const& file : snapshots) names.push_back(file.path.filename().string());
    std::vector<std::string_view> pieces{phases.content};
    for (std::size_t i = 0; i < snapshots.size() && !phases.content.empty(); ++i) {
        pieces.emplace_back(names[i]);
        pieces.emplace_back(snapshots[i].content);
    }
    return core::sha256_hex(pieces);
}

}  // namespace vibrotrough::campaign
