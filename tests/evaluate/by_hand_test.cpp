#include "evaluate/by_hand.hpp"

#include "campaign/campaign_folder.hpp"
#include "core/error.hpp"
#include "deck/deck.hpp"

#include <gmock/gmock.h>

namespace vibrotrough::evaluate {
namespace {

using campaign::overwrite;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

double steady(int cycle) {
    return 0.5 + 0.01 * (cycle % 2);
}

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

// A copy that was put aside does not belong to the case, but can be measured by its own name.
TEST_F(ByHand, ACopyOfAPackingIsNotThatPacking) {
    auto const s = write_case(example_campaign);
    write_run("packing-1-old", s, 30, steady);
    EXPECT_THROW(measure_by_hand(folder), core::InputError);
    EXPECT_EQ(measure_by_hand(folder / "packing-1-old").packings.front().cycles, 30);
}

// The keys of a record are nominal values to 1 %: a deck that nobody changed moves as the record does, here
// with an amplitude that is 0.5 % larger. One that is 2 % larger was changed.
TEST_F(ByHand, AnUntouchedDeckMovesAsItsRecord) {
    std::string const keys = "frequency = \"10 Hz\"\nwaveform = \"record.csv\"";
    double const amplitude = 1.005 * 0.006, beta = std::numbers::pi / 6;
    std::string record = "time_s,x_m,z_m\n";
    for (int i = 0; i < 80; ++i) {
        double const place = amplitude * std::sin(2 * std::numbers::pi * i / 80);
        record += fmt::format("{},{},{}\n", i / 800.0, place * std::cos(beta), place * std::sin(beta));
    }
    overwrite(folder / "record.csv", record);
    auto s = write_case(with("throw_number = 2.0", keys));
    overwrite(folder / "packing-1/in.liggghts",
              deck::make_deck(prepare::prepare_case(s), {1}).files.at(deck::drive_file));
    s.trough.amplitude = amplitude;
    write_run("packing-1", s, 30, steady);
    EXPECT_THAT(measure_by_hand(folder).changes, IsEmpty());
    s.trough.amplitude = 1.02 * 0.006;
    write_run("packing-1", s, 30, steady);
    EXPECT_THAT(measure_by_hand(folder).changes,
                ElementsAre(HasSubstr("an amplitude of 6.12 mm at 30 deg and 10 Hz, and not with 6.0")));
}

}  // namespace
}  // namespace vibrotrough::evaluate
