#include "theory/unusual.hpp"

#include <cmath>
#include <cstdio>
#include <numbers>

namespace vibrotrough::theory {
namespace {

/// Three digits, as in a sentence.
std::string in_words(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

}  // namespace

std::vector<std::string> unusual_numbers(MachineNumbers const& n) {
    std::vector<std::string> sentences;
    bool const drive_is_explained = [&] {
        if (n.frequency && *n.frequency > largest_usual_frequency) {
            sentences.push_back("a frequency of " + in_words(*n.frequency) +
                                " Hz is unusual: vibrating troughs run at 1 to 120 Hz; were " +
                                in_words(*n.frequency) + " turns per minute meant (rpm)?");
            return true;
        }
        if (n.frequency && *n.frequency < smallest_usual_frequency) {
            sentences.push_back("a frequency of " + in_words(*n.frequency) +
                                " Hz is unusual: vibrating troughs run at 1 to 120 Hz; were " +
                                in_words(60 * *n.frequency) + " Hz meant, not rpm?");
            return true;
        }
        if (n.amplitude && *n.amplitude > largest_usual_amplitude) {
            sentences.push_back("an amplitude of " + in_words(1000 * *n.amplitude) +
                                " mm is unusual: strokes, which are twice the amplitude, are mostly below "
                                "30 mm; were mm meant, not m?");
            return true;
        }
        return false;
    }();
    if (!drive_is_explained && n.machine_number && *n.machine_number > largest_usual_machine_number)
        sentences.push_back("a machine number of " + in_words(*n.machine_number) +
                            " is unusual: troughs bear 3 to 6 times gravity; was the stroke given as the "
                            "amplitude, which is half of it?");
    if (n.friction && *n.friction > largest_usual_friction)
        sentences.push_back("a friction coefficient of " + in_words(*n.friction) +
                            " is unusual: it is mostly 0.1 to 1; was " +
                            (*n.friction < 90 ? "an angle of friction meant (its tangent is " +
                                                    in_words(std::tan(*n.friction * std::numbers::pi / 180)) +
                                                    "), or " + in_words(*n.friction) + " %?"
                                              : "a percentage meant?"));
    return sentences;
}

}  // namespace vibrotrough::theory
