#include "deck/deck.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "deck/phases.hpp"
#include "deck/templates.hpp"
#include "deck/trough_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <vector>

#include <boost/math/special_functions/prime.hpp>
#include <fmt/format.h>
#include <kainjow/mustache.hpp>

namespace vibrotrough::deck {
namespace {

namespace mustache = kainjow::mustache;
constexpr double pi = std::numbers::pi;

struct SizeClass {
    double diameter;
    int count;
};

/// Largest first, so that the big ones find room; counts equal within one, a single grain is of the middle
/// size.
std::vector<SizeClass> size_classes(Grains const& grains, int count) {
    if (grains.diameter_spread == 0) return {{grains.diameter, count}};
    std::vector<SizeClass> classes;
    int const remainder = count % 3;
    for (int const i : {0, 1, 2}) {
        // One grain over goes to the middle class, two to the others: the mean stays the mean.
        bool const takes_one = remainder == 1 ? i == 1 : remainder == 2 && i != 1;
        int const share = count / 3 + (takes_one ? 1 : 0);
        if (share > 0) classes.push_back({grains.diameter * (1 + (1 - i) * grains.diameter_spread), share});
    }
    return classes;
}

double grain_mass(Grains const& grains, double diameter) {
    return grains.density * pi / 6 * std::pow(diameter, 3);
}

double layer_mass(Scenario const& scenario) {
    double mass = 0;
    for (SizeClass const& size : size_classes(scenario.grains, scenario.layer.grains)) {
        mass += size.count * grain_mass(scenario.grains, size.diameter);
    }
    return mass;
}

// The engine's random seeds must be primes above 10000; boost counts primes from 0: prime(1229) = 10007.
int seed_number(int index) {
    return static_cast<int>(boost::math::prime(static_cast<unsigned>(1229 + index)));
}

/// The engine's mover sums A omega cos(omega t) dt and is off by A pi / n: 0.6 % at 500 steps per cycle.
constexpr double fewest_steps = 500;
constexpr double most_steps = 1e8;

std::string text(double number) {
    return fmt::format("{}", number);
}

std::string rounded(double number) {
    return fmt::format("{:.6g}", number);
}

mustache::list describe_classes(Scenario const& scenario, int packing) {
    mustache::list list;
    int index = 0;
    int so_far = 0;  // insert/pack fills the region up to a number; it counts what is there already
    for (SizeClass const& size : size_classes(scenario.grains, scenario.layer.grains)) {
        mustache::data entry;
        entry.set("index", std::to_string(index + 1));
        entry.set("diameter", text(size.diameter));
        entry.set("radius", text(size.diameter / 2));
        entry.set("count", std::to_string(size.count));
        so_far += size.count;
        entry.set("count_so_far", std::to_string(so_far));
        entry.set("insertion_seed", std::to_string(seed_number(3 * (packing - 1) + index)));
        entry.set("template_seed", std::to_string(seed_number(4000 + index)));
        entry.set("distribution_seed", std::to_string(seed_number(4010 + index)));
        list.push_back(entry);
        ++index;
    }
    return list;
}

void describe_inputs(mustache::data& data, Scenario const& s) {
    double const degrees = 180 / pi;
    data.set("inclination_deg", rounded(s.trough.inclination * degrees));
    data.set("vibration_angle_deg", rounded(s.trough.vibration_angle * degrees));
    data.set("amplitude", text(s.trough.amplitude));
    data.set("frequency", text(s.trough.frequency));
    data.set("throw_number", rounded(throw_number(s.trough)));
    data.set("machine_number", rounded(machine_number(s.trough)));
    data.set("trough_friction", text(s.trough.friction));
    data.set("trough_restitution", text(s.trough.restitution));
    data.set("grains", std::to_string(s.layer.grains));
    data.set("density", text(s.grains.density));
    data.set("youngs_modulus", text(s.grains.youngs_modulus));
    data.set("soft", s.grains.youngs_modulus < 5e6);  // LIGGGHTS asks for a word of consent below 5 MPa
    data.set("poisson_ratio", text(s.grains.poisson_ratio));
    data.set("grain_friction", text(s.grains.friction));
    data.set("grain_restitution", text(s.grains.restitution));
    data.set("rolling_friction", text(s.grains.rolling_friction));
    data.set("rolls", s.grains.rolling_friction > 0);
    data.set("rolling_model", s.grains.rolling_friction > 0 ? " rolling_friction epsd2" : "");
    data.set("length", text(s.layer.length));
    data.set("width", text(s.layer.width));
    data.set("max_cycles", std::to_string(s.measure.max_cycles));
    data.set("gravity", text(gravity));
    data.set("gravity_x", text(0 - std::sin(s.trough.inclination)));
    data.set("gravity_z", text(-std::cos(s.trough.inclination)));
    data.set("amplitude_x", text(s.trough.amplitude * std::cos(s.trough.vibration_angle)));
    data.set("amplitude_z", text(s.trough.amplitude * std::sin(s.trough.vibration_angle)));
}

void describe_time(mustache::data& data, Scenario const& s, TimeGrid const& time) {
    data.set("time_step", text(time.time_step));
    data.set("steps_per_cycle", std::to_string(time.steps_per_cycle));
    // The engine's own period is a whole number of its own steps.
    data.set("period", text(time.time_step * time.steps_per_cycle));
    data.set("rayleigh_percent", fmt::format("{:.3g}", 100 * time.rayleigh_fraction));
    data.set("hertz_percent", fmt::format("{:.3g}", 100 * time.hertz_fraction));
    data.set("impact_speed", fmt::format("{:.3g}", time.impact_speed));
    data.set("frames", s.output.frames_per_cycle > 0);
    if (s.output.frames_per_cycle > 0) {
        data.set("frame_steps", std::to_string(time.steps_per_cycle / s.output.frames_per_cycle));
    }
}

/// Where the grains are poured from, how long that may take, and how high they may fly.
void describe_space(mustache::data& data, Scenario const& s, TimeGrid const& time) {
    double const diameter = s.grains.diameter;
    double const largest = diameter * (1 + s.grains.diameter_spread);
    // Poured loosely: at a solid fraction of 0.2 random insertion always finds room.
    double const fill_bottom = 0.6 * largest;
    double const volume = layer_mass(s) / s.grains.density;
    double const fill_top = fill_bottom + largest + volume / (0.2 * s.layer.length * s.layer.width);
    double const fall_time = std::sqrt(2 * fill_top / gravity);
    double const chunk_time = std::sqrt(diameter / gravity);
    // A grain at ten times the height that the trough's largest speed throws it to is still in the box.
    double const speed = angular_frequency(s.trough) * s.trough.amplitude;
    double const flight = speed * speed / (2 * gravity * std::cos(s.trough.inclination));
    double const mean_mass = layer_mass(s) / s.layer.grains;
    data.set("bottom", text(-2 * (s.trough.amplitude + largest)));
    data.set("top", text(fill_top + 10 * flight + 20 * largest));
    data.set("skin", text(0.3 * diameter));
    data.set("fill_bottom", text(fill_bottom));
    data.set("fill_top", text(fill_top));
    data.set("fill_speed", rounded(0.5 * std::sqrt(gravity * diameter)));
    data.set("settle_chunk", std::to_string(std::max(1L, std::lround(chunk_time / time.time_step))));
    data.set("settle_chunks", std::to_string(static_cast<int>(20 * fall_time / chunk_time) + 200));
    data.set("settle_drag", rounded(mean_mass / (3 * chunk_time)));
    data.set("settled_energy", rounded(1e-7 * layer_mass(s) * gravity * diameter));
}

std::string render(mustache::data& data) {
    for (auto const& [name, content] : input_templates) {
        if (name == "in.liggghts") continue;
        data.set(std::string(name), mustache::partial([content = std::string(content)] { return content; }));
    }
    mustache::mustache deck{std::string(input_templates.at("in.liggghts"))};
    std::string const result = deck.render(data);
    if (!deck.is_valid()) throw std::logic_error("input_templates: " + deck.error_message());
    return result;
}

}  // namespace

TimeGrid choose_time_step(Scenario const& s) {
    double const radius = s.grains.diameter * (1 - s.grains.diameter_spread) / 2;
    double const nu = s.grains.poisson_ratio;
    double const shear_modulus = s.grains.youngs_modulus / (2 * (1 + nu));
    double const rayleigh =
        pi * radius * std::sqrt(s.grains.density / shear_modulus) / (0.1631 * nu + 0.8766);

    double const speed = 2 * angular_frequency(s.trough) * s.trough.amplitude;
    double const mass = grain_mass(s.grains, 2 * radius) / 2;              // m* of two equal grains
    double const modulus = s.grains.youngs_modulus / (2 * (1 - nu * nu));  // E* of two equal grains
    double const hertz = 2.87 * std::pow(mass * mass / (radius / 2 * modulus * modulus * speed), 0.2);

    double const period = 1 / s.trough.frequency;
    int const multiple = std::lcm(samples_per_cycle, std::max(1, s.output.frames_per_cycle));
    double const longest = std::min({0.2 * rayleigh, 0.1 * hertz, period / fewest_steps});
    double const steps = std::ceil(period / longest / multiple) * multiple;
    if (steps > most_steps) {
        throw InputError(
            fmt::format("a cycle of {:.3g} s would take {:.3g} steps of {:.3g} s, more than {:.0g}; make the "
                        "grains larger or softer "
                        "(grains.diameter, grains.youngs_modulus) or the trough faster",
                        period, steps, period / steps, most_steps));
    }
    double const time_step = period / steps;
    return {time_step, static_cast<int>(steps), time_step / rayleigh, time_step / hertz, speed};
}

Deck make_deck(Scenario const& scenario, int packing) {
    if (packing < 1 || packing > 1000)
        throw std::invalid_argument(fmt::format("no packing number {}", packing));
    Deck deck;
    deck.time = choose_time_step(scenario);
    deck.seed = seed_number(3 * (packing - 1));
    deck.mass = layer_mass(scenario);
    deck.weight = deck.mass * gravity * std::cos(scenario.trough.inclination);

    Scenario shown = scenario;
    if (packing > 1) shown.output.frames_per_cycle = 0;  // frames show the first packing
    mustache::data data;
    mustache::list const classes = describe_classes(scenario, packing);
    data.set("title", fmt::format("Vibrotrough: a granular layer on a vibrating trough, campaign {}",
                                  scenario.campaign));
    data.set("class_count", std::to_string(classes.size()));
    data.set("classes", classes);
    data.set("packing_number", std::to_string(packing));
    data.set("seed", std::to_string(deck.seed));
    describe_inputs(data, scenario);
    describe_time(data, shown, deck.time);
    describe_space(data, scenario, deck.time);
    for (auto const& [name, value] : phase_sampling(scenario, deck.time)) data.set(name, value);
    deck.files["in.liggghts"] = render(data);
    deck.files["trough.stl"] =
        flat_trough_stl(scenario.layer.length, scenario.layer.width, 3 * scenario.grains.diameter);
    deck.files[control_file] = control_go_on;
    return deck;
}

void write_deck(Deck const& deck, std::filesystem::path const& folder) {
    make_folder(folder / "dump");
    for (auto const& [name, content] : deck.files) write_file_atomically(folder / name, content);
}

}  // namespace vibrotrough::deck
