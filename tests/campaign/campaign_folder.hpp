#pragma once

#include "campaign/state/case_state.hpp"
#include "campaign/state/plan.hpp"
#include "core/temporary_folder.hpp"
#include "evaluate/packing.hpp"
#include "scenario/example_campaign.hpp"
#include "scenario/reader/campaign_file.hpp"

#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace vibrotrough::campaign {

/// Without the sync to disk of write_file_atomically, which would make many writes slow.
inline void overwrite(std::filesystem::path const& path, std::string const& bytes) {
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

/// cycles.csv as the deck writes it, for a layer whose velocity efficiency in cycle k = 1 ... n is eta(k).
inline std::string cycles_text(scenario::Scenario const& scenario, int cycles,
                               std::function<double(int)> const& eta) {
    int const steps = prepare::prepare_case(scenario).time.steps_per_cycle;
    double const amplitude_x = scenario.trough.amplitude * std::cos(scenario.trough.vibration_angle);
    std::string text =
        "# SI units\nstep,grains,x_com,z_com,vz_com,mean_vx,mean_force_x,mean_force_z,flight_fraction\n";
    double x = 0.018;
    for (int k = 0; k <= cycles; ++k) {
        if (k > 0) x += eta(k) * 2 * std::numbers::pi * amplitude_x;
        text += fmt::format("{},{},{:.15g},0.01,0,0.1,0.01,{},0.5\n", k * steps, scenario.layer.grains, x,
                            k > 0 ? -0.09 : 0.0);
    }
    return text;
}

/// phases.csv of a layer that goes with the trough but for a steady slip, and one snapshot per profile.
inline void write_layer(std::filesystem::path const& folder, scenario::Scenario const& scenario, int cycles) {
    int const steps = prepare::prepare_case(scenario).time.steps_per_cycle;
    double const beta = scenario.trough.vibration_angle, r = scenario.trough.amplitude;
    std::string text =
        "step,x_com,z_com,vx_com,vz_com,trough_x,trough_z,force_x,force_z,floor_z,touching,touching_vx,"
        "touching_spin,"
        "clearance,energy_translation,energy_rotation,overlap\n";
    for (int i = 1; i <= 100 * cycles; ++i) {
        double const place = r * std::sin(2 * std::numbers::pi * i / 100);
        double const x = place * std::cos(beta), z = place * std::sin(beta);
        text += fmt::format("{},{},{},1,0,{},{},-0.01,-0.09,-0.09,10,10,0,-1e-6,0,0,2e-6\n",
                            i * (steps / 100), x, z, x, z);
    }
    overwrite(folder / "phases.csv", text);
    overwrite(folder / "profiles.0.txt", fmt::format("{} 1\n  1 0.001 10 700 1 0\n", steps * 6 / 5));
    overwrite(folder / "surface.0.txt", fmt::format("{} 1\n  1 0.001 10 700 0.002\n", steps * 6 / 5));
}

/// A campaign folder of one case with two packings; nothing is written at first.
class CampaignFolder : public testing::Test {
  protected:
    /// The packing's files as an engine that ended well leaves them.
    void write_packing(int packing, std::string const& cycles,
                       evaluate::PackingMarker const& marker = {}) const {
        overwrite(planned.packing_folder(packing) / "in.liggghts", fmt::format("# deck {}\n", packing));
        overwrite(planned.packing_folder(packing) / "cycles.csv", cycles);
        write_layer(planned.packing_folder(packing), scenario, 60);
        evaluate::write_marker(evaluate::read_packing_files(planned.packing_folder(packing)), marker);
    }

    std::string campaign_text = with("packings = 3", "packings = 2");
    core::TemporaryFolder const own_folder;
    std::filesystem::path folder = own_folder.path() / "campaign";
    Plan plan = make_plan(scenario::parse_campaign(campaign_text, "campaign.toml"), folder, "LIGGGHTS 3.8.0");
    PlannedCase planned = plan.cases.front();
    scenario::Scenario scenario = planned.scenario();
};

}  // namespace vibrotrough::campaign
