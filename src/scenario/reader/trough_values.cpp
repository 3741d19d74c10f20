#include "scenario/reader/given_values.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

namespace vibrotrough::scenario {
namespace {

/// Works out the drive of a trough whose keys are set, and checks it.
class TroughChecks {
  public:
    TroughChecks(Trough& trough, GivenKeys const& given) : trough_(trough), given_(given) {}

    void complete() {
        if (trough_.width && trough_.side_wall_friction) {
            given_.fail("trough.width",
                        "is given together with side walls, between which the width is layer.width",
                        "remove one of width and side_wall_friction");
        }
        set_frequency();
        check_derived("trough.throw_number", throw_number(trough_));
        check_derived("trough.machine_number", machine_number(trough_));
        if (trough_.waveform) check_waveform();
    }

  private:
    void set_frequency() {
        if (given_.has("trough.frequency")) return;
        double machine_number = trough_.given.machine_number.value_or(0);
        if (trough_.given.throw_number) {
            if (trough_.vibration_angle <= 0) {
                given_.fail(
                    "trough.throw_number",
                    "a trough that vibrates along its own surface (vibration angle 0) has throw number 0",
                    "write machine_number or frequency instead");
            }
            machine_number = *trough_.given.throw_number * std::cos(trough_.inclination) /
                             std::sin(trough_.vibration_angle);
        }
        double const result =
            std::sqrt(machine_number * gravity / trough_.amplitude) / (2 * std::numbers::pi);
        Key const& key = *find_key("trough.frequency");
        if (result < key.least || result > key.most) {
            given_.fail(
                given_.has("trough.stroke") ? "trough.stroke" : "trough.amplitude",
                fmt::format("the drive would run at {:.4g} Hz, outside the range {}", result, key.range),
                "change the amplitude or the throw number");
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
            given_.fail(
                given,
                fmt::format("gives a {} of {:.4g}, outside the range {}", last_name(path), value, key.range),
                "reduce it or the amplitude");
        }
    }

    /// The amplitude and vibration angle of the keys must be those of the waveform's fundamental, because
    /// theory, throw number and efficiency are based on them.
    void check_waveform() const {
        constexpr auto key = "trough.waveform";
        for (char const* other : {"trough.harmonics", "trough.along_phase"}) {
            if (given_.has(other))
                given_.fail(other, "is given together with a waveform, which already is the whole motion",
                            "keep one of the two");
        }
        try {
            check_samples(*trough_.waveform, 1 / trough_.frequency);
        } catch (std::invalid_argument const& error) {
            given_.fail(key, fmt::format("{}: {}", trough_.waveform->file.name, error.what()),
                        waveform_advice);
        }
        DriveMotion const& motion = trough_.waveform->motion;
        auto const fundamental = [](std::vector<DriveTerm> const& terms) {
            return terms.empty() || terms.front().order != 1 ? 0.0 : terms.front().amplitude;
        };
        double const along = fundamental(motion.along), normal = fundamental(motion.normal);
        double const amplitude = std::hypot(along, normal), angle = std::atan2(normal, along);
        if (std::abs(amplitude - trough_.amplitude) > 0.01 * amplitude ||
            std::abs(angle - trough_.vibration_angle) > 0.01) {
            given_.fail(
                key,
                fmt::format(
                    "its fundamental has amplitude {:.6g} mm and vibration angle {:.5g} deg, which differ "
                    "from the keys",
                    1e3 * amplitude, angle * 180 / std::numbers::pi),
                fmt::format("write amplitude = \"{:.6g} mm\" and vibration_angle = \"{:.5g} deg\"",
                            1e3 * amplitude, angle * 180 / std::numbers::pi));
        }
    }

    Trough& trough_;
    GivenKeys const& given_;
};

}  // namespace

void complete_trough(Scenario& scenario, GivenKeys const& given) {
    TroughChecks(scenario.trough, given).complete();
}

}  // namespace vibrotrough::scenario
