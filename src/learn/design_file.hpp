#pragma once

#include <string_view>

#include <nlohmann/json.hpp>

namespace vibrotrough::learn {

/// What `vibrotrough design --json` printed, as the page for browsers shows it: what was asked, and the
/// proposed machine with the settings of the page by name and with what each model says of it. Where several
/// speeds of the drive were compared, the second best machine follows.
///
/// {"wanted_t_per_h", "confidence", "untested", "machines": [{"rpm", "settings", "probability", "models"}],
/// "assumed"}; a number that is not known is null. `assumed` has the names of settings that the design does
/// not know; `models` is empty for the second machine.
/// A model with `is_beside` decided nothing.
/// @throws core::note::Fault when the text is something else
nlohmann::ordered_json proposed_machines(std::string_view text);

}  // namespace vibrotrough::learn
