#pragma once

#include "core/text.hpp"

#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace vibrotrough::app {

/// Writes to standard error as it stands. That it is closed, that nobody reads it any more, or that the disk
/// behind it is full, is no reason to stop.
void tell_text(std::string_view text) noexcept;

/// The same with a format and its arguments, made safe for a terminal (core::harmless).
template <typename... Arguments>
void tell(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    tell_text(core::harmless(fmt::format(format, std::forward<Arguments>(arguments)...)));
}

}  // namespace vibrotrough::app
