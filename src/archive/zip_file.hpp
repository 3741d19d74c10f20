#pragma once

#include <filesystem>
#include <functional>
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

/// Receives the pieces of one file of a ZIP file in their order.
using ZipSink = std::function<void(std::string_view piece)>;

/// Reads the files of a ZIP file from its beginning to its end; never more than a piece of one is in memory.
/// @param path   of the ZIP file
/// @param file   is called with the name of each file, and returns what receives its content
/// @param done   is called when the content is complete
/// @throws core::InputError when it is damaged, holds an entry that is neither a file nor
/// a folder, or one whose name could lead out of the folder that it is unpacked to
/// @throws core::MissingError when it cannot be opened
void read_zip(std::filesystem::path const& path, std::function<ZipSink(std::string const& name)> const& file,
              std::function<void()> const& done);

/// The name of the first file in a ZIP file; empty when it is no ZIP file.
std::string first_name_in_zip(std::filesystem::path const& path);

/// Whether a name may be that of a file below a folder: a relative path of at most 1000 bytes in UTF-8, with
/// '/' between its parts, none of which is empty, "." or "..", and without control characters, backslashes
/// and colons.
bool is_safe_name(std::string_view name);

}  // namespace vibrotrough::archive
