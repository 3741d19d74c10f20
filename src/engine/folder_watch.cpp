#include "engine/folder_watch.hpp"

#include "core/error.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

namespace vibrotrough::engine {
namespace {

std::optional<std::pair<unsigned long, unsigned long>> identity_of(std::filesystem::path const& folder) {
    struct stat status {};
    if (::stat(folder.c_str(), &status) != 0) return {};
    return std::pair(static_cast<unsigned long>(status.st_dev), static_cast<unsigned long>(status.st_ino));
}

}  // namespace

FolderWatch::FolderWatch(std::filesystem::path folder)
    : folder_(std::move(folder)), identity_(identity_of(folder_)) {}

void FolderWatch::check() const {
    if (!identity_ || identity_of(folder_) == identity_) return;
    throw core::MissingError(fmt::format(
        "{} was renamed, moved or removed while a packing in it was simulated, which was stopped; "
        "nothing is recorded as a failure; give the folder its name again, or name the new one with "
        "--output, and call the same command again",
        folder_.string()));
}

}  // namespace vibrotrough::engine
