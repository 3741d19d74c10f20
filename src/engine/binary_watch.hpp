#pragma once

#include "engine/certificate.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace vibrotrough::engine {

/// Notices when the files of an engine are replaced, for example by an upgrade in the night: what another
/// binary computes does not belong to the certificate and the version that a campaign was begun with.
class BinaryWatch {
  public:
    /// @param identity  of the binary that was certified; its files must be those that are there now
    explicit BinaryWatch(EngineIdentity const& identity);

    /// Looks at the files' inodes, sizes and times, and reads them only when one of these has changed.
    /// @throws MissingError when the program or its library is not what it was
    void check() const;

  private:
    /// What stat(2) says of a file while nobody changes it.
    struct Stamp {
        long long device, inode, size, modified, changed;
        bool operator==(Stamp const&) const = default;
    };
    struct File {
        std::filesystem::path path;
        std::string sha256;
        Stamp stamp;
    };

    static Stamp stamp_of(std::filesystem::path const& path);

    mutable std::vector<File> files_;
};

}  // namespace vibrotrough::engine
