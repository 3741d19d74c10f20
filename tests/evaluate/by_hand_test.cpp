#include "evaluate/by_hand.hpp"

#include "campaign/campaign_folder.hpp"
#include "core/error.hpp"

#include <gmock/gmock.h>

namespace vibrotrough::evaluate {
namespace {

using campaign::overwrite;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// The folder of a case with the runs of its packings.
class ByHand : public testing::Test {
  protected:
    scenario::Scenario write_case(std::string const& text) const {
        overwrite(folder / "scenario.toml", text);
        return scenario::read_campaign(folder / "scenario.toml").cases.front();
    }
    void write_run(std::string const& name, scenario::Scenario const& scenario, int cycles,
                   std::function<double(int)> const& eta) const {
        overwrite(folder / name / "cycles.csv", campaign::cycles_text(scenario, cycles, eta));
        campaign::write_layer(folder / name, scenario, cycles);
    }

    core::TemporaryFolder const own_folder;
    std::filesystem::path folder = own_folder.path();
};

// Ten cycles are planned, of 0.1 s each, and control.in was edited to fourteen. What follows is left out,
// also of phases.csv. Tolerance: x is written with 15 digits.
TEST_F(ByHand, MeasuresNoMoreCyclesThanStagesHave) {
    auto const s =
        write_case(with("throw_number = 2.0", "frequency = \"10 Hz\"", with("max_cycles = 200\n", "")) +
                   "[[stages]]\ncycles = 10\n");
    write_run("packing-1", s, 14, [](int k) { return k <= 10 ? 0.6 : 9.0; });
    HandRun const run = measure_by_hand(folder);
    EXPECT_EQ(run.cycles_used, 10);
    EXPECT_EQ(run.packings.front().efficiency.size(), 10u);
    EXPECT_NEAR(run.estimate.mean.value(), 0.6, 1e-9);
    EXPECT_THAT(run.changes, ElementsAre("packing 1 ran 14 cycles; the 10 of the scenario are measured"));
    EXPECT_THAT(run.packings.front().message, Not(HasSubstr("phases.csv holds")));
}

// A copy that was put aside is no packing of the case, but can be measured by its own name.
TEST_F(ByHand, ACopyOfAPackingIsNotThatPacking) {
    auto const s = write_case(example_campaign);
    write_run("packing-1-old", s, 30, [](int) { return 0.5; });
    EXPECT_THROW(measure_by_hand(folder), core::InputError);
    EXPECT_EQ(measure_by_hand(folder / "packing-1-old").packings.front().cycles, 30);
}

}  // namespace
}  // namespace vibrotrough::evaluate
