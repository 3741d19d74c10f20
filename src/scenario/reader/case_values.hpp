#pragma once

#include "scenario/model/scenario.hpp"
#include "scenario/reader/keys.hpp"

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace vibrotrough::scenario {

/// Line and column in the campaign file, both from 1.
struct Position {
    unsigned line = 1;    ///< from 1
    unsigned column = 1;  ///< from 1
};

/// A position and the file in which it is.
struct FilePosition {
    std::string_view file;  ///< name for errors; empty of a value that stands in no file
    Position where;         ///< in that file
};

/// A value and its position in the campaign file.
struct Value {
    Content content;        ///< the value itself
    Position where;         ///< of the key
    std::string unit = {};  ///< of a quantity as it is written; empty where that is not known
};

/// Short paths first: most paths that are compared differ in length, which is known without reading them.
struct ByLength {
    /// Whether `a` comes before `b`.
    bool operator()(std::string_view a, std::string_view b) const {
        return a.size() != b.size() ? a.size() < b.size() : a < b;
    }
};

/// The given values of one case by the path of their key, as the table of keys holds it.
using CaseValues = std::map<std::string_view, Value, ByLength>;

/// Reports a mistake in the campaign file.
/// @throws core::InputError of one line: file:line:column, key, what is wrong, what to write instead
[[noreturn]] void throw_at(FilePosition position, std::string_view key, std::string_view wrong,
                           std::string_view instead);

/// The files that were read for the cases of a campaign by name. Each is read once, however many cases use
/// it.
struct FilesRead {
    std::mutex one_case;  ///< is locked while a case looks for a file or reads it
    std::map<std::vector<std::string>, std::shared_ptr<ShapeFile const>> shapes;         ///< of clumps
    std::map<std::vector<std::string>, std::shared_ptr<Waveform const>> waveforms;       ///< of the trough
    std::map<std::vector<std::string>, std::shared_ptr<TroughMesh const>> meshes;        ///< of the trough
    std::map<std::vector<std::string>, std::shared_ptr<DeckTemplates const>> templates;  ///< of decks
};

/// Where to find the files that a case names: first among given files, then in a folder.
struct FileSource {
    std::filesystem::path folder = {};  ///< usually that of the campaign file
    std::vector<NamedFile> files = {};  ///< files whose content is known already
    std::shared_ptr<FilesRead> read = std::make_shared<FilesRead>();  ///< files read so far
};

/// Puts one case together and finds the mistakes that show only when several keys are seen together.
/// @param values  every required key, or one of each group
/// @param file    names the campaign file in errors
/// @throws core::InputError as throw_at
/// @throws core::MissingError when a file that the case names cannot be read
Scenario make_scenario(CaseValues const& values, std::string const& file, FileSource const& source);

}  // namespace vibrotrough::scenario
