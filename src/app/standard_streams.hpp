#pragma once

#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace vibrotrough::app {

/// Writes to standard error. That it is closed, that nobody reads it any more, or that the disk behind it is
/// full, is no reason to stop.
void tell_text(std::string_view text) noexcept;

/// The same with a format and its arguments.
template <typename... Arguments>
void tell(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    tell_text(fmt::format(format, std::forward<Arguments>(arguments)...));
}

}  // namespace vibrotrough::app
