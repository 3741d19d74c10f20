#pragma once

#include "scenario/model/scenario.hpp"
#include "scenario/reader/keys.hpp"

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace vibrotrough::scenario {

/// Line and column in the campaign file, both from 1.
struct Position {
    unsigned line = 1;    ///< from 1
    unsigned column = 1;  ///< from 1
};

/// A position and the file in which it is.
struct FilePosition {
    std::string_view file;  ///< name for errors
    Position where;         ///< in that file
};

/// The value to the right of an equals sign: a number in SI units, a word, or a list of either, depending on
/// the kind of the key.
using Content = std::variant<double, std::string, std::vector<double>, std::vector<std::string>>;

/// A value and its position in the campaign file. The accessors throw std::bad_variant_access for other
/// kinds.
struct Value {
    Content content;  ///< the value itself
    Position where;   ///< of the key

    /// The value of a quantity, a number or an integer, in SI units.
    double number() const { return std::get<double>(content); }
    /// The value of a choice or a file.
    std::string const& word() const { return std::get<std::string>(content); }
    /// The value of a list of quantities or numbers, in SI units.
    std::vector<double> const& numbers() const { return std::get<std::vector<double>>(content); }
    /// The value of a list of texts.
    std::vector<std::string> const& words() const { return std::get<std::vector<std::string>>(content); }
};

/// The given values of one case by the path of their key.
using CaseValues = std::map<std::string, Value, std::less<>>;

/// Reports a mistake in the campaign file.
/// @throws core::InputError of one line: file:line:column, key, what is wrong, what to write instead
[[noreturn]] void throw_at(FilePosition position, std::string_view key, std::string_view wrong,
                           std::string_view instead);

/// The files that were read for the cases of a campaign by name. Each is read once, however many cases use
/// it.
struct FilesRead {
    std::map<std::string, std::shared_ptr<ShapeFile const>> shapes;                      ///< of clumps
    std::map<std::string, std::shared_ptr<Waveform const>> waveforms;                    ///< of the trough
    std::map<std::string, std::shared_ptr<ExtraLines const>> extras;                     ///< for the engine
    std::map<std::vector<std::string>, std::shared_ptr<DeckTemplates const>> templates;  ///< of decks
};

/// Where to find the files that a case names: first among given files, then in a folder.
struct FileSource {
    std::filesystem::path folder = {};  ///< usually that of the campaign file
    std::vector<NamedFile> files = {};  ///< files whose content is known already
    std::shared_ptr<FilesRead> read = std::make_shared<FilesRead>();  ///< files read so far
};

/// Puts one case together and finds the mistakes that show only when several keys are seen together.
/// @param campaign  name of the campaign
/// @param values    every required key, or one of each group
/// @param file      names the campaign file in errors
/// @throws core::InputError as throw_at
/// @throws core::MissingError when a file that the case names cannot be read
Scenario make_scenario(std::string const& campaign, CaseValues const& values, std::string const& file,
                       FileSource const& source);

}  // namespace vibrotrough::scenario
