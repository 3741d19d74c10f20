#include "scenario/reader/design.hpp"

#include "scenario/reader/swept_keys.hpp"

#include <algorithm>
#include <cmath>

namespace vibrotrough::scenario {
namespace {

bool is_same(Content const& value, Content const& wanted) {
    auto const* const number = std::get_if<double>(&value);
    auto const* const other = std::get_if<double>(&wanted);
    if (number == nullptr || other == nullptr) return value == wanted;
    return std::abs(*number - *other) <= 1e-9 * std::abs(*other);
}

bool holds(Condition const& condition, Content const& value) {
    double const* const number = std::get_if<double>(&value);
    return (!condition.above || (number != nullptr && *number > *condition.above)) &&
           (!condition.below || (number != nullptr && *number < *condition.below)) &&
           (!condition.equals || is_same(value, *condition.equals));
}

}  // namespace

double DomainAxis::at(double fraction) const {
    double const value = low + fraction * (high - low);
    return find_key(key)->kind == KeyKind::integer ? std::round(value) : value;
}

void set_value(CaseValues& values, std::string const& key, Value const& value) {
    Key const& known = *find_key(key);
    auto const before = values.find(known.path);
    std::string const unit = before == values.end() || !value.unit.empty() ? value.unit : before->second.unit;
    if (!known.group.empty()) {
        std::erase_if(values, [&](auto const& entry) { return find_key(entry.first)->group == known.group; });
    }
    values[known.path] = {value.content, value.where, unit};
}

std::optional<Content> value_of(Scenario const& scenario, CaseValues const& given, std::string_view key) {
    if (auto const found = given.find(key); found != given.end()) return found->second.content;
    return key_value(scenario, key);
}

bool is_excluded(Scenario const& scenario, CaseValues const& given,
                 std::vector<Exclusion> const& exclusions) {
    return std::ranges::any_of(exclusions, [&](Exclusion const& exclusion) {
        return std::ranges::all_of(exclusion, [&](Condition const& condition) {
            auto const value = value_of(scenario, given, condition.key);
            return value && holds(condition, *value);
        });
    });
}

}  // namespace vibrotrough::scenario
