#include "app/commands/option_table.hpp"

#include "app/commands/command.hpp"
#include "scenario/reader/keys.hpp"

#include <stdexcept>

namespace vibrotrough::app {
namespace {

constexpr double any_positive = 1e-12;

/// The option of a key of the campaign file.
OptionRow of_key(char const* name, char const* path, std::optional<theory::Input> input = {},
                 double of_unit = 1) {
    scenario::Key const& key = *scenario::find_key(path);
    std::string example(key.example);
    std::erase(example, '"');
    OptionRow row{name, std::string(key.unit), key.least, key.most, example, std::string(key.meaning)};
    row.of_theory = input;
    row.of_unit = of_unit;
    return row;
}

/// The same with limits of its own.
OptionRow within(double least, double most, OptionRow row) {
    row.least = least;
    row.most = most;
    return row;
}

/// A whole number.
OptionRow whole(OptionRow row) {
    row.is_whole = true;
    return row;
}

/// The plain numbers that the theory has beyond the plastic point mass.
std::vector<OptionRow> rows_of_theory() {
    std::vector<OptionRow> rows;
    for (std::size_t i = 0; i < theory::input_count; ++i) {
        auto const input = static_cast<theory::Input>(i);
        if (!is_beyond_plastic(input)) continue;
        theory::InputRow const& row = row_of(input);
        std::string name = "--" + std::string(row.name);
        std::ranges::replace(name, '_', '-');
        rows.push_back({name, "", row.least, row.most, std::string(row.example), std::string(row.meaning)});
        rows.back().of_theory = input;
    }
    auto const phase = std::ranges::find(rows, theory::Input::along_phase_deg, &OptionRow::of_theory);
    *phase = of_key("--along-phase", "trough.along_phase", phase->of_theory, degree);
    return rows;
}

/// What the campaign file has, too; the theory goes further than decks do.
std::vector<OptionRow> rows_of_motions() {
    using theory::Input;
    return {
        within(1e-3, 100, of_key("--throw-number", "trough.throw_number", Input::throw_number)),
        within(1e-3, 1e4, of_key("--machine-number", "trough.machine_number", Input::machine_number)),
        within(0, 89 * degree, of_key("--vibration-angle", "trough.vibration_angle")),
        of_key("--tan-vibration-angle", "trough.tan_vibration_angle", Input::tan_vibration_angle),
        of_key("--inclination", "trough.inclination"),
        of_key("--tan-inclination", "trough.tan_inclination", Input::tan_inclination),
        of_key("--friction", "trough.friction", Input::friction),
        of_key("--frequency", "trough.frequency"),
        of_key("--amplitude", "trough.amplitude", Input::amplitude_m),
        of_key("--stroke", "trough.stroke"),
        of_key("--width", "trough.width"),
        of_key("--bulk-density", "grains.bulk_density"),
        of_key("--grain-diameter", "grains.diameter"),
        of_key("--rolling-friction", "grains.rolling_friction"),
        of_key("--grain-friction", "grains.friction"),
        of_key("--layer-height", "layer.height"),
        of_key("--layer-width", "layer.width"),
        {"--gravity", "m/s2", 1e-3, 1e3, "9.81 m/s2", "Default: \"9.81 m/s2\""},
        {"--max-relative-displacement", "", 1e-9, 1000, "1.5",
         "Measured slip from peak to peak, in amplitudes r, from 0 to 2"},
    };
}

std::vector<OptionRow> rows_of_designs() {
    return {
        {"--length", "m", 1e-3, 1e3, "3 m", "Of the trough, for power and time, for example \"3 m\""},
        {"--layer-depth", "m", 1e-6, 10, "5 mm to 60 mm",
         "Range of the layer's depth; default: \"2 mm to 100 mm\""},
        {"--friction-uncertainty", "", 0, 1, "0.03",
         "Its standard uncertainty (one standard deviation), instead of +-; default: 0"},
        {"--stroke-uncertainty", "m", any_positive, 1, "0.2 mm",
         "Standard uncertainty of the stroke as it is set, for example \"0.2 mm\"; default: exact"},
        {"--angle-uncertainty", "radian", any_positive, 20 * degree, "0.5 deg",
         "Standard uncertainty of the vibration angle as it is set, for example \"0.5 deg\"; default: exact"},
        {"--landing-speed", "m/s", any_positive, 1e3, "0.3 m/s",
         "Largest speed of the material relative to the trough at an impact, for example \"0.3 m/s\""},
        {"--confidence", "", 0.5, 0.999, "0.95",
         "Probability with which the mass flow is to be reached; default: 0.95"},
        {"--model-discrepancy", "", 0, 1, "0.05",
         "Standard deviation of what every model misses, in velocity efficiency; default: what simulated "
         "layers say at the throw number, slope and depth (validation/model_errors), for the calibrated "
         "model "
         "what --posterior says, and for a surface its own uncertainty alone"},
        {"--trough-mass", "kg", any_positive, 1e9, "180 kg",
         "Of all that moves, with the motors and without material, for example \"180 kg\"; with --length, "
         "the exciter that the stroke needs is told"},
        {"--spring", "N/m", any_positive, 1e15, "200 N/mm",
         "Stiffness of all springs in the direction of vibration, for example \"200 N/mm\"; default: so soft "
         "that it does not count"},
        {"--added-mass", "", -1, 1, "0.17",
         "Part of the material's mass that moves with the trough, from added_mass_fraction of a campaign or "
         "written like --friction; default: that of the atlas' layers, else \"0.10 to 0.25\" "
         "(NetterVibration)"},
        {"--surge", "", 1, 5, "1.3",
         "Factor by which the feed may exceed the mass flow for a while; the trough is made for both "
         "together, "
         "default: 1"},
        {"--mains", "Hz", 1, 400, "50 Hz",
         "f, frequency of the mains for --poles, in Hz: 50, or 60 as in America"},
        {"--slip", "", 0, 0.3, "0.03",
         "Slip of these motors, by which fraction they are slower than their field, such as 0.03; default: "
         "0"},
    };
}

/// Of calibrations, of learning, and of long work.
std::vector<OptionRow> other_rows() {
    return {
        {"--uncertainty", "", 1e-6, 1, "0.03", ""},
        {"--common-error", "", 0, 0.5, "0.05",
         "Standard deviation of an error of the model that is the same in all measurements, in velocity "
         "efficiency, for example 0.05; it looks like another friction and widens its interval; default: 0, "
         "and in theory calibrate what the point mass misses at layers of the atlas"},
        whole({"--seed", "", 0, 1e9, "1", "Of the random numbers; default: 1"}),
        {"--half-width", "", 1e-4, 1, "0.03",
         "Largest half-width of the 95 % interval wanted anywhere in the domain, statistics and numerical "
         "errors together, for example 0.05"},
        whole({"--batch", "", 1, 1000, "8",
               "Cases that are chosen at once; default: as many as keep all jobs busy"}),
        {"--precision", "", 0.005, 1, "0.1",
         "How much larger the smallest feed that is not carried may be than the largest that is, as a share "
         "of it; default 0.1"},
        whole({"--jobs", "", 1, 4096, "2", "Cores to use; default: all"}),
        whole({"--samples", "", 2, 1e7, "721", "Number of lines; default: 721"}),
        whole({"--starts", "", 2, 1e6, "64",
               "Follow so many starts of each motion, for example 64, and write to which motions they lead: "
               "with rebounds there can be several. Default: the standard start alone, at rest at t = 0"}),
    };
}

std::vector<OptionRow> const& table() {
    static std::vector<OptionRow> const rows = [] {
        std::vector<OptionRow> all;
        for (auto const& part : {rows_of_motions(), rows_of_theory(), rows_of_designs(), other_rows()})
            all.insert(all.end(), part.begin(), part.end());
        return all;
    }();
    return rows;
}

}  // namespace

std::string OptionRow::written_example() const {
    return fmt::format(fmt::runtime(unit.empty() ? "{} {}" : "{} \"{}\""), name, example);
}

OptionRow const& option_row(std::string_view name) {
    auto const found = std::ranges::find(table(), name, &OptionRow::name);
    if (found == table().end()) throw std::out_of_range(std::string(name));
    return *found;
}

void QuantityOptions::add_to(CLI::App& command, std::initializer_list<Wanted> wanted,
                             std::string const& group) {
    for (Wanted const& one : wanted) {
        std::string const& meaning = *one.instead != '\0' ? one.instead : option_row(one.name).meaning;
        CLI::Option* const option = command.add_option(one.name, texts_[one.name], meaning + one.more);
        if (!group.empty()) option->group(group);
    }
}

bool QuantityOptions::is_any() const {
    return std::ranges::any_of(texts_, [](auto const& one) { return one.second.has_value(); });
}

void QuantityOptions::set(std::string const& name, std::string const& text) {
    texts_.at(name) = text;
}

void QuantityOptions::set_if_missing(std::string const& name, std::string const& text) {
    if (!has(name)) set(name, text);
}

void QuantityOptions::add_beyond_plastic(CLI::App& command, std::string const& group) {
    for (OptionRow const& row : table()) {
        if (row.of_theory && is_beyond_plastic(*row.of_theory)) add_to(command, {{row.name.c_str()}}, group);
    }
}

std::optional<double> QuantityOptions::value(std::string const& name) const {
    return has(name) ? std::optional(read_option(name, *text(name))) : std::nullopt;
}

double QuantityOptions::required(std::string const& name) const {
    OptionRow const& row = option_row(name);
    return read_option(name, app::required(name, text(name), row.written_example().substr(name.size() + 1)));
}

std::optional<learn::Uncertain> QuantityOptions::uncertain(std::string const& name) const {
    return has(name) ? std::optional(read_uncertain_option(name, *text(name))) : std::nullopt;
}

void QuantityOptions::set_inputs(theory::Inputs& inputs) const {
    for (auto const& [name, text] : texts_) {
        OptionRow const& row = option_row(name);
        if (text && row.of_theory) inputs.set(*row.of_theory, read_option(name, *text) / row.of_unit);
    }
}

void QuantityOptions::refuse_both(std::string const& first, std::string const& second) const {
    app::refuse_both(first, text(first), second, text(second));
}

}  // namespace vibrotrough::app
