#include "deck/deck_folder.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/note.hpp"

#include <fmt/format.h>

namespace vibrotrough::deck {
namespace {

namespace fs = std::filesystem;
using core::note::Json;

constexpr char const* format_name = "vibrotrough deck";

[[noreturn]] void refuse(fs::path const& path, std::string const& what) {
    throw core::InputError(
        fmt::format("{} {}, and it would be replaced; move it away, or choose another folder with --output",
                    path.string(), what));
}

/// The digests of the files that were written here; empty when nothing was.
core::note::Digests read_written(fs::path const& folder) {
    fs::path const path = folder / written_file;
    if (!fs::exists(fs::symlink_status(path))) return {};
    try {
        if (!core::is_link(path)) return parse_written(core::read_file(path, core::largest_note));
    } catch (core::note::Fault const&) {
        // The message below says it.
    }
    refuse(path, "is not a file of this program");
}

/// The digest of a file that may be replaced; empty when there is none, or when it has this content already.
std::string replaceable(fs::path const& path, std::string const& name, std::string const& content,
                        core::note::Digests const& written) {
    if (!fs::exists(fs::symlink_status(path))) return {};
    if (core::is_link(path)) refuse(path, "is a symbolic link");
    std::string const before = core::read_file(path, core::largest_note);
    if (before == content) return {};
    if (core::note::knows(written, name, before)) return core::sha256_hex(before);
    refuse(path, "is not what 'vibrotrough deck' wrote there");
}

}  // namespace

core::note::Digests parse_written(std::string_view text) {
    Json const json = core::note::parse(text);
    if (core::note::text(json, "format") != format_name) throw core::note::Fault("it is of another format");
    return core::note::digests(json, "files");
}

void write_case(fs::path const& folder, std::map<std::string, std::string> const& files) {
    core::note::Digests const written = read_written(folder);
    core::note::Digests both, last;
    for (auto const& [name, content] : files) {
        last[name] = both[name] = {core::sha256_hex(content)};
        std::string const before = replaceable(folder / name, name, content, written);
        if (!before.empty()) both[name].push_back(before);
    }
    core::make_folder(folder);
    auto const write_digests = [&](core::note::Digests const& digests) {
        core::replace_file(folder / written_file,
                           Json{{"format", format_name}, {"files", digests}}.dump(2) + "\n");
    };
    // While the files are written, both the old and the new ones are known, so that after a crash none of
    // them seems to be a person's.
    write_digests(both);
    for (auto const& [name, content] : files) {
        core::make_folder((folder / name).parent_path());
        core::replace_file(folder / name, content);
    }
    if (both != last) write_digests(last);
}

void make_frame_folder(Deck const& deck, fs::path const& folder) {
    if (deck.files.at(drive_file).find(" dump/") != std::string::npos) core::make_folder(folder / "dump");
}

}  // namespace vibrotrough::deck
