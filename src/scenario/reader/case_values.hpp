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
    unsigned line = 1;
    unsigned column = 1;
};

struct Place {
    std::string_view file;
    Position where;
};

/// What stands right of an equals sign: a number in SI, a word, a list of either. Which one follows from the
/// key's kind.
using Content = std::variant<double, std::string, std::vector<double>, std::vector<std::string>>;

/// A value and where it was written.
struct Value {
    Content content;
    Position where;

    double number() const { return std::get<double>(content); }
    std::string const& word() const { return std::get<std::string>(content); }
    std::vector<double> const& numbers() const { return std::get<std::vector<double>>(content); }
    std::vector<std::string> const& words() const { return std::get<std::vector<std::string>>(content); }
};

/// The values of one case by the path of their key.
using CaseValues = std::map<std::string, Value, std::less<>>;

/// Throws an InputError of one line: file:line:column, key, what is wrong, what to write instead.
[[noreturn]] void throw_at(Place place, std::string_view key, std::string_view wrong,
                           std::string_view instead);

/// The files that cases name, each read once however many cases share it.
struct FilesRead {
    std::map<std::string, std::shared_ptr<ShapeFile const>> shapes;
    std::map<std::string, std::shared_ptr<Waveform const>> waveforms;
};

/// Where the files are that a case names: given, or else in a folder.
struct FileSource {
    std::filesystem::path folder = {};
    std::vector<NamedFile> files = {};
    std::shared_ptr<FilesRead> read = std::make_shared<FilesRead>();
};

/// Puts one case together and checks what only shows when keys are seen together.
/// @param file  the campaign file, for errors
/// @throws InputError
Scenario make_scenario(std::string const& campaign, CaseValues const& values, std::string const& file,
                       FileSource const& source);

}  // namespace vibrotrough::scenario
