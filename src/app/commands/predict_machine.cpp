#include "app/commands/predict_machine.hpp"

#include "app/commands/command.hpp"
#include "app/commands/theory/options.hpp"
#include "atlas/tables.hpp"
#include "core/text.hpp"
#include "learn/machine_prediction.hpp"

namespace vibrotrough::app {
namespace {

using learn::MachinePrediction;

/// A number with its 95 % interval.
struct Predicted {
    double value, half_width;
};

/// m/s
std::optional<Predicted> speed_of(MachinePrediction const& p) {
    if (!p.layer) return {};
    return Predicted{p.layer->efficiency * p.trough_speed, p.layer->half_width * p.trough_speed};
}

/// t/h
std::optional<Predicted> mass_flow_of(MachinePrediction const& p) {
    auto const speed = speed_of(p);
    if (!speed || !p.flow_per_speed) return {};
    double const by_density = atlas::deviations_in_half_width * p.flow_per_speed->sd * speed->value;
    return Predicted{3.6 * p.flow_per_speed->mean * speed->value,
                     3.6 * std::hypot(p.flow_per_speed->mean * speed->half_width, by_density)};
}

std::optional<double> of_point_mass(MachinePrediction const& p) {
    return p.point_mass ? std::optional(*p.point_mass * p.trough_speed) : std::nullopt;
}

Json as_json(MachinePrediction const& p) {
    auto const speed = speed_of(p), flow = mass_flow_of(p);
    Json outside = Json::array();
    for (atlas::Outside const& one : p.outside) outside.push_back(one.why);
    auto const part = [](std::optional<Predicted> const& one, double Predicted::*of) {
        return one ? Json((*one).*of) : Json(nullptr);
    };
    return {{"speed_m_per_s", part(speed, &Predicted::value)},
            {"speed_half_width_m_per_s", part(speed, &Predicted::half_width)},
            {"mass_flow_t_per_h", part(flow, &Predicted::value)},
            {"mass_flow_half_width_t_per_h", part(flow, &Predicted::half_width)},
            {"efficiency", p.layer ? Json(p.layer->efficiency) : Json(nullptr)},
            {"half_width", p.layer ? Json(p.layer->half_width) : Json(nullptr)},
            {"throw_number", p.throw_number},
            {"machine_number", p.machine_number},
            {"layer_mode", p.mode ? Json(p.mode->mode) : Json(nullptr)},
            {"layer_mode_share",
             p.mode ? Json(static_cast<double>(p.mode->agreeing) / atlas::layers_asked) : Json(nullptr)},
            {"point_mass_speed_m_per_s", number_or_null(of_point_mass(p))},
            {"point_mass_efficiency", number_or_null(p.point_mass)},
            {"point_mass_mode", p.point_mass_mode},
            {"efficiency_by_rolling", number_or_null(p.by_rolling)},
            {"outside", outside},
            {"unknown", p.unknown}};
}

/// Where the difference between layer and point mass comes from, in sentences; empty where it is not known.
std::string why_different(MachinePrediction const& p) {
    if (!p.layer || !p.point_mass) return "";
    double const difference = p.layer->efficiency - *p.point_mass;
    if (!p.by_rolling) return "The grains do not roll, so that the point mass describes them.";
    if (std::abs(difference) <= p.layer->half_width)
        return fmt::format("They differ by {:+.3f} m/s, which is within the interval.",
                           difference * p.trough_speed);
    double const rolling = *p.by_rolling * p.trough_speed, all = difference * p.trough_speed;
    return fmt::format(
        "The layer differs by {:+.3f} m/s. Grains that roll on the trough make {:+.3f} m/s of it: the floor "
        "grains turn, so that friction brakes the layer less than a mass that slides (rolling-layer law, "
        "validation/why_theory_fails). The other {:+.3f} m/s are what simulated layers of such a depth, "
        "slope "
        "and friction show beyond that law.",
        all, rolling, all - rolling);
}

std::string flow_line(MachinePrediction const& p) {
    if (!p.flow_per_speed) return "not known: write --width, --layer-depth and --bulk-density";
    auto const flow = mass_flow_of(p);
    if (!flow) return "not known";
    return fmt::format("{} +- {} t/h", core::plain_number(flow->value, 3),
                       core::plain_number(flow->half_width, 2));
}

std::string speed_line(MachinePrediction const& p) {
    auto const speed = speed_of(p);
    if (!speed) return "not known";
    return fmt::format("{:.3f} +- {:.3f} m/s (95 %), velocity efficiency {:.3f} +- {:.3f}, by {}",
                       speed->value, speed->half_width, p.layer->efficiency, p.layer->half_width,
                       p.by_rolling
                           ? fmt::format("the atlas of {} simulated layers", atlas::simulated_layers())
                           : "the point mass and what it misses at such layers");
}

/// What the sizes of a mix change: the speed of layers of the smallest and of the largest that the atlas has;
/// empty where it has none.
std::string by_sizes(learn::ExistingMachine machine, std::optional<theory::Range> const& sizes) {
    if (!sizes || !machine.grains.diameter) return "";
    auto const [least, most] = learn::known_sizes(machine);
    double const low = std::max(sizes->low, least), high = std::min(sizes->high, most);
    std::string text;
    for (double const size : {low, high}) {
        if (low >= high) break;
        machine.grains.diameter = size;
        auto const speed = speed_of(learn::predict_machine(machine));
        if (!speed) continue;
        text += fmt::format("{} spheres of {:.3g} mm at {:.3f} m/s",
                            text.empty() ? " Alone, such a layer has" : ",", 1e3 * size, speed->value);
    }
    return text.empty() ? "" : text + ".";
}

void print_text(MachinePrediction const& p, std::string const& material, std::string const& told) {
    auto const line = [](char const* name, std::string const& text) {
        if (!text.empty()) fmt::print("{:<18}{}\n", name, text);
    };
    if (!told.empty()) fmt::print("{}\n", told);
    line("material", material);
    line("speed", speed_line(p));
    line("mass flow", flow_line(p));
    line("throw number", fmt::format("{:.3g}; machine number {:.3g}", p.throw_number, p.machine_number));
    if (p.mode)
        line("mode", fmt::format("{}, in {} of the {} simulated layers that are most alike", p.mode->mode,
                                 p.mode->agreeing, atlas::layers_asked));
    auto const point_mass = of_point_mass(p);
    line("point mass", point_mass ? fmt::format("{:.3f} m/s, mode {}", *point_mass, p.point_mass_mode)
                                  : theory::to_string(p.point_mass_outcome));
    line("why they differ", why_different(p));
    for (atlas::Outside const& one : p.outside)
        if (told.find(one.why) == std::string::npos)
            line("outside", one.why + (p.layer ? ": extrapolated" : ": not known; simulate it"));
    if (!p.unknown.empty() && p.layer)
        line("not given", fmt::format("{}: in the middle of what was simulated, and the interval holds what "
                                      "they may change",
                                      fmt::join(p.unknown, ", ")));
}

}  // namespace

void MachineOptions::add_to(CLI::App& command) {
    std::string const machine = "A machine that exists, instead of CAMPAIGN";
    command.add_option("--rpm", rpm_, "Turns of the drive per minute, for example 960")->group(machine);
    quantities_.add_to(command,
                       {{"--frequency", ", instead of --rpm"},
                        {"--stroke"},
                        {"--amplitude", ", instead of --stroke"},
                        {"--vibration-angle"},
                        {"--inclination", ", uphill positive; default: level"},
                        {"--width", "", "Of the trough, for the mass flow"},
                        {"--layer-depth", "", "Of the layer; default: not known"}},
                       machine);
    std::string const its_material = "Its material";
    quantities_.add_to(
        command,
        {{"--friction", ": 0.3, 0.3+-0.03, or \"0.25 to 0.35\""},
         {"--bulk-density", "", "Of the material, for the mass flow"},
         {"--grain-diameter", "", "Of the grains, or of a mix \"0 to 30 mm\"; default: not known"},
         {"--rolling-friction", "", "Of the grains, written like --friction; default: not known"},
         {"--grain-friction", "", "Between the grains, written like --friction; default: not known"}},
        its_material);
    material_.add_to(command, its_material);
}

bool MachineOptions::is_any() const {
    return rpm_ || quantities_.is_any() || material_.is_any();
}

learn::ExistingMachine MachineOptions::machine() const {
    refuse_both("--rpm", rpm_, "--frequency", quantities_.text("--frequency"));
    quantities_.refuse_both("--stroke", "--amplitude");
    learn::ExistingMachine machine{};
    theory::Drive& drive = machine.drive;
    auto const frequency = quantities_.value("--frequency"), amplitude = quantities_.value("--amplitude");
    drive.frequency = frequency ? *frequency : read_turns("--rpm", required("--rpm", rpm_, "960"));
    drive.amplitude = amplitude ? *amplitude : quantities_.required("--stroke") / 2;
    drive.vibration_angle = quantities_.required("--vibration-angle");
    drive.inclination = quantities_.value("--inclination").value_or(0);
    required("--friction", quantities_.text("--friction"), "0.3");
    machine.friction = *quantities_.uncertain("--friction");
    machine.grains = {quantities_.value("--grain-diameter"), quantities_.uncertain("--rolling-friction"),
                      quantities_.uncertain("--grain-friction")};
    machine.depth = quantities_.value("--layer-depth");
    machine.width = quantities_.value("--width");
    machine.bulk_density = quantities_.uncertain("--bulk-density");
    return machine;
}

void MachineOptions::tell_unusual(learn::ExistingMachine const& machine) const {
    theory::Drive const& drive = machine.drive;
    theory::MachineNumbers numbers{drive.frequency,       drive.amplitude,       drive.machine_number(9.81),
                                   machine.friction.mean, drive.vibration_angle, quantities_.has("--stroke"),
                                   rpm_.has_value()};
    if (machine.bulk_density) numbers.bulk_density = machine.bulk_density->mean;
    app::tell_unusual(numbers);
}

bool MachineOptions::predict(PredictionFormat format) {
    material_.fill_in(quantities_);
    learn::ExistingMachine const machine = this->machine();
    tell_unusual(machine);
    MachinePrediction prediction = learn::predict_machine(machine);
    std::string told;
    if (auto const& why = material_.why_unknown()) {
        told = fmt::format("The interval does not hold here: {}.{}\n", *why,
                           by_sizes(machine, material_.sizes()));
        prediction.outside.push_back({"grains", *why});
    }
    Json const json = as_json(prediction);
    if (format == PredictionFormat::json) {
        fmt::print("{}\n", json.dump(2));
    } else if (format == PredictionFormat::csv) {
        print_csv({json});
    } else {
        print_text(prediction, material_.told(), told);
    }
    return prediction.layer.has_value() && !material_.why_unknown();
}

}  // namespace vibrotrough::app
