#include "scenario/reader/key_fields.hpp"

#include <algorithm>

namespace vibrotrough::scenario {
namespace {

using enum KeyKind;
using enum KeyNeed;

template <auto member>
constexpr KeyAccess of_stage = entry_field<&Scenario::stages, member>;

GivenStage stage_at(Scenario const& s, std::size_t i) {
    return s.stages.size() > i ? s.stages[i] : GivenStage{};
}

/// Whether the trough stands still in a stage; none when it does not, so that this is not written.
constexpr KeyAccess standstill{.get_entry = [](Scenario const& s, std::size_t i) -> std::optional<Content> {
                                   return stage_at(s, i).standstill ? std::optional<Content>(1.0)
                                                                    : std::nullopt;
                               },
                               .set_entry = of_stage<&GivenStage::standstill>.set_entry};

constexpr KeyAccess waveform{
    .get_entry = [](Scenario const& s, std::size_t i) -> std::optional<Content> {
        auto const motion = stage_at(s, i).waveform;
        return motion ? content_of(motion->file.name) : std::nullopt;
    },
    .set_entry = [](Scenario& s, std::size_t i,
                    GivenValue const& v) { entry_of(s.stages, i).waveform = waveform_of(v); }};

constexpr KeyAccess stroke{
    .get_entry = [](Scenario const& s, std::size_t i) -> std::optional<Content> {
        auto const amplitude = stage_at(s, i).amplitude;
        return amplitude ? content_of(2 * *amplitude) : std::nullopt;
    },
    .set_entry = [](Scenario& s, std::size_t i,
                    GivenValue const& v) { entry_of(s.stages, i).amplitude = v.number() / 2; }};

/// A key of an entry that means the same as one of [trough], with its unit, range and example.
Key as_in_trough(std::string_view name, std::string_view meaning, KeyAccess access) {
    Key key = *std::ranges::find_if(trough_keys(), [&](Key const& one) {
        return section_of(one) == "trough" && last_name(one.path) == name;
    });
    key.path = name;
    key.group = "";
    key.if_missing = optional;
    key.meaning = meaning;
    key.access = access;
    return key;
}

}  // namespace

std::span<Key const> stage_keys() {
    static std::vector<Key> const rows{
        {"cycles", integer, "", 1, 1e5, "1 to 100000", "", optional, "20",
         "length of a stage of the drive, with its ramp; what a stage does not give of the drive is as in "
         "the "
         "stage before, and in the first as in [trough]",
         of_stage<&GivenStage::cycles>},
        {"time", quantity, "s", 1e-4, 1e6, "0.1 ms to 1000000 s", "", optional, "\"1.5 s\"",
         "length of the stage with its ramp, instead of cycles; rounded to whole cycles",
         of_stage<&GivenStage::time>},
        {"ramp", quantity, "s", 1e-4, 1e6, "0.1 ms to 1000000 s", "", optional, "\"0.2 s\"",
         "time at the beginning of the stage in which the drive changes evenly from that of the stage before "
         "(at first: from standstill) to its own; rounded to whole cycles; without it the drive changes at "
         "once",
         of_stage<&GivenStage::ramp>},
        {"ramp_cycles", integer, "", 1, 1e5, "1 to 100000", "", optional, "5",
         "the same in cycles, instead of ramp", of_stage<&GivenStage::ramp_cycles>},
        {"standstill", truth, "", 0, 1, "true or false", "", optional, "true",
         "the trough stands still, after the ramp if there is one; cycles are those of the stage before",
         standstill},
        as_in_trough("vibration_angle", "as trough.vibration_angle, in this stage",
                     of_stage<&GivenStage::vibration_angle>),
        as_in_trough("tan_vibration_angle", "as trough.tan_vibration_angle, in this stage",
                     of_stage<&GivenStage::tan_vibration_angle>),
        as_in_trough("amplitude", "r, as trough.amplitude, in this stage", of_stage<&GivenStage::amplitude>),
        as_in_trough("stroke", "2 r, as trough.stroke, in this stage", stroke.written_if(never)),
        as_in_trough("throw_number", "throw number in this stage, instead of machine number and frequency",
                     of_stage<&GivenStage::throw_number>),
        as_in_trough("machine_number", "machine number in this stage, instead of throw number and frequency",
                     of_stage<&GivenStage::machine_number>),
        as_in_trough("frequency", "frequency in this stage, instead of throw number and machine number",
                     of_stage<&GivenStage::frequency>),
        as_in_trough("along_phase",
                     "as trough.along_phase, in this stage; 180 deg less than before reverses the direction "
                     "of conveying",
                     of_stage<&GivenStage::along_phase>),
        as_in_trough("waveform", "as trough.waveform, in this stage", waveform),
        {"mass_flow", quantity, "kg/s", 0, 1e5, "0 to feed.mass_flow", "", optional, "\"0 t/h\"",
         "what is fed into an open trough in this stage; as in the stage before, and in the first as "
         "feed.mass_flow",
         of_stage<&GivenStage::mass_flow>},
    };
    return rows;
}

}  // namespace vibrotrough::scenario
