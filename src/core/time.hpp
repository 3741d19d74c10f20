#pragma once

#include <string>

namespace vibrotrough::core {

/// The present time in UTC in the format of ISO 8601, to the second, e.g. "2026-11-21T13:05:00Z".
std::string utc_now();

/// Name of this machine; "unknown" when the system does not give it.
std::string host_name();

}  // namespace vibrotrough::core
