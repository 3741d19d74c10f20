#pragma once

#include "scenario/model/run_settings.hpp"

#include <string>

#include <toml++/toml.h>

namespace vibrotrough::scenario {

/// Reads the section [run] with its subsection [run.slurm].
/// @param file  names the campaign file in errors
/// @throws core::InputError of one line: file:line:column, key, what is wrong, what to write instead
RunSettings read_run_section(toml::table const& section, std::string const& file);

}  // namespace vibrotrough::scenario
