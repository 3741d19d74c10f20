#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include <nlohmann/json.hpp>

namespace vibrotrough::app {

/// A number, or null where it is not known.
nlohmann::ordered_json number_or_null(std::optional<double> const& value);

/// Prints rows with the same members as CSV: nothing for null, 1 and 0 for true and false, and the elements
/// of a list with blanks between them.
void print_csv(std::vector<nlohmann::ordered_json> const& rows);

/// Prints a JSON object with a list of any length at its end, element by element, so that only one of them is
/// in memory: 100,000 cases as a whole would take hundreds of megabytes.
/// @param head     the object; its last member is an empty list
/// @param count    number of elements of the list
/// @param element  makes element i; called in order
void print_with_list(nlohmann::ordered_json const& head, std::size_t count,
                     std::function<nlohmann::ordered_json(std::size_t i)> const& element);

}  // namespace vibrotrough::app
