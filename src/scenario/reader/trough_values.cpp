#include "core/quantity.hpp"
#include "scenario/reader/given_values.hpp"
#include "scenario/reader/value_reader.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

namespace vibrotrough::scenario {
namespace {

/// Reads the section [trough].
class TroughReader {
  public:
    explicit TroughReader(GivenValues const& given) : given_(given) {}

    Trough trough() const {
        Trough trough{.inclination = angle("trough.inclination", "trough.tan_inclination"),
                      .vibration_angle = angle("trough.vibration_angle", "trough.tan_vibration_angle"),
                      .amplitude = amplitude(),
                      .frequency = 0,
                      .friction = given_.number("trough.friction"),
                      .restitution = given_.number("trough.restitution"),
                      .side_wall_friction = {},
                      .along_phase = given_.number("trough.along_phase"),
                      .harmonics = harmonics(),
                      .waveform = nullptr,
                      .given = given_drive(),
                      .width = width()};
        if (Value const* value = given_.find("trough.side_wall_friction"))
            trough.side_wall_friction = value->number();
        trough.frequency = frequency(trough);
        check_derived("trough.throw_number", throw_number(trough));
        check_derived("trough.machine_number", machine_number(trough));
        if (given_.find("trough.waveform") != nullptr) add_waveform(trough);
        return trough;
    }

  private:
    double angle(std::string_view angle_key, std::string_view tangent_key) const {
        if (Value const* value = given_.find(angle_key)) return value->number();
        return std::atan(given_.number(tangent_key));
    }

    std::optional<double> width() const {
        Value const* const value = given_.find("trough.width");
        if (value == nullptr) return {};
        if (given_.find("trough.side_wall_friction") != nullptr) {
            given_.fail("trough.width",
                        "is given together with side walls, between which the width is layer.width",
                        "remove one of width and side_wall_friction");
        }
        return value->number();
    }

    double amplitude() const {
        if (Value const* stroke = given_.find("trough.stroke")) return stroke->number() / 2;
        return given_.number("trough.amplitude");
    }

    double frequency(Trough const& trough) const {
        if (Value const* value = given_.find("trough.frequency")) return value->number();
        double machine_number = 0;
        if (Value const* value = given_.find("trough.machine_number")) {
            machine_number = value->number();
        } else {
            if (trough.vibration_angle <= 0) {
                given_.fail(
                    "trough.throw_number",
                    "a trough that vibrates along its own surface (vibration angle 0) has throw number 0",
                    "write machine_number or frequency instead");
            }
            machine_number = given_.number("trough.throw_number") * std::cos(trough.inclination) /
                             std::sin(trough.vibration_angle);
        }
        double const result = std::sqrt(machine_number * gravity / trough.amplitude) / (2 * std::numbers::pi);
        Key const& key = *find_key("trough.frequency");
        if (result < key.least || result > key.most) {
            given_.fail(
                given_.find("trough.stroke") != nullptr ? "trough.stroke" : "trough.amplitude",
                fmt::format("the drive would run at {:.4g} Hz, outside the range {}", result, key.range),
                "change the amplitude or the throw number");
        }
        return result;
    }

    /// The upper bounds of throw and machine number also hold where these numbers are derived from the
    /// frequency or from each other.
    void check_derived(std::string_view path, double value) const {
        Key const& key = *find_key(path);
        if (value <= key.most * (1 + 1e-12)) return;
        for (std::string_view const given :
             {"trough.frequency", "trough.machine_number", "trough.throw_number"}) {
            if (given_.find(given) == nullptr) continue;
            given_.fail(
                given,
                fmt::format("gives a {} of {:.4g}, outside the range {}", last_name(path), value, key.range),
                "reduce it or the amplitude");
        }
    }

    GivenDrive given_drive() const {
        auto const given = [&](std::string_view key) {
            Value const* const value = given_.find(key);
            return value ? std::optional(value->number()) : std::nullopt;
        };
        return {given("trough.throw_number"), given("trough.machine_number"),
                given("trough.tan_vibration_angle"), given("trough.tan_inclination")};
    }

    std::vector<DriveHarmonic> harmonics() const {
        std::vector<DriveHarmonic> harmonics;
        Value const* const value = given_.find("trough.harmonics");
        if (value == nullptr) return harmonics;
        for (std::string const& text : value->words()) harmonics.push_back(harmonic(text));
        return harmonics;
    }

    DriveHarmonic harmonic(std::string const& text) const {
        constexpr auto instead = "write \"order, ratio, phase\", such as \"25, 0.2, 0 deg\"";
        auto const wrong = [&](std::string_view why) {
            given_.fail("trough.harmonics", fmt::format("'{}': {}", text.substr(0, 60), why), instead);
        };
        std::size_t const first = text.find(','), second = text.find(',', first + 1);
        if (first == std::string::npos || second == std::string::npos)
            wrong("it does not have three parts separated by commas");
        DriveHarmonic harmonic{};
        auto const plain = [&](std::size_t from, std::size_t to, auto& result) {
            from = text.find_first_not_of(' ', from);
            auto const [end, failure] =
                std::from_chars(text.data() + std::min(from, to), text.data() + to, result);
            return failure == std::errc() &&
                   text.find_first_not_of(' ', static_cast<std::size_t>(end - text.data())) == to;
        };
        if (!plain(0, first, harmonic.order) || harmonic.order < 2 || harmonic.order > 100)
            wrong("its order is not a whole number from 2 to 100");
        if (!plain(first + 1, second, harmonic.ratio) || !(std::abs(harmonic.ratio) <= 10))
            wrong("its ratio is not a number from -10 to 10");
        try {
            std::size_t const start = text.find_first_not_of(' ', second + 1);
            harmonic.phase =
                core::parse_quantity(start == std::string::npos ? "" : text.substr(start), "radian");
        } catch (core::QuantityError const& error) {
            wrong(error.what());
        }
        if (!(std::abs(harmonic.phase) <= 4 * std::numbers::pi)) wrong("its phase is larger than 720 deg");
        return harmonic;
    }

    /// Reads the waveform and checks that the amplitude and vibration angle of the keys are those of its
    /// fundamental, because theory, throw number and efficiency are based on them.
    void add_waveform(Trough& trough) const {
        constexpr auto key = "trough.waveform";
        for (char const* other : {"trough.harmonics", "trough.along_phase"}) {
            if (given_.find(other) != nullptr)
                given_.fail(other, "is given together with a waveform, which already is the whole motion",
                            "keep one of the two");
        }
        try {
            auto& known = given_.files_read().waveforms[given_.word(key)];
            if (!known) known = read_waveform(given_.named_file(key));
            trough.waveform = known;
            check_samples(*known, 1 / trough.frequency);
        } catch (std::invalid_argument const& error) {
            given_.fail(key, fmt::format("{}: {}", given_.word(key), error.what()),
                        "write the header time_s,x_m,z_m and evenly spaced samples of one cycle");
        }
        DriveMotion const& motion = trough.waveform->motion;
        auto const fundamental = [](std::vector<DriveTerm> const& terms) {
            return terms.empty() || terms.front().order != 1 ? 0.0 : terms.front().amplitude;
        };
        double const along = fundamental(motion.along), normal = fundamental(motion.normal);
        double const amplitude = std::hypot(along, normal), angle = std::atan2(normal, along);
        if (std::abs(amplitude - trough.amplitude) > 0.01 * amplitude ||
            std::abs(angle - trough.vibration_angle) > 0.01) {
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

    GivenValues const& given_;
};

}  // namespace

Trough read_trough(GivenValues const& given) {
    return TroughReader(given).trough();
}

}  // namespace vibrotrough::scenario
