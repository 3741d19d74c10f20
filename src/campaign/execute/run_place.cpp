#include "campaign/execute/run_place.hpp"

#include "campaign/state/checkpoint.hpp"
#include "campaign/state/run_files.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "core/time.hpp"
#include "engine/sole_writer.hpp"
#include "scenario/model/run_settings.hpp"

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <vector>

#include <fmt/format.h>

namespace vibrotrough::campaign {
namespace {

namespace fs = std::filesystem;

constexpr char const* purpose = "vibrotrough-scratch";

[[noreturn]] void refuse(std::string const& scratch, std::string const& reason) {
    throw core::MissingError(
        fmt::format("run.scratch = \"{}\": {}; name a folder that every machine has on which packings are "
                    "simulated, or leave the key out",
                    core::harmless(scratch), reason));
}

/// Of the lock each folder has its own, and a file that is being written is not there yet.
bool is_copied(fs::path const& name) {
    return name.filename() != engine::writer_file && name.native().find(".part-") == std::string::npos;
}

/// The regular files in a folder and its folders, by their names below it. No link is followed.
std::vector<fs::path> files_below(fs::path const& folder) {
    std::vector<fs::path> names;
    for (auto const& entry : fs::recursive_directory_iterator(folder)) {
        fs::path const name = entry.path().lexically_relative(folder);
        if (entry.symlink_status().type() == fs::file_type::regular && is_copied(name)) names.push_back(name);
    }
    return names;
}

/// Whether a run removes files of this name itself: checkpoints, and snapshots and frames that were written
/// after the one from which it goes on.
bool may_go(fs::path const& name) {
    std::string const last = name.filename().string();
    if (name.has_parent_path()) return is_frame_file(last);
    return is_run_file(last) &&
           (last.starts_with("checkpoint.") || last.starts_with("profiles.") || last.starts_with("surface."));
}

}  // namespace

fs::path scratch_here(std::string const& scratch) {
    if (!scenario::is_scratch(scratch)) refuse(scratch, "this is not a folder");
    fs::path folder = scratch;
    if (scratch.front() == '$') {
        std::string const name = scratch.substr(1, scratch.find('/') - 1);
        char const* value = std::getenv(name.c_str());
        if (value == nullptr && name == "TMPDIR") value = "/tmp";
        if (value == nullptr) refuse(scratch, fmt::format("{} is not set on {}", name, core::host_name()));
        folder = value + scratch.substr(name.size() + 1);
    }
    std::error_code failure;
    if (!folder.is_absolute() || !fs::is_directory(folder, failure))
        refuse(scratch, fmt::format("there is no folder {} on {}", core::harmless(folder.string()),
                                    core::host_name()));
    return folder;
}

RunPlace::RunPlace(fs::path home, std::string const& scratch) : home_(std::move(home)) {
    if (scratch.empty()) return;
    fs::path const parent = scratch_here(scratch);
    try {
        scratch_.emplace(purpose, parent);
    } catch (core::MissingError const& error) {
        refuse(scratch, error.what());
    }
    own_.emplace(scratch_->path());
    for (auto const& entry : fs::directory_iterator(home_)) {
        fs::file_type const kind = entry.symlink_status().type();
        fs::path const name = entry.path().filename();
        if (kind == fs::file_type::directory) core::make_folder(folder() / name);
        if (kind == fs::file_type::regular && is_copied(name)) take(name);
    }
    // To which the engine appends; it does not read the frames.
    fs::path const frames = fs::path("dump") / "frames.csv";
    std::error_code missing;
    if (fs::is_regular_file(fs::symlink_status(home_ / frames, missing))) take(frames);
}

void RunPlace::take(fs::path const& name) {
    fs::path const to = folder() / name;
    core::replace_file(to, core::read_own_file(home_ / name));
    known_[name] = {fs::file_size(to), fs::last_write_time(to)};
    if (!may_go(name)) needed_.insert(name);
}

void RunPlace::bring_back() {
    if (!scratch_) return;
    std::map<fs::path, Stamp> now;
    std::vector<fs::path> changed;
    try {
        for (fs::path const& name : files_below(folder())) {
            Stamp const stamp{fs::file_size(folder() / name), fs::last_write_time(folder() / name)};
            auto const before = known_.find(name);
            if (before == known_.end() || before->second != stamp) changed.push_back(name);
            now.emplace(name, stamp);
        }
    } catch (fs::filesystem_error const& error) {
        throw core::MissingError(
            fmt::format("{} was removed while an engine worked in it ({}); nothing is recorded as a failure; "
                        "call the same command again",
                        folder().string(), error.code().message()));
    }
    for (fs::path const& name : needed_) {
        if (now.contains(name)) continue;
        throw core::MissingError(fmt::format(
            "{} was removed from {} while an engine worked there, as by a purge of old files; nothing is "
            "recorded as a failure; call the same command again",
            name.string(), folder().string()));
    }
    auto const is_seal = [](fs::path const& name) { return name == checkpoint_seal; };
    std::stable_partition(changed.begin(), changed.end(), std::not_fn(is_seal));
    for (fs::path const& name : changed) {
        if (name.has_parent_path()) core::make_folder((home_ / name).parent_path());
        core::write_file_atomically(home_ / name, core::read_own_file(folder() / name));
    }
    for (auto const& [name, stamp] : known_) {
        if (!now.contains(name) && may_go(name)) core::remove_file(home_ / name);
    }
    known_ = std::move(now);
}

}  // namespace vibrotrough::campaign
