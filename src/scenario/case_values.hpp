#pragma once

#include "scenario/keys.hpp"
#include "scenario/scenario.hpp"

#include <map>
#include <string>
#include <string_view>

namespace vibrotrough {

/// Line and column in the campaign file, both from 1.
struct Position {
    unsigned line = 1;
    unsigned column = 1;
};

struct Place {
    std::string_view file;
    Position where;
};

/// A value in SI and where it was written.
struct Value {
    double number;
    Position where;
};

/// The values of one case by the path of their key.
using CaseValues = std::map<std::string, Value, std::less<>>;

/// Throws an InputError of one line: file:line:column, key, what is wrong, what to write instead.
[[noreturn]] void throw_at(Place place, std::string_view key, std::string_view wrong,
                           std::string_view instead);

/// Puts one case together and checks what only shows when keys are seen together.
/// @throws InputError
Scenario make_scenario(std::string const& campaign, CaseValues const& values, std::string const& file);

}  // namespace vibrotrough
