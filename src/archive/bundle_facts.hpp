#pragma once

#include "core/note.hpp"
#include "core/outcome.hpp"

#include <cstddef>
#include <map>
#include <string>
#include <string_view>

namespace vibrotrough::archive {

/// What a bundle says of itself.
struct BundleFacts {
    std::size_t results = 0;                        ///< number of cases with a result
    std::string program_version;                    ///< that made it
    std::map<std::string, core::Outcome> failures;  ///< why cases have no result, by their ids
};

/// The facts of a bundle, from their text.
/// @throws core::note::Fault when the text is not such a note, or has a version that this program does not
/// know
BundleFacts parse_facts(std::string_view text);

}  // namespace vibrotrough::archive
