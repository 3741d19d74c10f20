#include "scenario/reader/given_values.hpp"

#include <array>
#include <string>

#include <fmt/format.h>

namespace vibrotrough::scenario {
namespace {

/// Checks one stage with what it gives.
class StageChecks {
  public:
    StageChecks(Scenario const& scenario, Stage const& stage, std::size_t index, GivenKeys const& given)
        : scenario_(scenario),
          stage_(stage),
          stage_given_(scenario.stages[index]),
          index_(index),
          given_(given) {}

    void check() const {
        check_exclusive();
        check_standstill();
        check_drive();
        check_length();
        if (!stage_.trough.waveform) return;
        if (given_.has(key("along_phase")))
            fail("along_phase", "is given, but the waveform already is the whole motion", "remove it");
        if (auto const fault = find_fault(*stage_.trough.waveform, stage_.trough))
            fail("waveform", fault->wrong, fault->instead);
    }

  private:
    std::string key(std::string_view name) const {
        return fmt::format("{}.{}.{}", stages_section, index_ + 1, name);
    }

    /// Fails at this key or, when it is not given, at another one of the stage.
    [[noreturn]] void fail(std::string_view name, std::string_view wrong, std::string_view instead) const {
        std::string place = key(name);
        for (Key const& other : all_keys())
            if (!given_.has(place) && other.path.starts_with(key("")) && given_.has(other.path))
                place = other.path;
        given_.fail(place, wrong, instead);
    }

    void check_exclusive() const {
        constexpr std::array<std::array<std::string_view, 2>, 7> pairs{
            {{"cycles", "time"},
             {"ramp", "ramp_cycles"},
             {"vibration_angle", "tan_vibration_angle"},
             {"amplitude", "stroke"},
             {"throw_number", "machine_number"},
             {"throw_number", "frequency"},
             {"machine_number", "frequency"}}};
        for (auto const& [one, other] : pairs) {
            if (given_.has(key(one)) && given_.has(key(other)))
                fail(other, fmt::format("{} is also given, and both say the same", one),
                     "keep one of the two");
        }
    }

    void check_standstill() const {
        if (!stage_given_.standstill) return;
        for (std::string_view const name :
             {"vibration_angle", "tan_vibration_angle", "amplitude", "stroke", "throw_number",
              "machine_number", "frequency", "along_phase", "waveform"}) {
            if (given_.has(key(name)))
                fail(name, "is given, but the trough stands still in this stage",
                     "write it into the next stage, or remove standstill");
        }
    }

    void check_drive() const {
        Trough const& trough = stage_.trough;
        if (trough.given.throw_number && trough.vibration_angle <= 0) {
            fail("throw_number",
                 "a trough that vibrates along its own surface (vibration angle 0) has throw number 0",
                 "write machine_number or frequency instead");
        }
        check_range("frequency", trough.frequency, " Hz");
        check_range("throw_number", scenario::throw_number(trough), "");
        check_range("machine_number", scenario::machine_number(trough), "");
        if (scenario_.layer.block != Block::none && trough.frequency != scenario_.trough.frequency)
            fail("frequency", "the frequency changes, but the contact of a block is made for one frequency",
                 "change the amplitude instead, or use a layer of grains");
    }

    void check_range(std::string_view name, double value, std::string_view unit) const {
        Key const& row = *find_key(fmt::format("trough.{}", name));
        bool const may_be_small = name != "frequency";
        double const rounding = 1e-12 * row.most;
        if (value <= row.most + rounding && (may_be_small || value >= row.least)) return;
        fail(name,
             fmt::format("the stage would have a {} of {:.4g}{}, outside the range {}", name, value, unit,
                         row.range),
             "change it or the amplitude");
    }

    void check_length() const {
        if (!stage_given_.cycles && !stage_given_.time)
            fail("cycles", fmt::format("stage {} has no length", index_ + 1),
                 "write cycles = 20 or time = \"1.5 s\"");
        bool const has_ramp = stage_given_.ramp || stage_given_.ramp_cycles;
        if (has_ramp && (stage_.ramp_cycles > stage_.cycles ||
                         (stage_given_.time && stage_.ramp_time() > *stage_given_.time * (1 + 1e-9)))) {
            fail(stage_given_.ramp ? "ramp" : "ramp_cycles",
                 fmt::format("the ramp takes {} cycles ({:.4g} s), longer than the stage", stage_.ramp_cycles,
                             stage_.ramp_time()),
                 "write a shorter ramp or a longer stage");
        }
        if (stage_.cycles < 1)
            fail("time", fmt::format("is shorter than half a cycle of {:.4g} s", 1 / stage_.trough.frequency),
                 "write a longer time");
    }

    Scenario const& scenario_;
    Stage const& stage_;
    GivenStage const& stage_given_;
    std::size_t index_;
    GivenKeys const& given_;
};

/// What the stages themselves decide must not be given.
void check_plan(GivenKeys const& given) {
    refuse_length(given, "stages");
}

}  // namespace

void refuse_length(GivenKeys const& given, std::string_view what) {
    for (char const* key : {"measure.max_cycles", "measure.min_cycles"})
        if (given.has(key))
            given.fail(key, fmt::format("how long a run is follows from the {}", what), "remove it");
    for (char const* key : {"measure.max_packings", "measure.max_core_time"})
        if (given.has(key))
            given.fail(key,
                       fmt::format("a case with a {} has as many packings as measure.packings says",
                                   what == "stages" ? "drive in stages" : what),
                       "remove it");
}

void complete_stages(Scenario& scenario, GivenKeys const& given) {
    if (scenario.stages.empty()) return;
    check_plan(given);
    auto const all = stages(scenario);
    bool moves = false;
    for (std::size_t i = 0; i < all.size(); ++i) {
        StageChecks(scenario, all[i], i, given).check();
        moves = moves || !all[i].standstill;
    }
    constexpr int most_cycles = 1'000'000;
    if (cycles_of(all) > most_cycles)
        given.fail(
            "stages.1.cycles",
            fmt::format("the stages have {} cycles together, more than {}", cycles_of(all), most_cycles),
            "shorten them");
    if (!moves)
        given.fail("stages.1.standstill", "the trough stands still in all stages", "write one that moves");
    scenario.measure.max_cycles = cycles_of(all);
    scenario.measure.max_packings = scenario.measure.packings;
}

}  // namespace vibrotrough::scenario
