#include "evaluate/numerics_budget.hpp"

#include "scenario/example_campaign.hpp"
#include "scenario/reader/campaign_file.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace vibrotrough::evaluate {
namespace {

using prepare::NumericalSetting;

/// The example's variations: modulus x 4, x 16; half the time step; twice the length; twice the width.
std::vector<prepare::VariedSetting> const varied = prepare::vary_numerics(
    prepare::prepare_case(scenario::parse_campaign(example_campaign, "test.toml").cases.front()));

StudyResult result(double mean, double half_width) {
    return {"0123456789ab", mean, half_width, ""};
}

SettingError const& find(NumericsBudget const& budget, NumericalSetting setting) {
    for (SettingError const& one : budget.settings) {
        if (one.setting == setting) return one;
    }
    throw std::out_of_range("no such setting");
}

/// The same with nothing known beforehand, so that what was measured stands alone.
std::vector<prepare::VariedSetting> unexpected(std::vector<prepare::VariedSetting> settings) {
    for (prepare::VariedSetting& one : settings) one.expected = std::numeric_limits<double>::infinity();
    return settings;
}

// The table of validation/convergence, near enough: errors are default minus limit, their half-widths the
// root of the squares of both. Errors add up, half-widths add in squares: e = sum e_i, h^2 = sum h_i^2.
TEST(NumericsBudget, AddsThePartsUp) {
    NumericsBudget const budget = make_budget("c", 0.95, result(0.82, 0.006), unexpected(varied),
                                              {result(0.84, 0.008), result(0.829, 0.008), result(0.82, 0.008),
                                               result(0.79, 0.008), result(0.815, 0.008)});
    EXPECT_EQ(find(budget, NumericalSetting::youngs_modulus).error->verdict,
              measure::Convergence::not_resolved)
        << "the finest modulus decides: -0.009 +- 0.01 is not significant";
    SettingError const& length = find(budget, NumericalSetting::length);
    EXPECT_EQ(length.error->verdict, measure::Convergence::resolved);
    EXPECT_NEAR(length.error->error, 0.03, 1e-15);
    EXPECT_NEAR(length.error->half_width, 0.01, 1e-15);  // 6-8-10 triangle
    EXPECT_NEAR(*length.variations[0].half_width, 0.01, 1e-15);
    EXPECT_NEAR(budget.total()->error, -0.009 + 0.0 + 0.03 + 0.005, 1e-15);
    EXPECT_NEAR(budget.total()->half_width, 0.02, 1e-15);
    EXPECT_NEAR(*budget.numerical_error(), 0.026 + 0.84 * 0.02, 1e-12);
}

// Four differences that are smaller than their wide intervals say little, and no more is counted than was
// expected beforehand: 1/h^2 = sum over both of 1/h_i^2, so that the whole is narrower than either.
TEST(NumericsBudget, IsNotWiderThanWhatIsExpected) {
    auto const wide = [](double mean) { return result(mean, 0.012); };
    NumericsBudget const budget = make_budget(
        "c", 0.95, wide(0.82), varied, {wide(0.819), wide(0.817), wide(0.8175), wide(0.821), wide(0.818)});
    double squares = 0;
    for (prepare::VariedSetting const& one : varied) squares += one.expected * one.expected;
    EXPECT_LT(budget.total()->half_width, std::sqrt(squares));
    EXPECT_LT(budget.total()->half_width, std::sqrt(4 * 2) * 0.012);
    EXPECT_EQ(budget.total()->verdict, measure::Convergence::not_resolved);
}

// A part that is not known is not zero: neither is the sum.
TEST(NumericsBudget, IsUnknownWhenAPartIs) {
    StudyResult const failed{"0123456789ab", {}, {}, "lost-grains: a grain is gone"};
    NumericsBudget const budget = make_budget(
        "c", 0.95, result(0.82, 0.006), varied,
        {result(0.84, 0.008), result(0.83, 0.008), failed, result(0.79, 0.008), result(0.815, 0.008)});
    SettingError const& step = find(budget, NumericalSetting::time_step);
    EXPECT_FALSE(step.error);
    EXPECT_NE(step.message.find("lost-grains: a grain is gone"), std::string::npos);
    EXPECT_TRUE(find(budget, NumericalSetting::length).error) << "the other parts are known";
    EXPECT_FALSE(budget.numerical_error());
}

TEST(NumericsBudget, NeedsTheFinestVariationButNotTheOthers) {
    StudyResult const failed{"0123456789ab", {}, {}, "not finished"};
    auto const with_moduli = [&](StudyResult const& first, StudyResult const& finest) {
        auto const one = result(0.82, 0.001);
        return make_budget("c", 0.95, one, varied, {first, finest, one, one, one});
    };
    EXPECT_TRUE(find(with_moduli(failed, result(0.85, 0.001)), NumericalSetting::youngs_modulus).error);
    EXPECT_FALSE(find(with_moduli(result(0.84, 0.001), failed), NumericalSetting::youngs_modulus).error);
}

TEST(NumericsBudget, IsUnknownWithoutTheCaseItself) {
    StudyResult const unsteady{"0123456789ab", {}, {}, "not-steady"};
    auto const one = result(0.82, 0.001);
    NumericsBudget const budget = make_budget("c", 0.95, unsteady, varied, {one, one, one, one, one});
    EXPECT_FALSE(budget.numerical_error());
    for (SettingError const& setting : budget.settings)
        EXPECT_NE(setting.message.find("not-steady"), std::string::npos);
    StudyResult const unbounded{"0123456789ab", 0.82, {}, ""};
    EXPECT_FALSE(make_budget("c", 0.95, unbounded, varied, {one, one, one, one, one}).numerical_error())
        << "a mean without an interval says nothing about an error";
}

// What is left out, such as the width between side walls, has no part.
TEST(NumericsBudget, LeavesOutWhatMakesNoSense) {
    std::vector<prepare::VariedSetting> const only_length{
        {NumericalSetting::width, 0.018, {}, {}, "between side walls the width is part of the problem"},
        *std::find_if(varied.begin(), varied.end(),
                      [](auto const& one) { return one.setting == NumericalSetting::length; })};
    NumericsBudget const budget =
        make_budget("c", 0.95, result(0.82, 0.003), unexpected(only_length), {result(0.80, 0.004)});
    EXPECT_TRUE(budget.settings[0].is_left_out());
    EXPECT_FALSE(budget.settings[0].error);
    EXPECT_NE(budget.settings[0].message.find("side walls"), std::string::npos);
    EXPECT_NEAR(*budget.numerical_error(), 0.02 + 0.84 * 0.005, 1e-15);  // 3-4-5 triangle
}

}  // namespace
}  // namespace vibrotrough::evaluate
