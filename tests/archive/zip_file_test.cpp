#include "archive/zip_file.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/temporary_folder.hpp"

#include <filesystem>
#include <map>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vibrotrough::archive {
namespace {

using Files = std::map<std::string, std::string>;

void write(std::filesystem::path const& path, Files const& files) {
    ZipWriter zip(path);
    for (auto const& [name, content] : files) zip.add(name, content);
    zip.finish();
}

Files sample() {
    // Compressible, longer than a piece, empty, and bytes that deflate cannot shorten.
    Files files{{"a.txt", std::string(200'000, 'x')}, {"b/c/empty.csv", ""}, {"b/d.h5", ""}};
    unsigned state = 1;
    for (int i = 0; i < 100'000; ++i)
        files["b/d.h5"] += static_cast<char>((state = state * 1664525u + 1013904223u) >> 24);
    return files;
}

// The same files make the same bytes. (Python's zipfile reads them back in end_to_end.archive.)
TEST(ZipFile, IsReproducible) {
    core::TemporaryFolder const folder;
    write(folder.path() / "one.zip", sample());
    write(folder.path() / "two.zip", sample());
    EXPECT_EQ(core::read_file(folder.path() / "one.zip"), core::read_file(folder.path() / "two.zip"));
}

// A name in UTF-8 stays what it is, and is marked as UTF-8: bit 11 of the flags at byte 6 (PKWARE's
// APPNOTE.TXT, 4.4.4).
TEST(ZipFile, NamesAreUtf8) {
    core::TemporaryFolder const folder;
    Files const files{{"größe.txt", "1"}};
    write(folder.path() / "one.zip", files);
    EXPECT_EQ(core::read_file(folder.path() / "one.zip").at(7) & 8, 8);
}

// A ZIP file that is not finished leaves nothing, and what has its name stays.
TEST(ZipFile, AppearsWholeOrNotAtAll) {
    core::TemporaryFolder const folder;
    write(folder.path() / "one.zip", sample());
    std::string const before = core::read_file(folder.path() / "one.zip");
    { ZipWriter(folder.path() / "one.zip").add("half", "half"); }
    EXPECT_EQ(core::read_file(folder.path() / "one.zip"), before);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
    EXPECT_THROW(ZipWriter(folder.path() / "no folder" / "one.zip"), core::MissingError);
}

}  // namespace
}  // namespace vibrotrough::archive
