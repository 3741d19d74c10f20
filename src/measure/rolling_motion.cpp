#include "measure/rolling_motion.hpp"

#include "core/error.hpp"
#include "measure/constants.hpp"
#include "measure/table_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

namespace vibrotrough::measure {
namespace {

using Values = std::vector<double>;
constexpr std::size_t phases_per_cycle = PhaseSeries::per_cycle;

/// Sums of one column at each phase.
using PhaseSums = std::array<double, phases_per_cycle>;

/// Sums over the lines that are looked at, phase by phase.
class Folder {
  public:
    Folder(RollingSeries const& series, RollingFacts const& facts)
        : series_(series),
          first_(static_cast<std::size_t>(std::max(facts.discarded, 1)) * phases_per_cycle),
          end_(static_cast<std::size_t>(std::max(facts.used, 0)) * phases_per_cycle) {
        count_ = over_lines([](std::size_t, std::size_t) { return 1.0; });
    }

    /// Over the lines of rolling.csv.
    PhaseSums of(Values const& column) const {
        return over_lines([&column](std::size_t line, std::size_t) { return column[line]; });
    }

    /// Of a column of phases.csv over the lines that rolling.csv has, too.
    PhaseSums of_same_lines(Values const& column) const {
        return over_lines([&column](std::size_t, std::size_t hundredth) { return column[hundredth]; });
    }

    /// Of a column of phases.csv over all its lines.
    PhaseSums of_all_lines(Values const& column) const {
        PhaseSums sums{};
        for (std::size_t i = first_; i < end_; ++i) sums[i % phases_per_cycle] += column[i];
        return sums;
    }

    /// The mean over the lines.
    Values mean(Values const& column, double unit = 1) const {
        Values values;
        PhaseSums const sums = of(column);
        for (std::size_t j = 0; j < phases_per_cycle; ++j)
            values.push_back(count_[j] > 0 ? sums[j] / (count_[j] * unit) : gap);
        return values;
    }

    /// Number of cycles at each phase of phases.csv.
    double cycles() const { return static_cast<double>((end_ - first_) / phases_per_cycle); }

  private:
    template <typename Value>
    PhaseSums over_lines(Value const& value) const {
        PhaseSums sums{};
        for (std::size_t line = 0; line < series_.lines(); ++line) {
            std::size_t const hundredth = RollingSeries::stride * (line + 1) - 1;
            if (hundredth < first_ || hundredth >= end_) continue;
            sums[hundredth % phases_per_cycle] += value(line, hundredth);
        }
        return sums;
    }

