#include "scenario/reader/given_values.hpp"

#include <array>
#include <string>

#include <fmt/format.h>

namespace vibrotrough::scenario {
namespace {

/// What a stage cannot have together.
struct StagePair {
    std::string_view one, other, reason;
};
constexpr std::string_view both_say = "both say the same";
constexpr std::string_view stands_still = "the trough stands still in this stage";
constexpr std::array excluded_in_stage{
    StagePair{"cycles", "time", both_say},
    StagePair{"ramp", "ramp_cycles", both_say},
    StagePair{"vibration_angle", "tan_vibration_angle", both_say},
    StagePair{"amplitude", "stroke", both_say},
    StagePair{"throw_number", "machine_number", both_say},
    StagePair{"throw_number", "frequency", both_say},
    StagePair{"machine_number", "frequency", both_say},
    StagePair{"waveform", "along_phase", "the waveform is the whole motion"},
    StagePair{"standstill", "vibration_angle", stands_still},
    StagePair{"standstill", "tan_vibration_angle", stands_still},
    StagePair{"standstill", "amplitude", stands_still},
    StagePair{"standstill", "stroke", stands_still},
    StagePair{"standstill", "throw_number", stands_still},
    StagePair{"standstill", "machine_number", stands_still},
    StagePair{"standstill", "frequency", stands_still},
    StagePair{"standstill", "along_phase", stands_still},
    StagePair{"standstill", "waveform", stands_still},
};

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
        check_pairs();
        check_drive();
        check_length();
        if (!stage_.trough.waveform) return;
        if (auto const fault = find_fault(*stage_.trough.waveform, stage_.trough))
            fail("waveform", fault->wrong, fault->instead);
    }

  private:
    std::string key(std::string_view name) const { return path_of_entry(stages_section, index_, name); }

    /// Fails at this key or, when it is not given, at another one of the stage.
    [[noreturn]] void fail(std::string_view name, std::string_view wrong, std::string_view instead) const {
        std::string place = key(name);
        for (Key const& other : all_keys())
            if (!given_.has(place) && other.path.starts_with(key("")) && given_.has(other.path))
                place = other.path;
        given_.fail(place, wrong, instead);
    }

    /// Whether the stage has what a key says, which may come from a stage before.
    bool has(std::string_view name) const {
        if (name == "standstill") return stage_given_.standstill;
        return name == "waveform" ? stage_.trough.waveform != nullptr : given_.has(key(name));
    }

    void check_pairs() const {
        for (auto const& [one, other, reason] : excluded_in_stage) {
            if (has(one) && given_.has(key(other)))
                fail(other, fmt::format("does not go with {}: {}", one, reason), "remove one of the two");
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
                         range_of(row)),
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

}  // namespace

void complete_stages(Scenario& scenario, GivenKeys const& given) {
    if (scenario.stages.empty()) return;
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
