#include "campaign/state/folder_lock.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

namespace vibrotrough::campaign {
namespace {

FileLock take_or_refuse(std::filesystem::path const& folder) {
    if (auto lock = FileLock::take(folder / ".lock")) return std::move(*lock);
    throw core::MissingError(
        fmt::format("another vibrotrough is running the campaign in {}; wait for it, or stop it with "
                    "Ctrl-C in its terminal",
                    folder.string()));
}

}  // namespace

FolderLock::FolderLock(std::filesystem::path const& folder) : lock_(take_or_refuse(folder)) {}

bool FolderLock::is_held(std::filesystem::path const& folder) {
    return FileLock::is_held(folder / ".lock");
}

}  // namespace vibrotrough::campaign
