#include "learn/capacity.hpp"

#include "evaluate/open_trough.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace vibrotrough::learn {
namespace {

/// Twelve doublings are a factor of 4096. A first feed that is further off was not meant for this trough.
constexpr std::size_t most_steps_without_bracket = 12;

double to_three_digits(double value) {
    double const step = std::pow(10.0, std::floor(std::log10(value)) - 2);
    return std::round(value / step) * step;
}

/// Sum over the packings of a mass flow, kg/s.
double sum_of(store::CaseRecord const& record, std::optional<double> measure::OpenFlow::*flow) {
    double sum = 0;
    for (store::PackingRecord const& packing : record.packings) sum += (packing.open.*flow).value_or(0);
    return sum;
}

}  // namespace

bool is_overfed(core::Outcome outcome, store::CaseRecord const* record) {
    if (outcome == core::Outcome::overfull) return true;
    if (record == nullptr || record->packings.empty()) return false;
    constexpr double found_no_room = 0.03;
    double const inflow = sum_of(*record, &measure::OpenFlow::inflow);
    double const asked =
        record->scenario.feed.mass_flow.value_or(0) * static_cast<double>(record->packings.size());
    if (core::has_result(outcome) && inflow < (1 - found_no_room) * asked) return true;
    if (outcome != core::Outcome::not_steady || evaluate::unsteady_flow(*record).empty()) return false;
    return sum_of(*record, &measure::OpenFlow::outflow) < inflow;
}

CapacityBounds capacity_bounds(std::vector<FeedTrial> const& trials) {
    CapacityBounds bounds;
    for (FeedTrial const& trial : trials) {
        if (!trial.is_carried)
            bounds.refused = std::min(bounds.refused.value_or(trial.mass_flow), trial.mass_flow);
    }
    for (FeedTrial const& trial : trials) {
        if (!trial.is_carried) continue;
        std::optional<double>& place =
            bounds.refused && trial.mass_flow >= *bounds.refused ? bounds.contradiction : bounds.carried;
        place = std::max(place.value_or(trial.mass_flow), trial.mass_flow);
    }
    return bounds;
}

std::optional<double> next_feed(std::vector<FeedTrial> const& trials, double first, double precision) {
    if (trials.empty()) return first;
    CapacityBounds const bounds = capacity_bounds(trials);
    if (bounds.carried && bounds.refused) {
        if (*bounds.refused <= *bounds.carried * (1 + precision)) return std::nullopt;
        double const middle = std::sqrt(*bounds.carried * *bounds.refused);
        double const rounded = to_three_digits(middle);
        return rounded > *bounds.carried && rounded < *bounds.refused ? rounded : middle;
    }
    if (trials.size() >= most_steps_without_bracket) return std::nullopt;
    return bounds.carried ? 2 * *bounds.carried : *bounds.refused / 2;
}

}  // namespace vibrotrough::learn
