#include "learn/given_quantities.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::learn {
namespace {

void check_name(std::string const& name, std::vector<FreeParameter> const& known, std::string_view whose) {
    if (std::ranges::find(known, name, &FreeParameter::name) != known.end()) return;
    std::vector<std::string> names;
    for (FreeParameter const& p : known) names.push_back(p.name);
    throw core::InputError(
        fmt::format("'{}' is not a quantity of {}; choose from {}", name, whose, fmt::join(names, ", ")));
}

}  // namespace

void check_given(std::vector<std::string> const& free, std::map<std::string, double> const& fixed,
                 std::vector<FreeParameter> const& known, std::string_view whose,
                 std::vector<MeasuredSpeed> const& speeds) {
    std::set<std::string> given;
    for (std::string const& name : free) {
        check_name(name, known, whose);
        if (!given.insert(name).second)
            throw core::InputError(fmt::format("{} is free twice; name it once", name));
    }
    for (auto const& [name, value] : fixed) {
        check_name(name, known, whose);
        if (!given.insert(name).second)
            throw core::InputError(fmt::format("{} is both free and fixed; choose one of the two", name));
    }
    if (given.contains("vibration_angle")) return;
    for (MeasuredSpeed const& m : speeds) {
        if (m.vibration_angle) continue;
        throw core::InputError(
            fmt::format("line {} has no vibration angle; write the column vibration_angle_deg, or give "
                        "one for all with --fix vibration_angle=30",
                        m.line));
    }
}

}  // namespace vibrotrough::learn
