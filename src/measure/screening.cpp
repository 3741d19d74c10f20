#include "measure/screening.hpp"

#include "measure/cycle_dump.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include <fmt/format.h>

namespace vibrotrough::measure {
namespace {

/// The index of the size that a grain has.
std::optional<std::size_t> size_of(double diameter, std::vector<double> const& diameters) {
    for (std::size_t i = 0; i < diameters.size(); ++i)
        if (is_same_size(diameter, diameters[i])) return i;
    return {};
}

double undersize_mass(Screening const& s, double opening) {
    double mass = 0;
    for (std::size_t i = 0; i < s.diameter.size() && s.diameter[i] < opening; ++i)
        mass += s.number[i] * s.mass[i];
    return mass;
}

double total_mass(Screening const& s) {
    return std::inner_product(s.number.begin(), s.number.end(), s.mass.begin(), 0.0);
}

}  // namespace

bool is_same_size(double diameter, double size) {
    constexpr double rounding = 1e-5;  // of a diameter: the engine writes six digits
    return std::abs(diameter - size) <= rounding * size;
}

std::vector<PassedGrain> parse_passed(std::vector<core::TextFile> const& files, int steps_per_cycle) {
    std::vector<PassedGrain> passed;
    std::set<long> known;
    for (DumpedGrain const& grain : parse_cycle_dumps(files, "passed", "id radius", steps_per_cycle)) {
        auto const id = static_cast<long>(grain.values[0]);
        if (known.insert(id).second) passed.push_back({grain.cycle, id, 2 * grain.values[1]});
    }
    return passed;
}

std::optional<std::string> size_imbalance(CycleSeries const& series, std::vector<PassedGrain> const& passed,
                                          std::vector<ScreenedSize> const& sizes) {
    constexpr double allowed = 1e-6;  // of a grain
    std::vector<double> diameters;
    double held = 0, held_mass = 0, largest = 0;
    for (ScreenedSize const& size : sizes) {
        diameters.push_back(size.diameter);
        held += size.number;
        held_mass += size.number * size.mass;
        largest = std::max(largest, size.mass);
    }
    std::vector<int> left(sizes.size());
    auto next = passed.begin();
    for (std::size_t cycle = 0; cycle < series.open.held.size(); ++cycle) {
        for (; next != passed.end() && next->cycle <= static_cast<int>(cycle); ++next) {
            auto const size = size_of(next->size, diameters);
            if (!size || ++left[*size] > sizes[*size].number)
                return fmt::format("grain {} of {:.6g} mm passed the screen in cycle {}, and there {} on it",
                                   next->id, 1e3 * next->size, next->cycle,
                                   size ? "were no more of this size" : "was none of this size");
            --held;
            held_mass -= sizes[*size].mass;
        }
        double const lost = held - series.open.held[cycle],
                     lost_mass = held_mass - series.open.held_mass[cycle];
        if (lost == 0 && std::abs(lost_mass) <= allowed * largest) continue;
        return fmt::format(
            "at the end of cycle {} there are {:g} grains of {:.6g} kg on the screen, and without those that "
            "passed it there should be {:g} of {:.6g} kg",
            cycle, series.open.held[cycle], series.open.held_mass[cycle], held, held_mass);
    }
    return {};
}

Screening screening(CycleSeries const& series, std::vector<PassedGrain> const& passed,
                    std::vector<ScreenedSize> sizes, double opening, double period) {
    std::ranges::sort(sizes, {}, &ScreenedSize::diameter);
    Screening s;
    for (ScreenedSize const& size : sizes) {
        s.diameter.push_back(size.diameter);
        s.number.push_back(size.number);
        s.mass.push_back(size.mass);
    }
    s.passed.resize(sizes.size());
    for (PassedGrain const& grain : passed) {
        auto const size = size_of(grain.size, s.diameter);
        if (!size || grain.cycle > series.cycles()) continue;
        ++s.passed[*size];
        s.passed_cycle.push_back(grain.cycle);
        s.passed_diameter.push_back(s.diameter[*size]);
    }
    double const first = total_mass(s),
                 gone = std::inner_product(s.passed.begin(), s.passed.end(), s.mass.begin(), 0.0);
    s.passed_share = gone / first;
    auto const curve = efficiency_curve(s, opening, series.cycles());
    if (!curve.empty()) s.efficiency = curve.back();
    if (gone < first * (1 - 1e-12))
        s.undersize = undersize_mass(s, opening) * (1 - s.efficiency.value_or(0)) / (first - gone);
    std::vector<double> shares;
    for (std::size_t i = 0; i < s.diameter.size(); ++i) shares.push_back(1 - s.passed[i] / s.number[i]);
    s.cut_size = cut_size(s.diameter, shares, opening);
    s.distance = period * std::accumulate(series.mean_velocity.begin(), series.mean_velocity.end(), 0.0);
    return s;
}

std::vector<double> share_curve(Screening const& s, std::size_t size, int cycles) {
    std::vector<double> gone(static_cast<std::size_t>(cycles) + 1);
    for (std::size_t i = 0; i < s.passed_cycle.size(); ++i) {
        auto const cycle = static_cast<std::size_t>(s.passed_cycle[i]);
        if (cycle < gone.size() && size_of(s.passed_diameter[i], s.diameter) == size) ++gone[cycle];
    }
    std::partial_sum(gone.begin(), gone.end(), gone.begin());
    for (double& count : gone) count = 1 - count / s.number[size];
    return gone;
}

std::vector<double> efficiency_curve(Screening const& s, double opening, int cycles) {
    double const all = undersize_mass(s, opening);
    if (all == 0) return {};
    std::vector<double> curve(static_cast<std::size_t>(cycles) + 1);
    for (std::size_t size = 0; size < s.diameter.size() && s.diameter[size] < opening; ++size) {
        auto const shares = share_curve(s, size, cycles);
        for (std::size_t k = 0; k < curve.size(); ++k)
            curve[k] += (1 - shares[k]) * s.number[size] * s.mass[size] / all;
    }
    return curve;
}

std::optional<double> cut_size(std::vector<double> const& diameters, std::vector<double> const& shares,
                               double opening) {
    constexpr double half = 0.5;
    std::optional<std::size_t> below;
    for (std::size_t i = 0; i < diameters.size(); ++i)
        if (shares[i] < half) below = i;
    if (!below || *below + 1 == diameters.size()) return {};
    std::size_t const next = *below + 1;
    bool const crosses = diameters[*below] < opening && opening <= diameters[next];
    double const above = crosses ? opening : diameters[next], share = crosses ? 1 : shares[next];
    double const d = diameters[*below];
    return d + (half - shares[*below]) / (share - shares[*below]) * (above - d);
}

std::optional<double> half_time(std::vector<double> const& shares, double period) {
    constexpr double half = 0.5;
    for (std::size_t k = 1; k < shares.size(); ++k) {
        if (shares[k] > half) continue;
        return (static_cast<double>(k) - (half - shares[k]) / (shares[k - 1] - shares[k])) * period;
    }
    return {};
}

}  // namespace vibrotrough::measure
