#include "core/quantity.hpp"
#include "scenario/reader/key_fields.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::scenario {
namespace {

using enum KeyKind;
using enum KeyNeed;

constexpr double radian = 57.295779513082321;  // degrees

/// Reads one text of trough.harmonics.
DriveHarmonic read_harmonic(std::string const& text, GivenValue const& v) {
    constexpr auto instead = "write \"order, ratio, phase\", such as \"25, 0.2, 0 deg\"";
    auto const wrong = [&](std::string_view why) {
        v.fail(fmt::format("'{}': {}", text.substr(0, 60), why), instead);
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
        harmonic.phase = core::parse_quantity(start == std::string::npos ? "" : text.substr(start), "radian");
    } catch (core::QuantityError const& error) {
        wrong(error.what());
    }
    if (!(std::abs(harmonic.phase) <= 4 * std::numbers::pi)) wrong("its phase is larger than 720 deg");
    return harmonic;
}

void set_harmonics(Scenario& s, GivenValue const& v) {
    s.trough.harmonics.clear();
    for (std::string const& text : v.words()) s.trough.harmonics.push_back(read_harmonic(text, v));
}

std::optional<Content> harmonics_of(Scenario const& s) {
    std::vector<std::string> texts;
    for (DriveHarmonic const& part : s.trough.harmonics)
        texts.push_back(fmt::format("{}, {}, {} radian", part.order, part.ratio, part.phase));
    return content_of(texts);
}

void set_waveform(Scenario& s, GivenValue const& v) {
    s.trough.waveform = waveform_of(v);
}

void set_mesh(Scenario& s, GivenValue const& v) {
    s.trough.mesh = read_once(v.files_read().meshes, v, v.is_word() ? std::vector{v.word()} : v.words(),
                              read_trough_mesh, "export the surface that the grains touch as STL");
}

std::optional<Content> mesh_of(Scenario const& s) {
    if (!s.trough.mesh) return {};
    std::vector<std::string> names;
    for (NamedFile const& file : s.trough.mesh->files) names.push_back(file.name);
    return names.size() == 1 ? content_of(names.front()) : content_of(names);
}

bool has_mesh(Scenario const& s) {
    return s.trough.mesh != nullptr;
}

std::optional<Content> waveform_name(Scenario const& s) {
    return s.trough.waveform ? content_of(s.trough.waveform->file.name) : std::nullopt;
}

/// Whether the user gave another number than this one of the drive.
template <auto number>
bool lacks(Scenario const& s) {
    return !(s.trough.given.*number);
}

/// The tangent of an angle of the trough, which is kept as it was given.
template <auto angle, auto tangent>
constexpr KeyAccess tangent_of{
    [](Scenario const& s) {
        return content_of((s.trough.given.*tangent).value_or(std::tan(s.trough.*angle)));
    },
    [](Scenario& s, GivenValue const& v) {
        s.trough.*angle = std::atan(v.number());
        s.trough.given.*tangent = v.number();
    },
    [](Scenario const& s) { return (s.trough.given.*tangent).has_value(); }};

constexpr std::array rows_of_trough{
    Key{"campaign.name", name, "", 1, 100, "1 to 100 letters, digits, '.', '_' or '-'", "", required,
        "\"pvc-horizontal\"", "name of the campaign", field<&Scenario::campaign>},

    Key{"trough.inclination", quantity, "radian", -45 / radian, 45 / radian, "-45 to 45 deg", "inclination",
        required, "\"0 deg\"",
        "alpha, angle between trough and horizontal, positive if the trough rises in the conveying "
        "direction",
        field<&Scenario::trough, &Trough::inclination>.written_if(lacks<&GivenDrive::tan_inclination>)},
    Key{"trough.tan_inclination", number, "", -1, 1, "", "inclination", required, "-0.05", "tan(alpha)",
        tangent_of<&Trough::inclination, &GivenDrive::tan_inclination>},
    Key{"trough.vibration_angle", quantity, "radian", 0, 90 / radian, "0 to 90 deg", "vibration angle",
        required, "\"30 deg\"", "beta, angle between the direction of vibration and the trough",
        field<&Scenario::trough, &Trough::vibration_angle>.written_if(
            lacks<&GivenDrive::tan_vibration_angle>)},
    Key{"trough.tan_vibration_angle", number, "", 0, 57, "", "vibration angle", required, "0.5", "tan(beta)",
        tangent_of<&Trough::vibration_angle, &GivenDrive::tan_vibration_angle>},
    Key{"trough.amplitude", quantity, "m", 1e-6, 1, "1 um to 1 m", "amplitude", required, "\"6 mm\"",
        "r, amplitude in the direction of vibration (half the stroke)",
        field<&Scenario::trough, &Trough::amplitude>},
    Key{"trough.stroke", quantity, "m", 2e-6, 2, "2 um to 2 m", "amplitude", required, "\"12 mm\"",
        "2 r, distance between the ends of the vibration, twice the amplitude",
        KeyAccess{[](Scenario const& s) { return content_of(2 * s.trough.amplitude); },
                  [](Scenario& s, GivenValue const& v) { s.trough.amplitude = v.number() / 2; }}
            .written_if(never)},
    Key{"trough.throw_number", number, "", 1e-3, 50, "0.001 to 50", "speed of the drive", required, "2.0",
        "throw number Gamma = omega^2 r sin(beta) / (g cos(alpha))",
        KeyAccess{[](Scenario const& s) { return content_of(throw_number(s.trough)); },
                  [](Scenario& s, GivenValue const& v) { s.trough.given.throw_number = v.number(); }}
            .written_if([](Scenario const& s) { return s.trough.given.throw_number.has_value(); })},
    Key{"trough.machine_number", number, "", 1e-3, 1000, "0.001 to 1000", "speed of the drive", required,
        "4.0", "machine number K = omega^2 r / g",
        KeyAccess{[](Scenario const& s) { return content_of(machine_number(s.trough)); },
                  [](Scenario& s, GivenValue const& v) { s.trough.given.machine_number = v.number(); }}
            .written_if([](Scenario const& s) {
                return !s.trough.given.throw_number && s.trough.given.machine_number;
            })},
    Key{"trough.frequency", quantity, "Hz", 1e-2, 1e4, "0.01 Hz to 10 kHz", "speed of the drive", required,
        "\"12.9 Hz\"",
        "1/T, cycles per second; turns of the drive (\"774 rpm\", \"774 1/min\") count as cycles",
        field<&Scenario::trough, &Trough::frequency>.written_if([](Scenario const& s) {
            return !s.trough.given.throw_number && !s.trough.given.machine_number;
        })},
    Key{"trough.friction", number, "", 0, 5, "", "", required, "0.23",
        "mu, friction coefficient of grain on trough", field<&Scenario::trough, &Trough::friction>},
    Key{"trough.restitution", number, "", 0.05001, 1, "above 0.05, to 1", "", required, "0.5",
        "e, coefficient of restitution of grain on trough", field<&Scenario::trough, &Trough::restitution>},
    Key{"trough.side_wall_friction", number, "", 0, 5, "", "", optional, "0.3",
        "friction coefficient of grain on side wall; adds side walls that move with the trough, without "
        "which the layer is periodic across the trough",
        field<&Scenario::trough, &Trough::side_wall_friction>},
    Key{"trough.width", quantity, "m", 1e-3, 100, "1 mm to 100 m", "", optional, "\"300 mm\"",
        "width of the real trough, for its mass flow in t/h; with side walls it is layer.width",
        KeyAccess{[](Scenario const& s) { return content_of(trough_width(s)); },
                  [](Scenario& s, GivenValue const& v) { s.trough.width = v.number(); }}
            .written_if([](Scenario const& s) { return s.trough.width.has_value(); })},
    Key{"trough.along_phase", quantity, "radian", -180 / radian, 180 / radian, "-180 to 180 deg", "", 0.0,
        "\"20 deg\"",
        "phase of the motion along the trough, x = r cos(beta) sin(omega t + along_phase); makes the drive "
        "elliptical",
        field<&Scenario::trough, &Trough::along_phase>.unless_default()},
    Key{"trough.harmonics", texts, "", 0, 0, "orders 2 to 100, ratios -10 to 10", "", optional,
        "[\"25, 0.2, 0 deg\"]",
        "order, ratio and phase of further parts of the drive's acceleration; the ratio is to the "
        "fundamental (Eq. 22)",
        KeyAccess{harmonics_of, set_harmonics}},
    Key{"trough.waveform", file, "", 0, 0, file_or(".csv"), "", optional, "\"measured.csv\"",
        "record of the trough's displacements (columns time_s,x_m,z_m) or accelerations (time_s,ax_m_per_s2,"
        "az_m_per_s2, or ax_g,az_g), of one cycle or several, that replaces the sinusoid; amplitude, angle "
        "and "
        "frequency follow from it",
        KeyAccess{waveform_name, set_waveform}},
    Key{"trough.waveform_order", integer, "", 1, 30, "", "", optional, "5",
        "highest harmonic of the record that is kept; without it, those that stand out of its noise are kept",
        field<&Scenario::trough, &Trough::waveform_order>},
    Key{"trough.gravity", quantity, "m/s2", 0.1, 1000, "0.1 to 1000 m/s2", "", 9.81, "\"1.62 m/s2\"",
        "g, acceleration of gravity", field<&Scenario::trough, &Trough::gravity>.unless_default()},
    Key{"trough.mesh", files, "", 0, 0, file_or(".stl"), "", optional, "\"chute.stl\"",
        "surface of triangles that replaces the flat floor, x along the trough, y across and z normal to it; "
        "its "
        "length and width are those of the layer; several files have one origin, and each is a solid with "
        "the "
        "name of its file without .stl",
        KeyAccess{mesh_of, set_mesh}},
    Key{"trough.mesh_unit", choice, "", 0, 0, one_of("mm", "m", "cm", "inch"), "", optional, "\"mm\"",
        "unit of length of the mesh's file, which does not say it; an inch is 25.4 mm",
        field<&Scenario::trough, &Trough::mesh_unit>.written_if(has_mesh)},
};

}  // namespace

std::span<Key const> trough_keys() {
    return rows_of_trough;
}

}  // namespace vibrotrough::scenario
