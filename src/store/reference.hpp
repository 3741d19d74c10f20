#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace vibrotrough::store {

/// One name in a file of the store: a dataset, a field of a table, or a root attribute, which begins with @.
struct NameInFile {
    std::string name;        ///< with the group or table before it
    std::string_view type;   ///< float64, int32 or text
    std::string_view shape;  ///< scalar, or what there is one value of
    std::string units;       ///< in the spelling of udunits2; "1" for pure numbers and texts
    std::string meaning;     ///< for people; the attribute `description`
};

/// Everything in result.h5, in the order of the file.
std::vector<NameInFile> names_in_result();

/// Everything in campaign.h5, in the order of the file.
std::vector<NameInFile> names_in_campaign();

/// The names of both files as tables in Markdown: the reference that `vibrotrough quantities` prints.
std::string file_reference();

/// A name of an older version, and the one that took its place.
struct OldName {
    std::string_view old;   ///< in files and scripts of older versions
    std::string_view name;  ///< now
};

/// All names that were replaced since version 0.2.0: of quantities in files, and of columns of `compare`. The
/// module postprocess/vibrotrough/results.py has the same table, and a test compares the two.
std::vector<OldName> const& old_names();

/// The name that took the place of an old one; any other name as it is.
std::string_view current_name(std::string_view name);

}  // namespace vibrotrough::store
