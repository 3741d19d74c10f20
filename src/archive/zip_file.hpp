#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace vibrotrough::archive {

/// Writes a ZIP file under a temporary name and gives it its name when it is complete. The same files in the
/// same order make the same bytes: no entry has a time, an owner or permissions of this machine.
class ZipWriter {
  public:
    /// @param path  of the ZIP file; an entry of this name is replaced when the file is complete
    /// @throws core::MissingError when it cannot be written
    explicit ZipWriter(std::filesystem::path const& path);
    /// Removes what was written, unless finish() was called.
    ~ZipWriter();
    ZipWriter(ZipWriter const&) = delete;
    ZipWriter& operator=(ZipWriter const&) = delete;

    /// Adds a file. @param name  its path in the ZIP file. @throws core::MissingError when the disk refuses
    void add(std::string const& name, std::string_view content);
    /// Syncs the file to disk and gives it its name. @throws core::MissingError when the disk refuses
    void finish();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace vibrotrough::archive
