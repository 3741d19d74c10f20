#include "theory/unusual.hpp"

#include <cmath>
#include <cstdio>
#include <numbers>

namespace vibrotrough::theory {
namespace {

constexpr double radian = 180 / std::numbers::pi;  // degrees
constexpr double largest_usual_frequency = 120;    // Hz; magnets at twice the mains' 60 Hz
constexpr double largest_usual_amplitude = 0.05;   // m
constexpr double largest_usual_friction = 1.5;     // of the mass on the trough
constexpr double smallest_usual_angle = 0.028;     // rad, 1.6 degrees: 90 degrees written in radians
// kg/m3: from foamed polystyrene to lead shot
constexpr double smallest_usual_bulk_density = 15, largest_usual_bulk_density = 7000;
constexpr double smallest_usual_grain_density = 30, largest_usual_grain_density = 12000;

/// Three digits, as in a sentence, and all of a whole number that has more.
std::string in_words(double value) {
    char text[32];
    std::snprintf(text, sizeof text, value >= 1000 && value < 1e7 ? "%.0f" : "%.3g", value);
    return text;
}

std::optional<UnusualNumber> unusual_turns(double turns) {
    bool const is_few = turns < 60 * smallest_usual_frequency;
    if (!is_few && turns <= 60 * largest_usual_frequency) return {};
    std::string slip = is_few ? "" : "is there a digit too many?";
    if (is_few && turns >= smallest_usual_frequency) slip = "were " + in_words(turns) + " Hz meant, not rpm?";
    double const limit = 60 * (is_few ? smallest_usual_frequency : largest_usual_frequency);
    return UnusualNumber{UnusualQuantity::frequency,
                         "speed of the drive",
                         turns,
                         limit,
                         "1/min",
                         "vibrating troughs have 60 to 7200",
                         slip};
}

std::optional<UnusualNumber> unusual_frequency(double frequency) {
    bool const is_slow = frequency < smallest_usual_frequency;
    if (!is_slow && frequency <= largest_usual_frequency) return {};
    std::string slip;
    if (is_slow && 60 * frequency >= smallest_usual_frequency)
        slip = "were " + in_words(60 * frequency) + " Hz meant, not rpm?";
    else if (!is_slow && frequency <= 60 * largest_usual_frequency)
        slip = "were " + in_words(frequency) + " turns per minute meant (rpm)?";
    double const limit = is_slow ? smallest_usual_frequency : largest_usual_frequency;
    return UnusualNumber{UnusualQuantity::frequency,
                         "frequency",
                         frequency,
                         limit,
                         "Hz",
                         "vibrating troughs run at 1 to 120 Hz",
                         slip};
}

std::optional<UnusualNumber> unusual_amplitude(double amplitude, bool is_stroke) {
    if (amplitude <= largest_usual_amplitude) return {};
    double const factor = is_stroke ? 2000 : 1000;
    return UnusualNumber{UnusualQuantity::amplitude,
                         is_stroke ? "stroke" : "amplitude",
                         factor * amplitude,
                         factor * largest_usual_amplitude,
                         "mm",
                         "strokes, which are twice the amplitude, are mostly below 30 mm",
                         "were mm meant, not m?"};
}

std::optional<UnusualNumber> unusual_machine_number(double machine_number, bool is_stroke) {
    if (machine_number <= largest_usual_machine_number) return {};
    return UnusualNumber{UnusualQuantity::machine_number,
                         "machine number",
                         machine_number,
                         largest_usual_machine_number,
                         "1",
                         "troughs bear 3 to 6 times gravity",
                         is_stroke ? "are stroke and speed of the drive those of one machine?"
                                   : "was the stroke given as the amplitude, which is half of it?"};
}

/// The first of frequency, amplitude and machine number that is unusual: it explains those after it.
std::optional<UnusualNumber> unusual_drive(MachineNumbers const& n) {
    if (n.frequency)
        if (auto found = n.is_turns ? unusual_turns(60 * *n.frequency) : unusual_frequency(*n.frequency))
            return found;
    if (n.amplitude)
        if (auto found = unusual_amplitude(*n.amplitude, n.is_stroke)) return found;
    if (n.machine_number) return unusual_machine_number(*n.machine_number, n.is_stroke);
    return {};
}

std::optional<UnusualNumber> unusual_angle(MachineNumbers const& n) {
    if (!n.vibration_angle || *n.vibration_angle <= 0 || *n.vibration_angle >= smallest_usual_angle)
        return {};
    double const degrees = *n.vibration_angle * radian, in_radians = degrees * radian;
    return UnusualNumber{UnusualQuantity::vibration_angle,
                         "vibration angle",
                         degrees,
                         smallest_usual_angle * radian,
                         "deg",
                         "20 to 45 are usual",
                         in_radians < 1 ? "" : "were radians meant (" + in_words(in_radians) + " degrees)?"};
}

std::optional<UnusualNumber> unusual_friction(MachineNumbers const& n) {
    if (!n.friction || *n.friction <= largest_usual_friction) return {};
    return UnusualNumber{UnusualQuantity::friction,    "friction", *n.friction,
                         largest_usual_friction,       "1",        "it is mostly 0.1 to 1",
                         slip_of_friction(*n.friction)};
}

std::optional<UnusualNumber> unusual_density(UnusualQuantity quantity, std::optional<double> density) {
    bool const is_bulk = quantity == UnusualQuantity::bulk_density;
    double const least = is_bulk ? smallest_usual_bulk_density : smallest_usual_grain_density;
    double const most = is_bulk ? largest_usual_bulk_density : largest_usual_grain_density;
    if (!density || (*density >= least && *density <= most)) return {};
    bool const is_light = *density < least;
    double const in_tonnes = 1000 * *density;
    return UnusualNumber{quantity,
                         is_bulk ? "bulk density" : "density of the grains",
                         *density,
                         is_light ? least : most,
                         "kg/m3",
                         is_bulk ? "most layers have 100 to 3000" : "most grains have 500 to 8000",
                         !is_light || in_tonnes < least ? ""
                                                        : "were " + in_words(*density) + " t/m3 meant (" +
                                                              in_words(in_tonnes) + " kg/m3)?"};
}

}  // namespace

std::string UnusualNumber::sentence() const {
    std::string const article = name.starts_with('a') ? "an " : "a ";
    std::string const coefficient = quantity == UnusualQuantity::friction ? " coefficient" : "";
    std::string const in_unit = unit == "1" ? "" : unit == "deg" ? " degrees" : " " + unit;
    return article + name + coefficient + " of " + in_words(value) + in_unit + " is unusual: " + usual +
           (slip.empty() ? "" : "; " + slip);
}

std::string slip_of_friction(double friction) {
    if (!(friction >= 5)) return "";
    if (friction >= 90) return "was a percentage meant?";
    return "was an angle of friction meant (its tangent is " + in_words(std::tan(friction / radian)) +
           "), or " + in_words(friction) + " %?";
}

std::string slip_of_tangent(double tangent) {
    if (!(std::abs(tangent) < 90)) return "";
    return "was an angle of " + in_words(tangent) + " degrees meant (its tangent is " +
           in_words(std::tan(tangent / radian)) + ")?";
}

std::vector<UnusualNumber> find_unusual(MachineNumbers const& n) {
    std::vector<UnusualNumber> found;
    using enum UnusualQuantity;
    for (auto const& one :
         {unusual_drive(n), unusual_angle(n), unusual_friction(n),
          unusual_density(bulk_density, n.bulk_density), unusual_density(grain_density, n.grain_density)})
        if (one) found.push_back(*one);
    return found;
}

std::vector<std::string> unusual_numbers(MachineNumbers const& n) {
    std::vector<std::string> sentences;
    for (UnusualNumber const& one : find_unusual(n)) sentences.push_back(one.sentence());
    return sentences;
}

}  // namespace vibrotrough::theory
