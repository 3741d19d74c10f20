#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace vibrotrough::archive {

/// A file of a bundle, as its lists name it.
struct ListedFile {
    std::string name;    ///< in the bundle
    std::string sha256;  ///< of its content
    std::uint64_t size;  ///< bytes
};

/// A case of a bundle.
struct ListedCase {
    std::string id;           ///< as `compare` prints it
    std::string description;  ///< what distinguishes it, and how it ended
};

/// What a bundle says of itself as a whole.
struct CrateFacts {
    std::string campaign;              ///< its name
    std::vector<std::string> authors;  ///< names of persons
    std::string license;               ///< address of the text; empty when none was named
    std::string begun, ended;          ///< ISO 8601, UTC: of the first and the last result; empty without one
    std::string program_version;       ///< that made the bundle
    std::string git_commit;            ///< of the same
    std::string engine_version;        ///< of the engine that the campaign was planned with
    std::vector<ListedFile> files;     ///< all that are in the bundle before this description
    std::vector<ListedCase> cases;     ///< in the order of the campaign
};

/// The content of ro-crate-metadata.json: a description of the bundle in JSON-LD by the RO-Crate Metadata
/// Specification 1.1 (https://w3id.org/ro/crate/1.1). Each case is a data set of its own. Decks belong to
/// their cases and are not described one by one.
std::string crate_metadata(CrateFacts const& facts);

}  // namespace vibrotrough::archive
