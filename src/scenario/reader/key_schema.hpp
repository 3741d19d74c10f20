#pragma once

#include <string>

namespace vibrotrough::scenario {

/// The campaign file as a JSON Schema (draft 7), made from the table of keys. Editors complete and explain
/// keys with it (src/manual/howto/vary.md).
std::string key_schema();

}  // namespace vibrotrough::scenario
