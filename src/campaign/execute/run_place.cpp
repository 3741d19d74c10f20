#include "campaign/execute/run_place.hpp"

#include "campaign/state/checkpoint.hpp"
#include "campaign/state/file_lock.hpp"
#include "campaign/state/run_files.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/text.hpp"
#include "core/time.hpp"
#include "deck/deck.hpp"
#include "engine/sole_writer.hpp"
#include "scenario/model/run_settings.hpp"

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <vector>

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace vibrotrough::campaign {
namespace {

namespace fs = std::filesystem;

constexpr char const* purpose = "vibrotrough-scratch";

[[noreturn]] void refuse(std::string const& scratch, std::string const& reason) {
    throw core::MissingError(
        fmt::format("run.scratch = \"{}\": {}; name a folder that every machine has on which packings are "
                    "simulated and where you may write, or leave the key out",
                    scratch, reason));
}

/// Of the lock each folder has its own, and a file that is being written is not there yet.
bool is_copied(fs::path const& name) {
    return name.filename() != engine::writer_file && name.native().find(".part-") == std::string::npos;
}

/// Whether the engine may need the file: one of the program or the engine, or one that the deck names. Other
/// files in a packing's folder are a person's.
bool is_of_run(std::string const& name, std::string const& decks) {
    return is_copied(name) && (is_run_file(name) || decks.find(name) != std::string::npos);
}

std::string decks_in(fs::path const& folder) {
    std::string text;
    for (char const* const deck : {deck::settle_file, deck::drive_file}) {
        std::error_code missing;
        if (fs::is_regular_file(fs::symlink_status(folder / deck, missing)))
            text += core::read_file(folder / deck, core::largest_note);
    }
    return text;
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

/// Copies files, each whole, and the seal of a checkpoint last.
void copy_files(fs::path const& from, fs::path const& to, std::vector<fs::path> names) {
    auto const is_seal = [](fs::path const& name) { return name == checkpoint_seal; };
    std::stable_partition(names.begin(), names.end(), std::not_fn(is_seal));
    for (fs::path const& name : names) {
        if (name.has_parent_path()) core::make_folder((to / name).parent_path());
        core::write_file_atomically(to / name, core::read_file(from / name));
    }
}

/// What is kept below a scratch folder for a home. Its name must not be that of a temporary folder, which the
/// next process would remove.
fs::path kept_folder(fs::path const& scratch, fs::path const& name) {
    std::error_code failure;
    fs::path const whole = fs::weakly_canonical(name, failure);
    return scratch / fmt::format("vibrotrough-kept-{}", core::sha256_hex(whole.string()).substr(0, 12));
}

/// In a folder like /tmp anybody may take a name.
bool is_private_folder(fs::path const& path) {
    struct stat status {};
    return ::lstat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode) && status.st_uid == ::geteuid() &&
           (status.st_mode & 0077U) == 0;
}

std::string not_brought_back(fs::path const& kept, std::string const& reason) {
    return fmt::format(
        "{}; what the engine computed is kept in {} on {}: call the same command again on that machine, "
        "which "
        "brings it back",
        reason, kept.string(), core::host_name());
}

/// Whether a run removes files of this name itself: older checkpoints, and frames that were written after the
/// one from which it goes on.
bool may_go(fs::path const& name) {
    std::string const last = name.filename().string();
    if (name.has_parent_path()) return is_frame_file(last);
    return is_run_file(last) && last.starts_with("checkpoint.");
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
        refuse(scratch, fmt::format("there is no folder {} on {}", folder.string(), core::host_name()));
    return folder;
}

bool bring_back_kept(fs::path const& home, std::string const& scratch, fs::path const& name) {
    if (scratch.empty()) return false;
    fs::path const kept = kept_folder(scratch_here(scratch), name);
    if (!is_private_folder(kept)) return false;
    try {
        auto const lock = FileLock::take(kept / engine::writer_file);
        if (!lock) return false;
        core::make_folder(home);
        if (last_checkpoint(kept) >= last_checkpoint(home)) copy_files(kept, home, files_below(kept));
        fs::remove_all(kept);
        return true;
    } catch (core::MissingError const& error) {
        throw core::MissingError(fmt::format("what an earlier run has left in {} cannot be brought back ({})",
                                             kept.string(), error.what()));
    }
}

RunPlace::RunPlace(fs::path home, std::string const& scratch, fs::path name) : home_(std::move(home)) {
    if (scratch.empty()) return;
    fs::path const parent = scratch_here(scratch);
    kept_ = kept_folder(parent, name);
    try {
        scratch_.emplace(purpose, parent);
    } catch (core::MissingError const& error) {
        refuse(scratch, error.what());
    }
    std::string const decks = decks_in(home_);
    for (auto const& entry : fs::directory_iterator(home_)) {
        std::string const file = entry.path().filename().string();
        if (entry.symlink_status().type() == fs::file_type::regular && is_of_run(file, decks)) take(file);
    }
    fs::path const dump = "dump", frames = dump / "frames.csv";
    std::error_code missing;
    if (fs::is_directory(fs::symlink_status(home_ / dump, missing))) core::make_folder(folder() / dump);
    // To which the engine appends; it does not read the frames.
    if (fs::is_regular_file(fs::symlink_status(home_ / frames, missing))) take(frames);
}

RunPlace::~RunPlace() {
    if (is_behind_) scratch_->keep_as(kept_);
}

void RunPlace::take(fs::path const& name) {
    fs::path const to = folder() / name;
    core::replace_file(to, core::read_file(home_ / name));
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
    is_behind_ = true;
    try {
        copy_files(folder(), home_, std::move(changed));
        for (auto const& [name, stamp] : known_) {
            if (!now.contains(name) && may_go(name)) fs::remove(home_ / name);
        }
    } catch (core::DiskFullError const& error) {
        throw core::DiskFullError(not_brought_back(kept_, error.what()));
    } catch (core::MissingError const& error) {
        throw core::MissingError(not_brought_back(kept_, error.what()));
    }
    is_behind_ = false;
    known_ = std::move(now);
}

}  // namespace vibrotrough::campaign
