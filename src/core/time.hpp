#pragma once

#include <string>

namespace vibrotrough::core {

/// Now, as ISO 8601 in UTC to the second, e.g. "2026-11-21T13:05:00Z".
std::string utc_now();

/// Name of this machine.
std::string host_name();

}  // namespace vibrotrough::core
