#include "learn/given_quantities.hpp"

#include "core/error.hpp"
#include "learn/machine_keys.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::learn {

GivenQuantities::GivenQuantities(std::vector<std::string> const& free,
                                 std::map<std::string, double> const& fixed,
                                 std::vector<FreeParameter> const& known, std::string_view whose,
                                 std::vector<MeasuredSpeed> const& speeds)
    : known_(known), fixed_(known.size()) {
    auto const known_index = [&](std::string const& name) {
        if (std::size_t const index = index_of(name); index < known.size()) return index;
        std::vector<std::string> names;
        for (FreeParameter const& p : known) names.push_back(p.name);
        throw core::InputError(
            fmt::format("'{}' is not a quantity of {}; choose from {}", name, whose, fmt::join(names, ", ")));
    };
    for (std::string const& name : free) {
        std::size_t const index = known_index(name);
        if (std::ranges::find(free_, index) != free_.end())
            throw core::InputError(fmt::format("{} is free twice; name it once", name));
        free_.push_back(index);
    }
    for (auto const& [name, value] : fixed) {
        std::size_t const index = known_index(name);
        if (is_free(name))
            throw core::InputError(fmt::format("{} is both free and fixed; choose one of the two", name));
        fixed_[index] = value;
    }
    for (MeasuredSpeed const& m : speeds) {
        if (m.vibration_angle || has("vibration_angle")) continue;
        throw core::InputError(
            fmt::format("line {} has no vibration angle; write the column vibration_angle_deg, or give "
                        "one for all with --fix vibration_angle=30",
                        m.line));
    }
}

std::size_t GivenQuantities::index_of(std::string const& name) const {
    return static_cast<std::size_t>(std::ranges::find(known_, name, &FreeParameter::name) - known_.begin());
}

bool GivenQuantities::is_free(std::string const& name) const {
    return std::ranges::find(free_, index_of(name)) != free_.end();
}

bool GivenQuantities::has(std::string const& name) const {
    return is_free(name) || fixed_[index_of(name)];
}

GivenQuantities::Values GivenQuantities::at(std::span<double const> free) const {
    Values all = fixed_;
    for (std::size_t i = 0; i < free_.size(); ++i) all[free_[i]] = free[i];
    return all;
}

theory::Drive GivenQuantities::drive(Values const& values, MeasuredSpeed const& measured) const {
    auto const beta = values[index_of("vibration_angle")], alpha = values[index_of("inclination")];
    return {measured.frequency, measured.amplitude, beta ? *beta * degree : *measured.vibration_angle,
            alpha ? *alpha * degree : measured.inclination.value_or(0)};
}

}  // namespace vibrotrough::learn
