#include "scenario/model/softness.hpp"
#include "scenario/reader/given_values.hpp"

#include <array>

#include <fmt/format.h>

namespace vibrotrough::scenario {
namespace {

/// A part of a case, by the key that gives it.
struct Part {
    std::string_view key;  ///< or the begin of the keys of a list
    /// Whether a case has it; null: whether the key is given.
    bool (*is_in)(Scenario const&) = nullptr;
};

/// How two parts of a case stand to each other.
struct Pair {
    Part one, other;
    std::string_view reason;
};

namespace parts {

constexpr Part mesh{"trough.mesh", [](Scenario const& s) { return s.trough.mesh != nullptr; }};
constexpr Part mesh_with_walls{"trough.mesh", [](Scenario const& s) {
                                   return s.trough.mesh && (!is_open(s) || s.trough.mesh->has_upright_sides);
                               }};
constexpr Part side_walls{"trough.side_wall_friction"};
constexpr Part walls{"trough.side_wall_friction", [](Scenario const& s) {
                         return s.trough.side_wall_friction ||
                                (s.trough.mesh && s.trough.mesh->has_upright_sides);
                     }};
constexpr Part clump{"grains.shape", [](Scenario const& s) { return is_clump(s.grains); }};
constexpr Part several_sizes{"grains.diameter", [](Scenario const& s) {
                                 return s.grains.diameter_spread > 0 || s.grains.diameters.size() > 1;
                             }};
constexpr Part rolling{"grains.rotation",
                       [](Scenario const& s) { return s.grains.rotation == Rotation::rolling; }};
constexpr Part rolling_friction{"grains.rolling_friction",
                                [](Scenario const& s) { return s.grains.rolling_friction > 0; }};
constexpr Part block{"layer.block", [](Scenario const& s) { return s.layer.block != Block::none; }};
constexpr Part materials_of_layer{"materials.", [](Scenario const& s) { return !s.materials.empty(); }};
constexpr Part stages_of_drive{"stages.", [](Scenario const& s) { return !s.stages.empty(); }};
constexpr Part feed{"feed.mass_flow", is_open};
constexpr Part screen{"screen.opening", is_screen};
constexpr Part batch{"screen.opening", is_batch};
constexpr Part other_contact{"engine.contact",
                             [](Scenario const& s) { return s.engine.contact != ContactModel::hertz; }};
constexpr Part cohesion{"engine.cohesion", [](Scenario const& s) { return s.engine.cohesion > 0; }};
constexpr Part contacts{"output.contacts", [](Scenario const& s) { return s.output.contacts; }};
constexpr Part frames{"output.frames_per_cycle",
                      [](Scenario const& s) { return s.output.frames_per_cycle > 0; }};

constexpr std::string_view whole_motion = "the waveform is the whole motion";
constexpr std::string_view length_of_stages = "how long a run is follows from the stages";
constexpr std::string_view length_of_batch = "how long a run is follows from screen.time";
constexpr std::string_view given_packings =
    "a case whose length is given has as many packings as measure.packings says";
constexpr std::string_view no_feed = "nothing is fed without a mass flow";
constexpr std::string_view no_screen = "only a screen with holes has it";

/// What a case cannot have together.
constexpr std::array excluded{
    Pair{screen, mesh, "a screen is a flat floor with square holes"},
    Pair{batch, side_walls, "a screen without a feed is periodic across and has no side walls"},
    Pair{screen, clump, "which clumps fall through a hole is not known"},
    Pair{screen, block, "a block does not fall through a screen"},
    Pair{screen, materials_of_layer, "the grains on a screen are of one material"},
    Pair{screen, stages_of_drive, "the drive of a screen has no stages"},
    Pair{screen, contacts, "contacts are not written of grains on a screen"},
    Pair{feed, {"screen.time"}, "how long fed grains are on a screen is a result"},
    Pair{feed, clump, "an open trough is fed with spheres"},
    Pair{feed, contacts, "contacts are not written of an open trough"},
    Pair{block, mesh, "a block needs the flat floor"},
    Pair{block, clump, "a block has a shape of its own"},
    Pair{block, several_sizes, "a block has only one diameter"},
    Pair{block, materials_of_layer, "a block has only one material"},
    Pair{block, other_contact, "a block has a contact of its own"},
    Pair{block, cohesion, "a block has a contact of its own, without attraction"},
    Pair{block, contacts, "contacts are written only for layers of spheres"},
    Pair{clump, contacts, "contacts are written only for layers of spheres"},
    Pair{clump, materials_of_layer, "layers of clumps have only one material"},
    Pair{clump, several_sizes, "clumps must all have the same size"},
    Pair{clump, rolling, "the model of rolling friction is only for spheres"},
    Pair{mesh_with_walls, side_walls, "the mesh has walls of its own"},
    Pair{side_walls, {"trough.width"}, "between side walls the width is layer.width"},
    Pair{{"trough.waveform"}, {"trough.harmonics"}, whole_motion},
    Pair{{"trough.waveform"}, {"trough.along_phase"}, whole_motion},
    Pair{{"grains.diameters"}, {"grains.size_law"}, "the list of diameters is the distribution"},
    Pair{{"grains.diameters"}, {"grains.diameter_spread"}, "the list of diameters is the distribution"},
    Pair{stages_of_drive, {"measure.max_cycles"}, length_of_stages},
    Pair{stages_of_drive, {"measure.min_cycles"}, length_of_stages},
    Pair{stages_of_drive, {"measure.max_packings"}, given_packings},
    Pair{stages_of_drive, {"measure.max_core_time"}, given_packings},
    Pair{batch, {"measure.max_cycles"}, length_of_batch},
    Pair{batch, {"measure.min_cycles"}, length_of_batch},
    Pair{batch, {"measure.max_packings"}, given_packings},
    Pair{batch, {"measure.max_core_time"}, given_packings},
};

/// What needs something else.
constexpr std::array needed{
    Pair{feed, walls, "an open trough is not periodic across, and a mesh has no upright sides here"},
    Pair{{"feed.length"}, feed, no_feed},
    Pair{{"feed.width"}, feed, no_feed},
    Pair{{"feed.height"}, feed, no_feed},
    Pair{screen, {"screen.wire"}, "both are the pitch of the holes"},
    Pair{batch, {"screen.time"}, "a screen without a feed is simulated for a given time"},
    Pair{{"screen.wire"}, screen, no_screen},
    Pair{{"screen.time"}, screen, no_screen},
    Pair{{"trough.waveform_order"}, {"trough.waveform"}, "it is a harmonic of the record"},
    Pair{{"trough.mesh_unit"}, mesh, "it is the unit of a mesh"},
    Pair{{"grains.number_fractions"}, {"grains.diameters"}, "they are the shares of listed diameters"},
    Pair{{"grains.mass_fractions"}, {"grains.diameters"}, "they are the shares of listed diameters"},
    Pair{rolling, rolling_friction, "grains that roll against a friction have one above 0"},
    Pair{rolling_friction, {"grains.rotation"}, "it has no effect on grains that rotate freely"},
    Pair{{"output.frame_packings"}, frames, "there are no frames"},
    Pair{contacts, frames, "there are no frames"},
};

}  // namespace parts

/// The key that gives a part, to which a message points.
std::string_view key_of(Part const& part, GivenKeys const& given) {
    if (given.has(part.key)) return part.key;
    for (Key const& key : all_keys())
        if (key.path.starts_with(part.key) && given.has(key.path)) return key.path;
    return part.key;
}

}  // namespace

void check_pairs(Scenario const& scenario, GivenKeys const& given) {
    auto const has = [&](Part const& part) {
        return part.is_in != nullptr ? part.is_in(scenario) : given.has(part.key);
    };
    for (Pair const& pair : parts::excluded) {
        if (has(pair.one) && has(pair.other))
            given.fail(key_of(pair.other, given),
                       fmt::format("does not go with {}: {}", key_of(pair.one, given), pair.reason),
                       "remove one of the two");
    }
    for (Pair const& pair : parts::needed) {
        if (!has(pair.one) || has(pair.other)) continue;
        Key const& missing = *find_key(pair.other.key);
        std::string_view const key = key_of(pair.one, given);
        given.fail(key, fmt::format("needs {}: {}", missing.path, pair.reason),
                   fmt::format("{} under [{}], or remove {}", write_instead(missing), section_of(missing),
                               last_name(key)));
    }
}

void check_cohesion(Scenario const& scenario, GivenKeys const& given) {
    if (scenario.engine.cohesion <= 0 || scenario.grains.youngs_modulus) return;
    given.fail(
        "engine.cohesion",
        "needs grains.youngs_modulus: the pull that the cohesion means depends on the modulus, so that it "
        "cannot be chosen",
        fmt::format("write for example youngs_modulus = \"{:g} MPa\" under [grains], which is stiff enough "
                    "for this layer, or remove cohesion",
                    stiff_enough(scenario, scenario.solver.softness) / 1e6));
}

}  // namespace vibrotrough::scenario
