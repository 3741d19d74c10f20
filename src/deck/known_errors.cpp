#include "deck/known_errors.hpp"

#include <array>
#include <cmath>

namespace vibrotrough::deck {
namespace {

// From validation/convergence/result.csv: each value minus that of 144 mm and 72 mm, half-widths
// combined in squares. A test compares them with that file.
constexpr std::array<KnownError, 3> lengths{{{1.0 / 8, 0.0273, 0.0155, "8 diameters"},
                                             {1.0 / 12, 0.0239, 0.0171, "12 diameters"},
                                             {1.0 / 24, -0.0067, 0.0181, "24 diameters"}}};
constexpr std::array<KnownError, 3> widths{{{1.0 / 5, 0.0222, 0.0134, "5 diameters"},
                                            {1.0 / 6, 0.0146, 0.0157, "6 diameters"},
                                            {1.0 / 12, 0.0125, 0.0134, "12 diameters"}}};

}  // namespace

std::span<KnownError const> known_length_errors() {
    return lengths;
}

std::span<KnownError const> known_width_errors() {
    return widths;
}

std::optional<KnownError> largest_known_error(std::span<KnownError const> errors, double measure) {
    constexpr double rounding = 2e-3;  // three digits in the table above
    std::optional<KnownError> largest;
    for (KnownError const& one : errors) {
        bool const applies = one.measure <= measure * (1 + rounding);
        bool const significant = std::abs(one.error) > one.half_width;
        if (applies && significant && (!largest || std::abs(one.error) > std::abs(largest->error)))
            largest = one;
    }
    return largest;
}

}  // namespace vibrotrough::deck
