#pragma once

#include "core/error.hpp"
#include "scenario/reader/campaign_file.hpp"

#include <string>

// What the reader makes of a campaign file with one case.
namespace vibrotrough {

inline scenario::Scenario single_case(std::string const& text) {
    return scenario::parse_campaign(text, "test.toml").cases.front();
}

inline std::string error_of(std::string const& text, scenario::FileSource const& source = {}) {
    try {
        scenario::parse_campaign(text, "c.toml", source);
    } catch (core::InputError const& error) {
        return error.what();
    }
    return "no error";
}

}  // namespace vibrotrough
