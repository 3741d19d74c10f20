#include "theory/unusual.hpp"

#include <cmath>
#include <cstdio>
#include <numbers>

namespace vibrotrough::theory {
namespace {

/// Three digits, as in a sentence, and all of a whole number that has more.
std::string in_words(double value) {
    char text[32];
    std::snprintf(text, sizeof text, value >= 1000 && value < 1e7 ? "%.0f" : "%.3g", value);
    return text;
}

std::string unusual_frequency(MachineNumbers const& n) {
    double const f = *n.frequency;
    std::string const usual = " is unusual: vibrating troughs run at 1 to 120 Hz; ";
    std::string const told =
        n.is_turns ? in_words(60 * f) + " turns per minute" : "a frequency of " + in_words(f) + " Hz";
    std::string const verb = n.is_turns ? " are unusual: vibrating troughs have 60 to 7200; " : usual;
    if (f > largest_usual_frequency)
        return told + verb +
               (n.is_turns ? "is there a digit too many?"
                           : "were " + in_words(f) + " turns per minute meant (rpm)?");
    if (f < smallest_usual_frequency) return told + verb + "were " + in_words(60 * f) + " Hz meant, not rpm?";
    return "";
}

/// The first of frequency, amplitude and machine number that is unusual: it explains those after it.
std::string unusual_drive(MachineNumbers const& n) {
    if (n.frequency) {
        std::string sentence = unusual_frequency(n);
        if (!sentence.empty()) return sentence;
    }
    if (n.amplitude && *n.amplitude > largest_usual_amplitude)
        return (n.is_stroke ? "a stroke of " + in_words(2000 * *n.amplitude)
                            : "an amplitude of " + in_words(1000 * *n.amplitude)) +
               " mm is unusual: strokes, which are twice the amplitude, are mostly below 30 mm; were mm "
               "meant, not m?";
    if (n.machine_number && *n.machine_number > largest_usual_machine_number)
        return "a machine number of " + in_words(*n.machine_number) +
               " is unusual: troughs bear 3 to 6 times gravity; " +
               (n.is_stroke ? "are stroke and speed of the drive those of one machine?"
                            : "was the stroke given as the amplitude, which is half of it?");
    return "";
}

std::string unusual_angle(MachineNumbers const& n) {
    if (!n.vibration_angle || *n.vibration_angle <= 0 || *n.vibration_angle >= smallest_usual_angle)
        return "";
    double const degrees = *n.vibration_angle * 180 / std::numbers::pi;
    return "a vibration angle of " + in_words(degrees) +
           " degrees is unusual: 20 to 45 are usual; were radians meant (" +
           in_words(degrees * 180 / std::numbers::pi) + " degrees)?";
}

/// Only slips that lead to a usual friction are offered.
std::string unusual_friction(MachineNumbers const& n) {
    if (!n.friction || *n.friction <= largest_usual_friction) return "";
    std::string const told =
        "a friction coefficient of " + in_words(*n.friction) + " is unusual: it is mostly 0.1 to 1";
    double const tangent = std::tan(*n.friction * std::numbers::pi / 180);
    if (*n.friction >= 90) return told + "; was a percentage meant?";
    if (*n.friction < 5) return told;
    return told + "; was an angle of friction meant (its tangent is " + in_words(tangent) + "), or " +
           in_words(*n.friction) + " %?";
}

}  // namespace

std::vector<std::string> unusual_numbers(MachineNumbers const& n) {
    std::vector<std::string> sentences;
    for (std::string const& sentence : {unusual_drive(n), unusual_angle(n), unusual_friction(n)})
        if (!sentence.empty()) sentences.push_back(sentence);
    return sentences;
}

}  // namespace vibrotrough::theory
