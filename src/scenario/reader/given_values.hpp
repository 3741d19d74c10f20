#pragma once

#include "scenario/reader/case_values.hpp"

#include <string>
#include <string_view>

namespace vibrotrough::scenario {

/// The values of one case with the defaults of the keys that are not given, and errors that point to the line
/// at which a key was given. All arguments must outlive it.
class GivenValues {
  public:
    /// @param file    names the campaign file in errors
    /// @param source  where the files are that the case names
    GivenValues(CaseValues const& values, std::string const& file, FileSource const& source)
        : values_(values), file_(file), source_(source) {}

    /// The value of a key, or nullptr when it is not given.
    Value const* find(std::string_view key) const;
    /// The number given for a key, or its default. Numbers are in SI units.
    double number(std::string_view key) const;
    /// number() of a key whose values are whole numbers.
    int integer(std::string_view key) const;
    /// The word given for a key, or the first of its words.
    std::string word(std::string_view key) const;
    /// The file that a key names: one of the given files, or read from the folder of the campaign file.
    /// @throws core::InputError when there is no such file or it is larger than 1 MiB
    NamedFile named_file(std::string_view key) const { return named_file(key, word(key)); }
    /// One of several files that a key names. @throws as named_file(key)
    NamedFile named_file(std::string_view key, std::string const& name) const;
    /// Shapes, waveforms and extra lines that were read for other cases.
    FilesRead& files_read() const { return *source_.read; }
    /// @throws core::InputError of one line: position of the key, key, what is wrong, what to write instead
    [[noreturn]] void fail(std::string_view key, std::string_view wrong, std::string_view instead) const;

  private:
    CaseValues const& values_;
    std::string const& file_;
    FileSource const& source_;
};

/// The trough of a case. @throws core::InputError
Trough read_trough(GivenValues const& given);

/// The grains of a case. @throws core::InputError
Grains read_grains(GivenValues const& given);

/// What a case asks of the engine. @throws core::InputError
EnginePlan read_engine_plan(GivenValues const& given);

}  // namespace vibrotrough::scenario
