#include "deck/deck_folder.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"

#include <fmt/format.h>

namespace vibrotrough::deck {

namespace fs = std::filesystem;

void write_case(fs::path const& folder, std::map<std::string, std::string> const& files) {
    for (auto const& [name, content] : files) {
        fs::path const path = folder / name;
        if (!fs::exists(path) || core::read_file(path, core::largest_note) == content) continue;
        throw core::InputError(fmt::format(
            "{} is there already and holds something else; move it away, or choose another folder with "
            "--output",
            path.string()));
    }
    for (auto const& [name, content] : files) {
        core::make_folder((folder / name).parent_path());
        core::replace_file(folder / name, content);
    }
}

void make_frame_folder(Deck const& deck, fs::path const& folder) {
    if (deck.files.at(drive_file).find(" dump/") != std::string::npos) core::make_folder(folder / "dump");
}

}  // namespace vibrotrough::deck
