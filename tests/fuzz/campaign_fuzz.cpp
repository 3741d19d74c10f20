// Whatever a campaign file holds: it is read, or refused with an InputError.

#include "core/error.hpp"
#include "scenario/reader/campaign_file.hpp"
#include "scenario/reader/written_campaign.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
    using namespace vibrotrough;
    std::string_view const text(reinterpret_cast<char const*>(data), size);
    if (std::ranges::count(text, '.') > 1000) return 0;  // toml++ goes down into dotted keys by recursion
    try {
        scenario::Campaign const campaign = scenario::parse_campaign(text, "fuzz.toml", {"/no-such-folder"});
        // What was taken must come back: a case as a campaign file of its own is the same case.
        std::string const frozen = to_toml(campaign.cases.front());
        if (!named_files(campaign.cases.front()).empty()) return 0;
        if (to_toml(scenario::parse_campaign(frozen, "frozen.toml", {"/no-such-folder"}).cases.front()) !=
            frozen)
            std::abort();
    } catch (core::Error const&) {
    }
    return 0;
}
