#include "scenario/reader/given_values.hpp"

#include <cmath>

#include <fmt/format.h>

namespace vibrotrough::scenario {
namespace {

/// Works out the drive of a trough whose keys are set, and checks it.
class TroughChecks {
  public:
    TroughChecks(Trough& trough, GivenKeys const& given) : trough_(trough), given_(given) {}

    void complete() {
        trough_.given.is_stroke = given_.has("trough.stroke");
        trough_.given.is_turns =
            given_.has("trough.frequency") && !given_.unit("trough.frequency").ends_with("Hz");
        if (trough_.waveform) take_from_waveform();
        check_angle();
        set_frequency();
        check_derived("trough.throw_number", throw_number(trough_));
        check_derived("trough.machine_number", machine_number(trough_));
        if (trough_.waveform) check_waveform();
        if (trough_.waveform) replace_nominal_values();
    }

  private:
    /// What the keys do not say follows from the record.
    void take_from_waveform() {
        auto const has = [&](auto... names) { return (given_.has(fmt::format("trough.{}", names)) || ...); };
        if (!has("amplitude", "stroke")) trough_.amplitude = trough_.waveform->amplitude;
        if (!has("vibration_angle", "tan_vibration_angle")) trough_.vibration_angle = trough_.waveform->angle;
        if (!has("frequency", "throw_number", "machine_number"))
            trough_.frequency = trough_.waveform->frequency;
    }

    /// The theory's tangent is known up to 89 degrees; normal to the trough nothing is conveyed along it.
    void check_angle() const {
        double const degrees = in_degrees(trough_.vibration_angle);
        if (degrees <= 89 || is_vertical(trough_)) return;
        given_.fail(given_.has("trough.vibration_angle") ? "trough.vibration_angle" : "trough.waveform",
                    fmt::format("a vibration angle of {:.6g} deg is between 89 and 90 deg", degrees),
                    "write at most 89 deg, or 90 deg for a motion normal to the trough only");
    }

    void set_frequency() {
        if (!trough_.given.throw_number && !trough_.given.machine_number) return;
        if (trough_.given.throw_number && trough_.vibration_angle <= 0) {
            given_.fail("trough.throw_number",
                        "a trough that vibrates along its own surface (vibration angle 0) has throw number 0",
                        "write machine_number or frequency instead");
        }
        double const result = frequency_of(trough_);
        Key const& key = *find_key("trough.frequency");
        if (result < key.least || result > key.most) {
            given_.fail(
                fmt::format("trough.{}", amplitude_name()),
                fmt::format("the drive would run at {:.4g} Hz, outside the range {}", result, range_of(key)),
                fmt::format("change the {} or the {} number", amplitude_name(),
                            trough_.given.throw_number ? "throw" : "machine"));
        }
        trough_.frequency = result;
    }

    /// The upper bounds of throw and machine number also hold where these numbers are derived from the
    /// frequency or from each other.
    void check_derived(std::string_view path, double value) const {
        Key const& key = *find_key(path);
        if (value <= key.most * (1 + 1e-12)) return;
        for (std::string_view const given :
             {"trough.frequency", "trough.machine_number", "trough.throw_number"}) {
            if (!given_.has(given)) continue;
            given_.fail(given,
                        fmt::format("gives a {} of {:.4g}, outside the range {}", last_name(path), value,
                                    range_of(key)),
                        fmt::format("reduce it or the {}", amplitude_name()));
        }
    }

    void check_waveform() const {
        for (auto const& [path, value] : {std::pair("trough.amplitude", trough_.waveform->amplitude),
                                          std::pair("trough.frequency", trough_.waveform->frequency)}) {
            Key const& key = *find_key(path);
            if (value >= key.least && value <= key.most) continue;
            given_.fail(
                "trough.waveform",
                fmt::format("{} has a fundamental with {:.4g} {} as its {}, outside the range {}",
                            trough_.waveform->file.name, value, key.unit, last_name(path), range_of(key)),
                "give time in s, and positions in m or accelerations in m/s2 or g");
        }
        if (auto const fault = find_fault(*trough_.waveform, trough_))
            given_.fail("trough.waveform", fault->wrong, fault->instead);
    }

    /// Keys that are near those of a record, but not its to 1 %, are nominal values: the record's hold, on
    /// which throw number, theory and efficiency are based.
    void replace_nominal_values() {
        constexpr double same = 0.01;
        Waveform const& w = *trough_.waveform;
        if (std::abs(trough_.amplitude / w.amplitude - 1) <= same &&
            std::abs(trough_.vibration_angle - w.angle) <= same &&
            std::abs(trough_.frequency / w.frequency - 1) <= same)
            return;
        std::string const replaced = fmt::format(
            "{}: the amplitude of {:.5g} mm, the vibration angle of {:.4g} deg and the frequency of {:.5g} "
            "Hz of "
            "the campaign file are taken as nominal values; those of the record hold",
            w.file.name, 1e3 * trough_.amplitude, in_degrees(trough_.vibration_angle), trough_.frequency);
        trough_.amplitude = w.amplitude;
        trough_.vibration_angle = w.angle;
        trough_.frequency = w.frequency;
        trough_.given = {};
        trough_.given.replaced = replaced;
    }

    /// The name of the key that was given.
    std::string_view amplitude_name() const { return trough_.given.is_stroke ? "stroke" : "amplitude"; }

    Trough& trough_;
    GivenKeys const& given_;
};

}  // namespace

void complete_trough(Scenario& scenario, GivenKeys const& given) {
    TroughChecks(scenario.trough, given).complete();
}

}  // namespace vibrotrough::scenario
