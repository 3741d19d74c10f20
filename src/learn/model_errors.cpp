#include "learn/model_errors.hpp"

#include <algorithm>
#include <array>

namespace vibrotrough::learn {
namespace {

// validation/model_errors/errors.csv: throw number, tan(alpha), depth, layers, sd. A test compares them with
// that file and prints the rows to be put here when they differ.
constexpr std::array<ModelError, 12> of_point_mass{{
    {{0.5, 1.25}, {-0.1, -0.02}, {2, 5}, 10, 0.018},
    {{0.5, 1.25}, {-0.02, 0.02}, {2, 5}, 2, 0.026},
    {{0.5, 1.25}, {0.02, 0.1}, {2, 5}, 10, 0.028},
    {{1.25, 1.75}, {-0.1, -0.02}, {2, 5}, 6, 0.039},
    {{1.25, 1.75}, {-0.02, 0.02}, {2, 5}, 9, 0.121},
    {{1.25, 1.75}, {0.02, 0.1}, {2, 5}, 6, 0.150},
    {{1.75, 2.1}, {-0.1, -0.02}, {2, 5}, 6, 0.157},
    {{1.75, 2.1}, {-0.02, 0.02}, {2, 5}, 6, 0.099},
    {{1.75, 2.1}, {0.02, 0.1}, {2, 5}, 6, 0.043},
    {{2.1, 3.0}, {-0.1, -0.02}, {2, 5}, 6, 0.023},
    {{2.1, 3.0}, {-0.02, 0.02}, {2, 5}, 10, 0.042},
    {{2.1, 3.0}, {0.02, 0.1}, {2, 5}, 6, 0.052},
}};
constexpr std::array<ModelError, 14> of_rolling_layer{{
    {{0.5, 1.25}, {-0.1, -0.02}, {2, 5}, 6, 0.119},
    {{0.5, 1.25}, {-0.02, 0.02}, {2, 5}, 5, 0.167},
    {{0.5, 1.25}, {0.02, 0.1}, {2, 5}, 8, 0.102},
    {{1.25, 1.75}, {-0.1, -0.02}, {2, 5}, 7, 0.085},
    {{1.25, 1.75}, {-0.02, 0.02}, {2, 5}, 21, 0.033},
    {{1.25, 1.75}, {-0.02, 0.02}, {5, 16}, 3, 0.062},
    {{1.25, 1.75}, {0.02, 0.1}, {2, 5}, 13, 0.047},
    {{1.75, 2.1}, {-0.1, -0.02}, {2, 5}, 7, 0.056},
    {{1.75, 2.1}, {-0.02, 0.02}, {2, 5}, 18, 0.036},
    {{1.75, 2.1}, {-0.02, 0.02}, {5, 16}, 3, 0.046},
    {{1.75, 2.1}, {0.02, 0.1}, {2, 5}, 7, 0.094},
    {{2.1, 3.0}, {-0.1, -0.02}, {2, 5}, 7, 0.125},
    {{2.1, 3.0}, {-0.02, 0.02}, {2, 5}, 7, 0.035},
    {{2.1, 3.0}, {0.02, 0.1}, {2, 5}, 7, 0.112},
}};

/// Whether a value lies in a region, whose upper end belongs to the next region if there is one.
bool contains(theory::Range const& range, double value, double end_of_all) {
    return value >= range.low && (value < range.high || (value == range.high && value == end_of_all));
}

template <class Part>
double most(std::span<ModelError const> errors, Part const& part) {
    double largest = 0;
    for (ModelError const& one : errors) largest = std::max(largest, part(one));
    return largest;
}

}  // namespace

std::span<ModelError const> point_mass_errors() {
    return of_point_mass;
}

std::span<ModelError const> rolling_layer_errors() {
    return of_rolling_layer;
}

ModelError const* known_row(std::span<ModelError const> errors, double throw_number, double tan_inclination,
                            std::optional<double> depth) {
    double const last_throw_number = largest_throw_number(errors);
    double const last_slope = most(errors, [](ModelError const& one) { return one.tan_inclination.high; });
    double const last_depth = most(errors, [](ModelError const& one) { return one.depth.high; });
    ModelError const* found = nullptr;
    for (ModelError const& one : errors) {
        bool const here = contains(one.throw_number, throw_number, last_throw_number) &&
                          contains(one.tan_inclination, tan_inclination, last_slope) &&
                          (!depth || contains(one.depth, *depth, last_depth));
        if (here && (found == nullptr || one.sd > found->sd)) found = &one;
    }
    return found;
}

std::optional<double> known_error(std::span<ModelError const> errors, double throw_number,
                                  double tan_inclination, std::optional<double> depth) {
    auto const* const row = known_row(errors, throw_number, tan_inclination, depth);
    return row != nullptr ? std::optional(row->sd) : std::nullopt;
}

double largest_error(std::span<ModelError const> errors) {
    return most(errors, [](ModelError const& one) { return one.sd; });
}

double largest_throw_number(std::span<ModelError const> errors) {
    return most(errors, [](ModelError const& one) { return one.throw_number.high; });
}

}  // namespace vibrotrough::learn
