#include "scenario/reader/cannot.hpp"

#include <algorithm>
#include <array>
#include <ranges>
#include <string>

namespace vibrotrough::scenario {
namespace {

constexpr std::array requests{
    Cannot{
        "skirt guard motion at_rest static_wall belt",
        "surfaces that move differently from the trough, such as a skirt at rest, cannot be simulated",
        "leave it out, or let it move with the trough (trough.side_wall_friction, or walls in trough.mesh)"},
    Cannot{"rocking rotation_amplitude rotation_center roll pitch yaw tilt swing",
           "a trough that rocks or turns cannot be simulated",
           "simulate places along it as cases of their own, each with its amplitude and vibration_angle"},
    Cannot{"hopper silo outlet bunker funnel", "hoppers and outlets in the floor cannot be simulated",
           "feed a stream of spheres from above with [feed] and mass_flow"},
    Cannot{"heap repose angle_of_repose pile slump", "the angle of a heap is neither an input nor a result",
           "calibrate the friction with measured speeds ('vibrotrough theory calibrate')"},
    Cannot{"flake disc disk ellipsoid superquadric polyhedron plate cylinder fibre fiber needle",
           "superquadrics, polyhedra and flexible grains cannot be simulated",
           "write shape = \"cube\" or \"rod\", or a clump of spheres of your own as a .csv file"},
    Cannot{"bond break breakage fracture crush attrition", "grains that break cannot be simulated",
           "take YADE for bonded grains"},
    Cannot{"liquid moisture water humidity capillary bridge wet", "liquid bridges cannot be simulated",
           "take engine.cohesion as one number for all attraction, or MercuryDPM"},
    Cannot{"air gas fluid drag pressure fluidization wind",
           "air is not simulated; only the theory has a drag ('vibrotrough theory point')",
           "leave it out, and compare powders with a measurement"},
    Cannot{"heat temperature thermal charge electrostatic magnetic",
           "heat, charges and magnetic forces cannot be simulated", "leave it out"},
    Cannot{"wear erosion abrasion", "wear cannot be simulated: the trough keeps its shape", "leave it out"},
    Cannot{"spring stiffness_of_springs motor unbalance exciter machine_mass resonance damper",
           "a machine that gives way cannot be simulated: it follows the drive that is prescribed",
           "give amplitude and frequency under load, or a record as trough.waveform"},
    Cannot{"spiral helix bowl", "spirals and whole bowls cannot be simulated",
           "simulate a piece of the track as an inclined trough, or take Project Chrono"},
};

/// Whether a word stands in a key, alone or between '_' and '.'.
bool holds(std::string_view key, std::string_view word) {
    for (std::size_t at = key.find(word); at != key.npos; at = key.find(word, at + 1)) {
        std::size_t const end = at + word.size();
        bool const begins = at == 0 || std::string_view("_.-").find(key[at - 1]) != std::string_view::npos;
        bool const ends =
            end == key.size() || std::string_view("_.-s").find(key[end]) != std::string_view::npos;
        if (begins && ends) return true;
    }
    return false;
}

}  // namespace

Cannot const* cannot_simulate(std::string_view word) {
    for (Cannot const& one : requests)
        for (auto const part : std::views::split(one.words, ' '))
            if (holds(word, std::string_view(part.begin(), part.end()))) return &one;
    return nullptr;
}

}  // namespace vibrotrough::scenario
