#include "prepare/numerics_variations.hpp"

#include "prepare/contact.hpp"
#include "prepare/numerical_errors.hpp"
#include "scenario/reader/keys.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace vibrotrough::prepare {
namespace {

constexpr double contact_order = -2.0 / 5;     // of overlaps at impact and contact times in E
constexpr double modulus_factors[] = {4, 16};  // coarseness 0.57 and 0.33
constexpr double block_factors[] = {2, 4};     // coarseness 1/2 and 1/4

struct SettingNames {
    std::string_view name, title, key;
};

/// In the order of the enumeration.
constexpr std::array<SettingNames, 5> all_names{
    {{"youngs_modulus", "Young's modulus", "grains.youngs_modulus"},
     {"time_step", "time step", "solver.rayleigh_fraction"},
     {"length", "length of the box", "layer.length"},
     {"width", "width of the box", "layer.width"},
     {"block_stiffness", "stiffness of the block", "solver.block_stiffness"}}};

SettingNames const& names_of(NumericalSetting setting) {
    return all_names.at(static_cast<std::size_t>(setting));
}

scenario::Key const& row_of(NumericalSetting setting) {
    return *scenario::find_key(names_of(setting).key);
}

VariedSetting vary_modulus(scenario::Scenario const& s) {
    double const given = s.grains.youngs_modulus.value();
    VariedSetting varied{NumericalSetting::youngs_modulus, given, 1};
    for (double const factor : modulus_factors) {
        double const modulus = factor * given;
        if (modulus > row_of(NumericalSetting::youngs_modulus).most) continue;
        scenario::Scenario stiff = s;
        stiff.grains.youngs_modulus = modulus;
        stiff.engine.cohesion *= std::pow(factor, contact_of(s, 1)->stiffness_exponent());
        varied.variations.push_back({modulus, std::pow(factor, contact_order), stiff});
    }
    if (varied.variations.empty())
        varied.left_out = fmt::format("{:.3g} MPa is as stiff as the key allows", 1e-6 * given);
    return varied;
}

VariedSetting vary_time_step(PreparedCase const& c) {
    double const fraction = c.time.rayleigh_fraction;
    VariedSetting varied{NumericalSetting::time_step, fraction, {}};
    if (fraction / 2 < row_of(NumericalSetting::time_step).least) {
        varied.left_out = fmt::format("it is {:.2g} of the Rayleigh time already", fraction);
        return varied;
    }
    scenario::Scenario half = c.scenario;
    half.solver.rayleigh_fraction = fraction / 2;
    varied.variations.push_back({fraction / 2, 0.5, half});
    return varied;
}

/// Twice the size of the box with the same height of the layer.
VariedSetting vary_box(scenario::Scenario const& s, NumericalSetting setting, double scenario::Layer::*size) {
    VariedSetting varied{setting, s.layer.*size, {}};
    if (2.0 * s.layer.grains > scenario::find_key("layer.grains")->most) {
        varied.left_out = "the layer would have more grains than the key allows";
        return varied;
    }
    scenario::Scenario larger = s;
    larger.layer.*size *= 2;
    larger.layer.grains *= 2;
    varied.variations.push_back({larger.layer.*size, 0.5, larger});
    return varied;
}

std::vector<VariedSetting> vary_block(PreparedCase const& c) {
    scenario::Scenario const& s = c.scenario;
    VariedSetting stiffness{NumericalSetting::block_stiffness, s.solver.block_stiffness, 1};
    for (double const factor : block_factors) {
        scenario::Scenario stiff = s;
        stiff.solver.block_stiffness *= factor;
        if (stiff.solver.block_stiffness <= row_of(NumericalSetting::block_stiffness).most)
            stiffness.variations.push_back({stiff.solver.block_stiffness, 1 / factor, stiff});
    }
    if (stiffness.variations.empty()) stiffness.left_out = "it is as stiff as the key allows";
    auto const left_out = [](NumericalSetting setting, double value, std::string why) {
        return VariedSetting{setting, value, {}, {}, std::move(why)};
    };
    return {stiffness,
            left_out(NumericalSetting::youngs_modulus, s.grains.youngs_modulus.value(),
                     "a block has a contact of its own instead"),
            left_out(NumericalSetting::time_step, c.time.rayleigh_fraction,
                     "it follows from the duration of the block's contact"),
            left_out(NumericalSetting::length, s.layer.length, "a block does not meet its periodic images"),
            left_out(NumericalSetting::width, s.layer.width, "a block does not meet its periodic images")};
}

/// What is known beforehand of the settings' errors.
void expect_errors(std::vector<VariedSetting>& settings, NumericalErrors const& known) {
    auto const varies = [&](NumericalSetting setting) {
        auto const is_varied = [&](VariedSetting const& one) {
            return one.setting == setting && one.left_out.empty();
        };
        return std::ranges::any_of(settings, is_varied);
    };
    bool const is_shared = varies(NumericalSetting::length) && varies(NumericalSetting::width);
    for (VariedSetting& one : settings) {
        if (one.setting == NumericalSetting::youngs_modulus) {
            one.expected = known.softness;
        } else if (one.setting == NumericalSetting::time_step) {
            one.expected = known.time_step;
        } else {
            one.expected = is_shared ? known.box / std::numbers::sqrt2 : known.box;
        }
    }
}

}  // namespace

std::string_view name_of(NumericalSetting setting) {
    return names_of(setting).name;
}

std::string_view title_of(NumericalSetting setting) {
    return names_of(setting).title;
}

std::string_view key_of(NumericalSetting setting) {
    return names_of(setting).key;
}

std::string_view unit_of(NumericalSetting setting) {
    std::string_view const unit = row_of(setting).unit;
    return unit.empty() ? "1" : unit;
}

std::vector<VariedSetting> vary_numerics(PreparedCase const& c) {
    scenario::Scenario const& s = c.scenario;
    if (s.layer.block != scenario::Block::none) return vary_block(c);
    auto const side = [&](NumericalSetting setting, double scenario::Layer::*member, bool is_given,
                          char const* reason) {
        return is_given ? VariedSetting{setting, s.layer.*member, {}, {}, reason}
                        : vary_box(s, setting, member);
    };
    bool const is_mesh = s.trough.mesh != nullptr;
    std::vector<VariedSetting> settings{
        vary_modulus(s), vary_time_step(c),
        side(NumericalSetting::length, &scenario::Layer::length, is_mesh || is_open(s),
             is_mesh ? "the mesh has one length" : "the length of an open trough is part of the problem"),
        side(NumericalSetting::width, &scenario::Layer::width, is_mesh || s.trough.side_wall_friction,
             is_mesh ? "the mesh has one width" : "between side walls the width is part of the problem")};
    expect_errors(settings, numerical_errors(s));
    return settings;
}

}  // namespace vibrotrough::prepare
