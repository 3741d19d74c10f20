#include "app/commands/theory/drive_space.hpp"

#include "app/commands/command.hpp"
#include "core/typed_unit.hpp"

#include <sstream>

namespace vibrotrough::app {
namespace {

constexpr int most_poles = 48;  // of asynchronous motors

std::vector<std::string> split(std::string const& text) {
    std::vector<std::string> pieces;
    std::stringstream rest(text);
    for (std::string piece; std::getline(rest, piece, ',');) pieces.push_back(piece);
    return pieces;
}

/// Hz, of a list such as "960,1450,2900"; empty when the text is a range, or a number with a decimal comma.
std::vector<double> read_listed_speeds(Text const& rpm) {
    std::vector<double> frequencies;
    if (!rpm || rpm->find(',') == std::string::npos) return {};
    for (std::string const& piece : split(*rpm)) {
        constexpr std::ptrdiff_t most_decimals = 2;
        if (std::ranges::count_if(piece, [](char c) { return c >= '0' && c <= '9'; }) <= most_decimals)
            return {};
        frequencies.push_back(read_turns("--rpm", piece));
    }
    return frequencies;
}

/// Hz, of the mains: "50" or "50 Hz".
double read_mains(std::string const& text) {
    bool const is_plain = text.find_first_not_of("0123456789.,+eE- ") == std::string::npos;
    return read_option("--mains", is_plain ? text + " Hz" : text);
}

/// The numbers of poles of a list such as "4,6,8".
std::vector<int> read_listed_poles(std::string const& text) {
    constexpr char const* example = "4,6,8";
    std::vector<int> all;
    if (text.ends_with(','))
        throw core::InputError(fmt::format("--poles {}: nothing follows the last comma", text));
    for (std::string const& piece : split(text)) {
        int const poles = read_count("--poles", piece, example, 2, most_poles);
        if (poles % 2 != 0)
            throw core::InputError(
                fmt::format("--poles {}: {} must be even, because poles come in pairs; write for example "
                            "--poles {}",
                            text, poles, example));
        all.push_back(poles);
    }
    if (all.empty())
        throw core::InputError(fmt::format("--poles is empty; write for example --poles {}", example));
    return all;
}

/// Hz, the speeds of the shafts of motors: 2 f / p (1 - slip), which are 120 f / p turns per minute without
/// slip; empty where no motors were given.
std::vector<double> read_motor_speeds(DriveTexts const& o) {
    for (auto const& [name, text] : {std::pair{"--mains", o.mains}, {"--slip", o.slip}})
        if (text && !o.poles)
            throw core::InputError(fmt::format(
                "{} {}: belongs to the poles of a motor; write --poles 4,6,8 as well, or leave it out", name,
                *text));
    if (!o.poles) return {};
    refuse_both("--poles", o.poles, "--rpm", o.rpm);
    refuse_both("--poles", o.poles, "--frequency", o.frequency);
    if (!o.mains)
        throw core::InputError(
            fmt::format("--poles {}: also needs the frequency of the mains; write --mains 50, or --mains 60 "
                        "as in America",
                        *o.poles));
    double const mains = read_mains(*o.mains);
    double const slip = o.slip ? read_option("--slip", *o.slip) : 0;
    std::vector<double> speeds;
    for (int const poles : read_listed_poles(*o.poles)) speeds.push_back(2 * mains / poles * (1 - slip));
    return speeds;
}

/// m, of a list of strokes such as "6,8,10 mm" or "6 mm, 8 mm"; empty when the text is a range or one number.
std::vector<double> read_listed_amplitudes(Text const& stroke) {
    constexpr std::ptrdiff_t sure_commas = 2;  // one may be decimal
    bool const is_list = stroke && (std::ranges::count(*stroke, ',') >= sure_commas ||
                                    stroke->find("m,") != std::string::npos);
    std::vector<double> amplitudes;
    if (!is_list) return amplitudes;
    std::string const unit = stroke->substr(stroke->find_last_of("0123456789.") + 1);
    for (std::string const& piece : split(*stroke)) {
        bool const has_unit = piece.find('m') != std::string::npos;
        amplitudes.push_back(read_option("--stroke", has_unit ? piece : piece + unit) / 2);
    }
    return amplitudes;
}

theory::Range ends_of(std::vector<double> const& values) {
    auto const [low, high] = std::ranges::minmax(values);
    return {low, high};
}

void read_frequency(DriveTexts const& o, ReadSpace& read) {
    refuse_both("--rpm", o.rpm, "--frequency", o.frequency);
    std::vector<double> const motors = read_motor_speeds(o);
    read.frequencies = motors.empty() ? read_listed_speeds(o.rpm) : motors;
    if (!read.frequencies.empty()) {
        read.space.frequency = ends_of(read.frequencies);
        if (read.frequencies.size() == 1) read.frequencies.clear();  // one speed leaves no choice
    } else if (o.rpm) {
        read.space.frequency = read_range("--rpm", *o.rpm, "300 to 1500",
                                          [](std::string const& text) { return read_turns("--rpm", text); });
    }
    if (o.frequency) read.space.frequency = read_option_range("--frequency", *o.frequency);
}

void read_amplitude(DriveTexts const& o, ReadSpace& read) {
    refuse_both("--stroke", o.stroke, "--amplitude", o.amplitude);
    read.amplitudes = read_listed_amplitudes(o.stroke);
    if (!read.amplitudes.empty()) {
        read.space.amplitude = ends_of(read.amplitudes);
    } else if (o.stroke) {
        auto const [low, high] = read_option_range("--stroke", *o.stroke);
        read.space.amplitude = {low / 2, high / 2};
    }
    if (o.amplitude) read.space.amplitude = read_option_range("--amplitude", *o.amplitude);
}

}  // namespace

ReadSpace read_drive_space(DriveTexts const& o) {
    ReadSpace read;
    read_frequency(o, read);
    read_amplitude(o, read);
    theory::DriveSpace& space = read.space;
    if (o.vibration_angle) space.vibration_angle = read_option_range("--vibration-angle", *o.vibration_angle);
    if (!(space.vibration_angle.low > 0))
        throw core::InputError(fmt::format(
            "--vibration-angle {}: must be above 0; write for example --vibration-angle \"20 deg to 40 deg\"",
            *o.vibration_angle));
    if (o.inclination) space.inclination = read_option_range("--inclination", *o.inclination);
    if (o.machine_number) space.max_machine_number = read_option("--machine-number", *o.machine_number);
    if (o.throw_number) space.max_throw_number = read_option("--throw-number", *o.throw_number);
    return read;
}

void check_slope(DriveTexts const& texts, theory::DriveSpace const& space, double friction,
                 std::string const& why_so_low) {
    if (!texts.inclination) return;
    double const steepest = theory::steepest_slope(friction);
    if (space.inclination.low <= steepest && space.inclination.high >= -steepest) return;
    std::string const one = last_of_range(*texts.inclination);
    throw core::InputError(
        fmt::format("no machine fits: --inclination {}: must lie between {}, where tan(alpha) is 95 % of the "
                    "friction coefficient {:.4g}{}{}; write a flatter one",
                    *texts.inclination, core::range_in_unit_of(one, -steepest, steepest, "radian", " and "),
                    friction, why_so_low, core::slip_of_unit(one, -steepest, steepest, "radian")));
}

void tell_unusual(DriveTexts const& texts, theory::DriveSpace const& space, double friction,
                  std::optional<double> bulk_density) {
    theory::MachineNumbers numbers{};
    if (texts.rpm || texts.frequency || texts.poles)
        numbers.frequency = space.frequency.high < theory::smallest_usual_frequency ? space.frequency.high
                                                                                    : space.frequency.low;
    if (texts.stroke || texts.amplitude) numbers.amplitude = space.amplitude.low;
    if (texts.vibration_angle) numbers.vibration_angle = space.vibration_angle.high;
    numbers.friction = friction;
    numbers.bulk_density = bulk_density;
    numbers.is_stroke = texts.stroke.has_value();
    numbers.is_turns = texts.rpm.has_value() || texts.poles.has_value();
    if (numbers.frequency && numbers.amplitude)
        numbers.machine_number =
            theory::Drive{space.frequency.low, space.amplitude.low, 1, 0}.machine_number(space.gravity);
    tell_unusual(numbers);
}

}  // namespace vibrotrough::app
