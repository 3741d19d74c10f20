#pragma once

#include <cstddef>
#include <span>
#include <string_view>

/// @file
/// What a misspelt word may have been meant to be.

namespace vibrotrough::core {

/// Letters to insert, remove or replace to make one word of the other (Levenshtein).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The word that is nearest to a misspelt one; empty when none is near: one slip in three letters, three at
/// most.
std::string_view nearest_word(std::string_view misspelt, std::span<std::string_view const> words);

}  // namespace vibrotrough::core
