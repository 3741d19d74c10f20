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

Files read(std::filesystem::path const& path) {
    Files files;
    int complete = 0;
    read_zip(
        path,
        [&](std::string const& name) -> ZipSink {
            return [&text = files[name]](std::string_view piece) { text += piece; };
        },
        [&] { ++complete; });
    EXPECT_EQ(static_cast<std::size_t>(complete), files.size());
    return files;
}

Files sample() {
    // Compressible, longer than a piece, empty, and bytes that deflate cannot shorten.
    Files files{{"a.txt", std::string(200'000, 'x')}, {"b/c/empty.csv", ""}, {"b/d.h5", ""}};
    unsigned state = 1;
    for (int i = 0; i < 100'000; ++i)
        files["b/d.h5"] += static_cast<char>((state = state * 1664525u + 1013904223u) >> 24);
    return files;
}

// What is written is read back unchanged, and the same files make the same bytes. (Python's zipfile reads
// them in end_to_end.archive.)
TEST(ZipFile, IsReadBackAndReproducible) {
    core::TemporaryFolder const folder;
    write(folder.path() / "one.zip", sample());
    write(folder.path() / "two.zip", sample());
    EXPECT_EQ(read(folder.path() / "one.zip"), sample());
    EXPECT_EQ(core::read_file(folder.path() / "one.zip"), core::read_file(folder.path() / "two.zip"));
    EXPECT_EQ(first_name_in_zip(folder.path() / "one.zip"), "a.txt");
}

// A name in UTF-8 stays what it is, and is marked as UTF-8: bit 11 of the flags at byte 6 (PKWARE's
// APPNOTE.TXT, 4.4.4).
TEST(ZipFile, NamesAreUtf8) {
    core::TemporaryFolder const folder;
    Files const files{{"größe.txt", "1"}};
    write(folder.path() / "one.zip", files);
    EXPECT_EQ(read(folder.path() / "one.zip"), files);
    EXPECT_EQ(core::read_file(folder.path() / "one.zip").at(7) & 8, 8);
    EXPECT_EQ(first_name_in_zip(folder.path() / "one.zip"), "größe.txt");
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

// Every truncation is noticed before the end of the last file, as an error and not as a crash.
TEST(ZipFile, DamageIsAnError) {
    core::TemporaryFolder const folder;
    auto const path = folder.path() / "one.zip";
    write(path, sample());
    std::string const whole = core::read_file(path);
    for (std::size_t length = 0; length < 100'000; length += 9'973) {
        core::replace_file(path, whole.substr(0, length));
        EXPECT_THROW(read(path), core::InputError) << length;
    }
}

// Names that lead out of a folder, hide something, or steer a terminal are not safe; usual ones are.
TEST(ZipFile, KnowsSafeNames) {
    for (char const* name :
         {"a", "cases/0123456789ab/packing-1/in.liggghts", "..a", "a..", ".hidden", "größe.txt"})
        EXPECT_TRUE(is_safe_name(name)) << name;
    for (std::string const name :
         {"", "/a", "a/", "a//b", ".", "..", "a/../b", "./a", "a\\b", "C:a", "a\nb", "a\x1b[2J", "a\xff"})
        EXPECT_FALSE(is_safe_name(name)) << name;
    EXPECT_FALSE(is_safe_name(std::string(256, 'a')));
    std::string deep = "a";
    while (deep.size() <= 1000) deep += "/a";
    EXPECT_FALSE(is_safe_name(deep));
}

}  // namespace
}  // namespace vibrotrough::archive
