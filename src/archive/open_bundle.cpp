#include "archive/open_bundle.hpp"

#include "archive/bundle.hpp"
#include "archive/bundle_facts.hpp"
#include "archive/zip_file.hpp"
#include "campaign/state/campaign_folder.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

namespace vibrotrough::archive {
namespace {

namespace fs = std::filesystem;

using Digests = std::map<std::string, std::string>;  ///< SHA-256 by name

constexpr std::size_t longest_list = std::size_t{1} << 30;  ///< bytes of SHA256SUMS

[[noreturn]] void refuse(fs::path const& bundle, std::string const& reason) {
    throw core::InputError(
        fmt::format("{}: {}; nothing of it is used, get the bundle again", bundle.string(), reason));
}

/// Lines of 64 hexadecimal digits, two blanks and a name.
Digests parse_checksums(fs::path const& bundle, std::string_view text) {
    Digests digests;
    while (!text.empty()) {
        std::size_t const end = std::min(text.find('\n'), text.size());
        std::string_view const line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        bool const is_good =
            line.size() > 66 && line.substr(64, 2) == "  " && is_safe_name(line.substr(66)) &&
            line.substr(0, 64).find_first_not_of("0123456789abcdef") == std::string_view::npos;
        if (!is_good || !digests.emplace(line.substr(66), line.substr(0, 64)).second)
            refuse(bundle, fmt::format("{} is damaged", checksums_file));
    }
    return digests;
}

/// Compares what was found with the list, in both directions.
void compare_digests(fs::path const& bundle, Digests const& listed, Digests const& found) {
    for (auto const& [name, digest] : listed) {
        auto const file = found.find(name);
        if (file == found.end()) refuse(bundle, fmt::format("{} is missing", name));
        if (file->second != digest) {
            refuse(bundle,
                   fmt::format("{} is not what it was when the bundle was made: its SHA-256 is {} and "
                               "not {}",
                               name, file->second, digest));
        }
    }
    for (auto const& [name, digest] : found) {
        if (!listed.contains(name))
            refuse(bundle, fmt::format("{} was added after the bundle was made", name));
    }
}

/// Whether the table needs a file; the others are only checked.
bool is_needed(std::string const& name) {
    bool const is_of_packing = name.find("/packing-") != std::string::npos;
    return !is_of_packing && !name.starts_with("decks/") && !name.starts_with("report/") &&
           !name.starts_with("tables/") && name != "campaign.h5" && name != checksums_file;
}

/// Refuses a name that is there already, or that needs a file that is there as a folder.
void refuse_clash(fs::path const& bundle, Digests const& found, std::string const& name) {
    for (std::size_t end = name.find('/'); end != std::string::npos; end = name.find('/', end + 1)) {
        std::string const folder = name.substr(0, end);
        if (found.contains(folder)) refuse(bundle, fmt::format("holds {} as a file and as a folder", folder));
    }
    auto const below = found.lower_bound(name + "/");
    if (found.contains(name) || (below != found.end() && below->first.starts_with(name + "/")))
        refuse(bundle, fmt::format("holds {} twice", name));
}

/// Unpacks what the table needs and checks everything.
std::shared_ptr<core::TemporaryFolder const> unpack(fs::path const& bundle) {
    auto const place = std::make_shared<core::TemporaryFolder const>("vibrotrough-bundle");
    Digests found;
    std::string sums, name;
    std::unique_ptr<core::NewFile> file;
    std::unique_ptr<core::Sha256> digest;
    auto const begin = [&](std::string const& one) -> ZipSink {
        name = one;
        refuse_clash(bundle, found, name);
        digest = std::make_unique<core::Sha256>();
        if (is_needed(name)) {
            fs::path const path = place->path() / name;
            core::make_folder(path.parent_path());
            file = std::make_unique<core::NewFile>(path);
        }
        return [&](std::string_view piece) {
            digest->add(piece);
            if (file) file->write(piece);
            if (name != checksums_file) return;
            if (sums.size() + piece.size() > longest_list)
                refuse(bundle, "its list of checksums is too long");
            sums += piece;
        };
    };
    auto const end = [&] {
        if (file) file->finish(core::Sync::no);
        file.reset();
        if (name == checksums_file) return;
        found.emplace(name, digest->hex());
    };
    read_zip(bundle, begin, end);
    if (sums.empty()) refuse(bundle, fmt::format("{} is missing or empty", checksums_file));
    compare_digests(bundle, parse_checksums(bundle, sums), found);
    return place;
}

/// The digests of all files of an unpacked bundle. What commands write beside it is left out: figures and
/// report that are not listed, frames, hidden files.
Digests digests_of_folder(fs::path const& folder, Digests const& listed) {
    Digests found;
    for (auto entry = fs::recursive_directory_iterator(folder); entry != fs::recursive_directory_iterator();
         ++entry) {
        std::string const name = entry->path().lexically_relative(folder).generic_string();
        bool const is_ours = listed.contains(name);
        bool const is_beside = entry->path().filename().string().starts_with('.') || name == "report" ||
                               name == "view" || name.starts_with("report/") || name.starts_with("view/");
        if (entry->is_directory() && !entry->is_symlink()) {
            if (is_beside && name != "report" && !name.starts_with("report/"))
                entry.disable_recursion_pending();
            continue;
        }
        if (name == checksums_file || (is_beside && !is_ours)) continue;
        found[name] = is_ours ? core::sha256_hex(core::read_file(entry->path())) : "";
    }
    return found;
}

void check_unpacked(fs::path const& folder) {
    Digests const listed = parse_checksums(folder, core::read_file(folder / checksums_file, longest_list));
    try {
        compare_digests(folder, listed, digests_of_folder(folder, listed));
    } catch (core::InputError const& error) {
        throw core::InputError(fmt::format("{} (or remove {}, and the folder is read as any campaign's)",
                                           error.what(), checksums_file));
    }
}

void read_facts(OpenBundle& bundle, fs::path const& path) {
    BundleFacts facts;
    try {
        facts = parse_facts(core::read_file(bundle.folder / facts_file, core::largest_note));
    } catch (core::note::Fault const& fault) {
        refuse(path, fmt::format("{} is damaged: {}", facts_file, fault.what()));
    }
    bundle.results = facts.results;
    bundle.program_version = facts.program_version;
    for (auto const& [id, outcome] : facts.failures)
        bundle.activity.packings.push_back({{id, 1}, campaign::PackingActivity::ended, outcome});
}

}  // namespace

std::optional<OpenBundle> open_bundle(fs::path const& path) {
    std::error_code missing;
    OpenBundle bundle;
    if (fs::is_regular_file(path, missing)) {
        if (first_name_in_zip(path) != facts_file) {
            throw core::InputError(fmt::format(
                "{} is not a campaign folder, nor a bundle of 'vibrotrough archive'; give the folder that "
                "'vibrotrough run --output' made, or a bundle",
                path.string()));
        }
        auto place = unpack(path);
        bundle.folder = place->path();
        bundle.unpacked = std::move(place);
    } else {
        bool const is_unpacked = fs::is_regular_file(path / facts_file, missing) &&
                                 fs::is_regular_file(path / checksums_file, missing);
        if (!is_unpacked) return {};
        check_unpacked(path);
        bundle.folder = path;
    }
    read_facts(bundle, path);
    return bundle;
}

}  // namespace vibrotrough::archive
