#pragma once

#include "scenario/model/run_settings.hpp"
#include "scenario/reader/case_values.hpp"

#include <functional>
#include <string>

#include <toml++/toml.h>

namespace vibrotrough::scenario {

/// Reads a value in SI as its key asks; throws an InputError with its place otherwise.
using ContentReader = std::function<Content(Key const&, toml::node const&)>;

/// Reads the section [run] with its subsection [run.slurm].
/// @param file  stands for the campaign file in errors
/// @throws InputError, one line: file:line:column, key, what is wrong, what to write instead
RunSettings read_run_section(toml::table const& section, std::string const& file, ContentReader const& read);

}  // namespace vibrotrough::scenario
