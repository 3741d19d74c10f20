#include "engine/binary_watch.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

namespace vibrotrough::engine {
namespace {

long long nanoseconds(timespec const& time) {
    return time.tv_sec * 1'000'000'000LL + time.tv_nsec;
}

}  // namespace

BinaryWatch::BinaryWatch(EngineIdentity const& identity) {
    // Without a stamp: the files are read once more, in case one was replaced after its digest was taken.
    files_.push_back({identity.program, identity.program_sha256, {}});
    if (!identity.library.empty()) files_.push_back({identity.library, identity.library_sha256, {}});
    check();
}

BinaryWatch::Stamp BinaryWatch::stamp_of(std::filesystem::path const& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) {
        throw core::MissingError(fmt::format(
            "the engine {} is gone; put it back, or name another with --liggghts PATH", path.string()));
    }
    return {static_cast<long long>(status.st_dev), static_cast<long long>(status.st_ino),
            static_cast<long long>(status.st_size), nanoseconds(status.st_mtim), nanoseconds(status.st_ctim)};
}

void BinaryWatch::check() const {
    for (File& file : files_) {
        Stamp const stamp = stamp_of(file.path);
        if (stamp == file.stamp) continue;
        if (core::sha256_hex(core::read_file(file.path)) != file.sha256) {
            throw core::MissingError(fmt::format(
                "the engine's file {} was replaced after this run had begun; what it has computed since is "
                "not "
                "used. Run the same command again, which tests the new engine, or put the old file back",
                file.path.string()));
        }
        file.stamp = stamp;
    }
}

}  // namespace vibrotrough::engine