    RollingSeries const& series_;
    std::size_t first_, end_;
    PhaseSums count_{};
};

Values ratio(PhaseSums const& above, PhaseSums const& below) {
    Values values;
    for (std::size_t j = 0; j < phases_per_cycle; ++j)
        values.push_back(below[j] > 0 ? above[j] / below[j] : gap);
    return values;
}

Values less(Values const& from, Values const& values) {
    Values left;
    for (std::size_t j = 0; j < from.size(); ++j) left.push_back(from[j] - values[j]);
    return left;
}

void add_grains(RollingCurves& curves, Folder const& fold, RollingSeries const& s, PhaseSeries const& phases,
                Values const& trough) {
    PhaseSums const touching = fold.of_all_lines(phases.touching);
    for (double const number : touching) curves.floor_grains.push_back(number / fold.cycles());
    curves.floor_velocity = less(ratio(fold.of_all_lines(phases.touching_vx), touching), trough);
    curves.floor_spin = ratio(fold.of_all_lines(phases.touching_spin), touching);
    curves.floor_slip = less(curves.floor_velocity, curves.floor_spin);
    curves.first_grains = fold.mean(s.first);
    curves.first_velocity = less(ratio(fold.of(s.first_vx), fold.of(s.first)), trough);
    curves.first_spin = ratio(fold.of(s.first_spin), fold.of(s.first));
    curves.second_grains = fold.mean(s.second);
    curves.second_velocity = less(ratio(fold.of(s.second_vx), fold.of(s.second)), trough);
    curves.second_spin = ratio(fold.of(s.second_spin), fold.of(s.second));
}

std::optional<double> mean_of_known(Values const& curve) {
    double sum = 0;
    int known = 0;
    for (double const value : curve) {
        if (!std::isfinite(value)) continue;
        sum += value;
        ++known;
    }
    if (known == 0) return {};
    return sum / known;
}

void check_length(RollingSeries const& series, PhaseSeries const& phases, RollingFacts const& facts) {
    std::size_t const hundredths = static_cast<std::size_t>(std::max(facts.used, 0)) * phases_per_cycle;
    if (phases.lines() >= hundredths && series.lines() >= hundredths / RollingSeries::stride) return;
    throw core::InputError(fmt::format("rolling.csv holds {} lines and should hold {} for {} cycles",
                                       series.lines(), hundredths / RollingSeries::stride, facts.used));
}

}  // namespace

RollingSeries parse_rolling(core::TextFile const& file, int steps_per_cycle) {
    if (steps_per_cycle % PhaseSeries::per_cycle != 0)
        throw std::invalid_argument("the steps per cycle are not a multiple of the lines per cycle");
    int const distance = RollingSeries::stride * (steps_per_cycle / PhaseSeries::per_cycle);
    TableFormat const format{
        "contacts at the floor",
        "step,loaded,sliding,friction,torque,contacts,all_contacts,first,first_vx,first_spin,"
        "second,second_vx,second_spin,first_volume,second_volume,floor_x,floor_z,floor_torque",
        distance, distance};
    RollingSeries series;
    std::array<Values*, 17> const columns{&series.loaded,       &series.sliding,       &series.friction,
                                          &series.torque,       &series.contacts,      &series.all_contacts,
                                          &series.first,        &series.first_vx,      &series.first_spin,
                                          &series.second,       &series.second_vx,     &series.second_spin,
                                          &series.first_volume, &series.second_volume, &series.floor_x,
                                          &series.floor_z,      &series.floor_torque};
    parse_table(file, format, [&columns](int, std::span<double const> row) {
        for (std::size_t i = 0; i < columns.size(); ++i) columns[i]->push_back(row[i + 1]);
    });
    return series;
}

RollingCurves rolling_curves(RollingSeries const& s, PhaseSeries const& phases, RollingFacts const& facts) {
    check_length(s, phases, facts);
    RollingCurves curves;
    if (facts.used <= std::max(facts.discarded, 1)) return curves;
    Folder const fold(s, facts);
    for (std::size_t j = 0; j < phases_per_cycle; ++j)
        curves.phase.push_back(2 * std::numbers::pi * static_cast<double>(j + 1) / phases_per_cycle);
    add_grains(curves, fold, s, phases, facts.trough_velocity);
    curves.floor_contacts = fold.mean(s.loaded);
    curves.sliding_share = ratio(fold.of(s.sliding), fold.of(s.loaded));
    curves.normal_force = fold.mean(s.floor_z);
    curves.tangential_force = fold.mean(s.floor_x, -1);  // the layer's on the floor
    curves.friction = fold.mean(s.friction);
    curves.floor_torque = fold.mean(s.floor_torque);
    curves.grain_torque = less(fold.mean(s.torque), curves.floor_torque);
    PhaseSums const touching = fold.of_same_lines(phases.touching);
    curves.contacts_per_floor_grain = ratio(fold.of(s.contacts), touching);
    Values const between = fold.mean(s.all_contacts, facts.grains);
    for (std::size_t j = 0; j < phases_per_cycle; ++j) {
        double const with_floor = curves.floor_grains[j] / facts.grains;
        curves.contacts_per_grain.push_back(between[j] + with_floor);
    }
    curves.coordination_number = mean_of_known(curves.contacts_per_grain);
    curves.first_fraction = fold.mean(s.first_volume, facts.slice);
    curves.second_fraction = less(fold.mean(s.second_volume, facts.slice), curves.first_fraction);
    return curves;
}

}  // namespace vibrotrough::measure
