#include "scenario/reader/key_fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace vibrotrough::scenario {
namespace {

using enum KeyKind;
using enum KeyNeed;

std::optional<Content> frame_packings_of(Scenario const& s) {
    std::vector<int> const& packings = s.output.frame_packings;
    if (packings.empty()) return Content(std::string("all"));
    return Content(std::vector<double>(packings.begin(), packings.end()));
}

void set_frame_packings(Scenario& s, GivenValue const& v) {
    s.output.frame_packings.clear();
    if (v.is_word()) return;  // all
    for (double const number : v.numbers())
        s.output.frame_packings.push_back(static_cast<int>(std::lround(number)));
}

bool lists_frame_packings(Scenario const& s) {
    return s.output.frames_per_cycle != 0 && s.output.frame_packings != std::vector<int>{1};
}

void set_templates(Scenario& s, GivenValue const& v) {
    std::vector<std::string> names = v.words();
    std::ranges::sort(names);
    for (std::string const& name : names)
        if (!is_template_name(name) || std::ranges::count(names, name) > 1)
            v.fail(fmt::format("'{}' is not the name of a template, or is listed twice", name),
                   "write names without a path, such as \"contact.mustache\"");
    s.engine.templates = read_once(
        v.files_read().templates, v, names,
        [](std::vector<NamedFile> files) {
            return std::make_shared<DeckTemplates const>(DeckTemplates{std::move(files)});
        },
        "");
}

std::optional<Content> templates_of(Scenario const& s) {
    std::vector<std::string> names;
    if (s.engine.templates) {
        for (NamedFile const& file : s.engine.templates->files) names.push_back(file.name);
    }
    return content_of(names);
}

/// Otherwise the stages of a drive or the time on a screen say how long a run is.
bool has_open_length(Scenario const& s) {
    return !has_given_length(s);
}

constexpr std::array rows_of_plans{
    Key{"measure.packings", integer, "", 1, 1000, "", "", 3.0, "3",
        "least number of independent packings per case; more are added until the case's interval is narrow "
        "enough",
        field<&Scenario::measure, &MeasurementPlan::packings>},
    Key{"measure.confidence", number, "", 0.5, 0.9999, "", "", 0.95, "0.95",
        "confidence level of every interval", field<&Scenario::measure, &MeasurementPlan::confidence>},
    Key{"measure.half_width", number, "", 1e-5, 1, "0.00001 to 1", "", 0.05, "0.05",
        "half-width of the case's velocity efficiency that is wanted, for statistics and numerics together",
        field<&Scenario::measure, &MeasurementPlan::half_width>},
    Key{"measure.max_cycles", integer, "", 20, 1e6, "20 to 1000000", "", 200.0, "200",
        "largest number of cycles of a packing",
        field<&Scenario::measure, &MeasurementPlan::max_cycles>.written_if(has_open_length)},
    Key{"measure.min_cycles", integer, "", 1, 1e6, "1 to 1000000", "", optional, "100",
        "least number of cycles of a packing, for what takes longer than the conveying speed to settle, such "
        "as "
        "the segregation of a mixture; at most measure.max_cycles",
        field<&Scenario::measure, &MeasurementPlan::min_cycles>},
    Key{"measure.max_packings", integer, "", 1, 1000, "", "", 24.0, "24",
        "largest number of packings per case; at least measure.packings",
        field<&Scenario::measure, &MeasurementPlan::max_packings>.written_if(has_open_length)},
    Key{"measure.max_core_time", quantity, "s", 1, 1e12, "at least 1 s", "", optional, "\"2 hours\"",
        "largest core time that one case may take: when more would be needed, it ends as not-precise",
        field<&Scenario::measure, &MeasurementPlan::max_core_time>},

    Key{"output.frames_per_cycle", integer, "", 0, 1000, "", "", 0.0, "0",
        "frames per cycle that the first packing writes for ParaView; 0 writes none",
        field<&Scenario::output, &OutputPlan::frames_per_cycle>},
    Key{"output.checkpoint_cycles", integer, "", 0, 1e6, "0 to 1000000", "", 50.0, "50",
        "cycles between two checkpoints, from which an interrupted run continues; 0 writes none",
        field<&Scenario::output, &OutputPlan::checkpoint_cycles>},
    Key{"output.frame_packings", packings, "", 1, 1000, "numbers from 1 to 1000, or \"all\"", "", optional,
        "[1, 2]", "packings that write the frames, by their numbers; without it, the first one",
        KeyAccess{frame_packings_of, set_frame_packings, lists_frame_packings}},
    Key{"output.contacts", truth, "", 0, 1, "true or false", "", 0.0, "true",
        "also write the contacts between grains and with the trough into the frames, with their forces; for "
        "layers of spheres",
        field<&Scenario::output, &OutputPlan::contacts>.written_if(
            [](Scenario const& s) { return s.output.contacts && s.output.frames_per_cycle != 0; })},

    Key{"solver.rayleigh_fraction", number, "", 0.01, 0.5, "", "", 0.2, "0.2",
        "largest time step, as a fraction of the Rayleigh time of the smallest grain",
        field<&Scenario::solver, &SolverPlan::rayleigh_fraction>},
    Key{"solver.softness", number, "", 0.005, 0.3, "", "", 0.079, "0.05",
        "how soft grains without grains.youngs_modulus may be: the angle (rad) by which the trough moves on "
        "while its landing crosses the layer. All cases of a campaign get the same modulus, the lowest one "
        "with which none is softer. The error of the velocity efficiency goes with its square, the cost with "
        "its power of -1.5",
        field<&Scenario::solver, &SolverPlan::softness>.unless_default()},
    Key{"solver.block_stiffness", number, "", 30, 10000, "", "", 300.0, "300",
        "duration of a cycle divided by the duration of a block's contact",
        field<&Scenario::solver, &SolverPlan::block_stiffness>},

    Key{"engine.contact", choice, "", 0, 0, Allowed(contact_words), "", optional, "\"hooke\"",
        contact_meaning, field<&Scenario::engine, &EnginePlan::contact>.unless_default()},
    Key{"engine.cohesion", quantity, "J/m3", 0, 1e9, "0 to 1e9 J/m3", "", 0.0, "\"50 kJ/m3\"",
        "energy density of the cohesion model sjkr: grains and trough attract each other with this pressure "
        "times the area of their contact",
        field<&Scenario::engine, &EnginePlan::cohesion>.unless_default()},
    Key{"engine.tangential_damping", truth, "", 0, 1, "true or false", "", 0.0, "true",
        "damping of the tangential spring of a contact, added to Coulomb's limit. An impact at an angle then "
        "keeps more of its speed along the trough; six layers had an efficiency higher by 0.002 +- 0.006 in "
        "the mean (validation/history)",
        field<&Scenario::engine, &EnginePlan::tangential_damping>.unless_default()},
    Key{"engine.templates", texts, "", 0, 0, "1 to 30 names of .mustache files in the same folder", "",
        optional, "[\"contact.mustache\"]",
        "templates of the decks that replace those of input_templates; their commands can do anything, so "
        "that "
        "'run' refuses unless --allow-extra is given. "
        "'run --templates DIR' takes them from a folder instead",
        KeyAccess{templates_of, set_templates}},
};

}  // namespace

std::span<Key const> plan_keys() {
    return rows_of_plans;
}

}  // namespace vibrotrough::scenario
