#include "scenario/reader/key_fields.hpp"

#include <algorithm>
#include <utility>

namespace vibrotrough::scenario {
namespace {

using enum KeyKind;
using enum KeyNeed;

/// Whether the trough stands still in a stage; none when it does not, so that this is not written.
template <std::size_t index>
std::optional<Content> standstill_of(Scenario const& s) {
    if (s.stages.size() <= index || !s.stages[index].standstill) return {};
    return Content(1.0);
}

template <std::size_t index>
void set_stage_waveform(Scenario& s, GivenValue const& v) {
    if (s.stages.size() <= index) s.stages.resize(index + 1);
    s.stages[index].waveform = read_once(v.files_read().waveforms, read_waveform, v, waveform_advice);
}

template <std::size_t index>
std::optional<Content> stage_waveform_of(Scenario const& s) {
    if (s.stages.size() <= index || !s.stages[index].waveform) return {};
    return Content(s.stages[index].waveform->file.name);
}

template <std::size_t index>
void set_stroke(Scenario& s, GivenValue const& v) {
    if (s.stages.size() <= index) s.stages.resize(index + 1);
    s.stages[index].amplitude = v.number() / 2;
}

template <std::size_t index>
std::optional<Content> stroke_of(Scenario const& s) {
    if (s.stages.size() <= index || !s.stages[index].amplitude) return {};
    return Content(2 * *s.stages[index].amplitude);
}

/// A key of an entry that means the same as one of [trough], with its unit, range and example.
void add_as_in_trough(std::vector<Key>& rows, std::size_t index, std::string_view name,
                      std::string_view meaning, KeyAccess access) {
    auto const same_name = [&](Key const& key) {
        return section_of(key) == "trough" && last_name(key.path) == name;
    };
    Key key = *std::ranges::find_if(trough_keys(), same_name);
    key.path = path_of_entry(stages_section, index, name);
    key.group = "";
    key.if_missing = optional;
    key.meaning = meaning;
    key.access = access;
    rows.push_back(key);
}

template <std::size_t index>
void add_drive(std::vector<Key>& rows) {
    constexpr auto list = &Scenario::stages;
    auto const add = [&](std::string_view name, std::string_view meaning, KeyAccess access) {
        add_as_in_trough(rows, index, name, meaning, access);
    };
    add("vibration_angle", "as trough.vibration_angle, in this stage",
        entry_field<list, index, &GivenStage::vibration_angle>);
    add("tan_vibration_angle", "as trough.tan_vibration_angle, in this stage",
        entry_field<list, index, &GivenStage::tan_vibration_angle>);
    add("amplitude", "r, as trough.amplitude, in this stage",
        entry_field<list, index, &GivenStage::amplitude>);
    add("stroke", "2 r, as trough.stroke, in this stage",
        KeyAccess{stroke_of<index>, set_stroke<index>}.written_if(never));
    add("throw_number", "throw number in this stage, instead of machine number and frequency",
        entry_field<list, index, &GivenStage::throw_number>);
    add("machine_number", "machine number in this stage, instead of throw number and frequency",
        entry_field<list, index, &GivenStage::machine_number>);
    add("frequency", "frequency in this stage, instead of throw number and machine number",
        entry_field<list, index, &GivenStage::frequency>);
    add("along_phase",
        "as trough.along_phase, in this stage; 180 deg less than before reverses the direction of conveying",
        entry_field<list, index, &GivenStage::along_phase>);
    add("waveform", "as trough.waveform, in this stage",
        KeyAccess{stage_waveform_of<index>, set_stage_waveform<index>});
}

template <std::size_t index>
void add_stage(std::vector<Key>& rows) {
    constexpr auto list = &Scenario::stages;
    auto const add = [&](std::string_view name, KeyKind kind, std::string_view unit, double least,
                         double most, std::string_view range, std::string_view example,
                         std::string_view meaning, KeyAccess access) {
        rows.push_back({path_of_entry(stages_section, index, name), kind, unit, least, most, range, "",
                        optional, example, meaning, access});
    };
    add("cycles", integer, "", 1, 1e5, "1 to 100000", "20",
        "length of a stage of the drive, with its ramp; what a stage does not give of the drive is as in the "
        "stage before, and in the first as in [trough]",
        entry_field<list, index, &GivenStage::cycles>);
    add("time", quantity, "s", 1e-4, 1e6, "0.1 ms to 1000000 s", "\"1.5 s\"",
        "length of the stage with its ramp, instead of cycles; rounded to whole cycles",
        entry_field<list, index, &GivenStage::time>);
    add("ramp", quantity, "s", 1e-4, 1e6, "0.1 ms to 1000000 s", "\"0.2 s\"",
        "time at the beginning of the stage in which the drive changes evenly from that of the stage before "
        "(at first: from standstill) to its own; rounded to whole cycles; without it the drive changes at "
        "once",
        entry_field<list, index, &GivenStage::ramp>);
    add("ramp_cycles", integer, "", 1, 1e5, "1 to 100000", "5", "the same in cycles, instead of ramp",
        entry_field<list, index, &GivenStage::ramp_cycles>);
    add("standstill", truth, "", 0, 1, "true or false", "true",
        "the trough stands still, after the ramp if there is one; cycles are those of the stage before",
        KeyAccess{standstill_of<index>, entry_field<list, index, &GivenStage::standstill>.set});
    add_drive<index>(rows);
    add("mass_flow", quantity, "kg/s", 0, 1e5, "0 to feed.mass_flow", "\"0 t/h\"",
        "what is fed into an open trough in this stage; as in the stage before, and in the first as "
        "feed.mass_flow",
        entry_field<list, index, &GivenStage::mass_flow>);
}

}  // namespace

std::span<Key const> stage_keys() {
    static std::vector<Key> const all = [] {
        std::vector<Key> rows;
        [&]<std::size_t... i>(std::index_sequence<i...>) {
            (add_stage<i>(rows), ...);
        }
        (std::make_index_sequence<most_stages>());
        return rows;
    }();
    return all;
}

}  // namespace vibrotrough::scenario
