#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace vibrotrough::core {

/// A text without the spaces and tabs at its ends; a view into the same text.
std::string_view trimmed(std::string_view text);

/// A text from outside, made safe for a terminal: control characters but line ends and tabs, with which a
/// terminal can be steered, marks that change the direction of writing, and bytes that are not UTF-8 are
/// written as "\x1b", "\u202e" and "\xff". The letters of all languages stay. To be called where a text is
/// printed, and where bytes of another program become a text.
std::string harmless(std::string_view text);

/// A printed number that rounds to zero without a sign: "0.0000" for "-0.0000".
std::string without_sign_of_zero(std::string number);

/// A number with three digits behind the point; "-" where it is not known.
std::string three_digits(std::optional<double> const& value);

/// A number with so many digits and without a power of ten, where that has at most 15 digits: "1150" and not
/// "1.15e+03".
std::string plain_number(double value, int digits);

}  // namespace vibrotrough::core
