// A campaign file in a folder with the files that it names: a measured waveform, a clump, points. Whatever
// they hold, they are read, or refused with an InputError of a line for each mistake.

#include "core/error.hpp"
#include "core/temporary_folder.hpp"
#include "prepare/clump.hpp"
#include "scenario/reader/campaign_file.hpp"
#include "scenario/reader/written_campaign.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace {

using namespace vibrotrough;
namespace fs = std::filesystem;

fs::path const& folder() {
    static core::TemporaryFolder const made("vibrotrough-fuzz");
    return made.path();
}

/// A zero byte separates the campaign file, the waveform, the clump and the points.
void write_files(std::string_view text) {
    for (char const* name : {"campaign.toml", "waveform.csv", "clump.csv", "points.csv"}) {
        auto const end = std::min(text.find('\0'), text.size());
        std::ofstream(folder() / name, std::ios::binary) << text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
    }
}

void require(bool good) {
    if (!good) std::abort();
}

void check_motion(scenario::Trough const& trough) {
    scenario::DriveMotion const motion = scenario::drive_motion(trough);
    for (auto const* terms : {&motion.along, &motion.normal}) {
        for (scenario::DriveTerm const& term : *terms)
            require(std::isfinite(term.amplitude) && std::isfinite(term.phase));
    }
}

/// The integration takes some milliseconds for each sphere.
void check_clump(scenario::Grains const& grains) {
    if (!grains.shape_file || grains.shape_file->spheres.size() > 6) return;
    auto const clump = prepare::make_clump(grains);
    require(std::isfinite(clump->volume) && clump->volume > 0);
    require(std::isfinite(clump->bounding_radius) && clump->bounding_radius >= clump->smallest_radius);
    // The volume is that of a sphere of the grains' diameter; the integration knows it to 1e-2 at worst.
    for (double const moment : clump->inertia) require(std::isfinite(moment));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
    std::string_view const text(reinterpret_cast<char const*>(data), size);
    if (std::ranges::count(text, '.') > 1000) return 0;  // toml++ goes down into dotted keys by recursion
    write_files(text);
    try {
        scenario::Campaign const campaign = scenario::read_campaign(folder() / "campaign.toml");
        scenario::Scenario const& first = campaign.cases.front();
        check_motion(first.trough);
        check_clump(first.grains);
        // What was taken must come back: a case as a campaign file of its own, with its files, is the same
        // case.
        std::string const frozen = to_toml(first);
        scenario::FileSource const source{"/no-such-folder", named_files(first)};
        require(to_toml(scenario::parse_campaign(frozen, "frozen.toml", source).cases.front()) == frozen);
    } catch (core::Error const&) {
    }
    return 0;
}
