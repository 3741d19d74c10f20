#include "learn/verification.hpp"

#include "learn/machine_keys.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::learn {
namespace {

using Json = nlohmann::ordered_json;

constexpr double seconds_per_hour = 3600;

std::string first_words(DesignTask const& task, Verification const& v) {
    if (v.verdict == Verdict::verified)
        return fmt::format(
            "Verified: this machine was simulated at its own depth, and reaches the mass flow with {:.1f} % "
            "({:.4g} % asked)",
            100 * v.machines.back().probability.value_or(0), 100 * task.confidence);
    if (v.verdict != Verdict::no_machine) return "Not verified";
    if (v.machines.empty())
        return "No machine within the limits is expected to do it, and none was simulated";
    return "By the models, corrected with simulated layers, no machine within the limits does it so surely";
}

char const* name_of(Verdict verdict) {
    static constexpr std::array names{"verified", "no-machine", "budget", "too-many", "no-speed"};
    return names.at(static_cast<std::size_t>(verdict));
}

}  // namespace

bool ComparedLayer::agrees() const {
    return std::abs(promised - simulated) <= std::hypot(promised_half_width, simulated_half_width);
}

std::string verification_sentence(DesignTask const& task, Verification const& v) {
    return first_words(task, v) + (v.why.empty() ? "" : ": " + v.why) + ".";
}

std::string verification_text(DesignTask const& task, Verification const& v) {
    std::string text = verification_sentence(task, v);
    text += fmt::format(" Core time: {:.3g} h.\n", v.core_time / seconds_per_hour);
    if (v.machines.empty()) return text;
    constexpr char const* line = "{:<8} {:>7} {:>7} {:>6} {:>7} {:>9} {:>16} {:>16} {:>7} {:>12}  {}\n";
    text += "\n" + fmt::format(fmt::runtime(line), "machine", "stroke", "speed", "angle", "depth", "friction",
                               "promised", "simulated", "", "probability", "by");
    std::string const units = fmt::format(fmt::runtime(line), "", "mm", "1/min", "deg", "mm", "",
                                          "efficiency", "efficiency", "", "", "");
    text += units.substr(0, units.find_last_not_of(" \n") + 1) + "\n";
    int number = 0;
    for (SimulatedMachine const& m : v.machines) {
        ++number;
        auto const digits = [](double value, int count) { return fmt::format("{:.{}g}", value, count); };
        std::string const probability =
            m.probability ? fmt::format("{:.1f} %", 100 * *m.probability) : "not known";
        for (ComparedLayer const& layer : m.layers) {
            bool const first = &layer == &m.layers.front();
            text +=
                fmt::format(fmt::runtime(line), number, digits(2e3 * m.drive.amplitude, 4),
                            digits(60 * m.drive.frequency, 4), digits(m.drive.vibration_angle / degree, 3),
                            digits(1e3 * m.depth, 3), fmt::format("{:.3f}", layer.friction),
                            fmt::format("{:.3f} +- {:.3f}", layer.promised, layer.promised_half_width),
                            fmt::format("{:.3f} +- {:.3f}", layer.simulated, layer.simulated_half_width),
                            layer.agrees() ? "agree" : "differ", first ? probability : "", layer.model);
        }
    }
    return text;
}

Json verification_json(Verification const& v) {
    Json json{{"verdict", name_of(v.verdict)},
              {"why", v.why},
              {"core_hours", v.core_time / seconds_per_hour},
              {"machines", Json::array()}};
    for (SimulatedMachine const& m : v.machines) {
        Json layers = Json::array();
        for (ComparedLayer const& layer : m.layers) {
            layers.push_back({{"friction", layer.friction},
                              {"model", layer.model},
                              {"promised", layer.promised},
                              {"promised_half_width", layer.promised_half_width},
                              {"simulated", layer.simulated},
                              {"simulated_half_width", layer.simulated_half_width},
                              {"agrees", layer.agrees()}});
        }
        json["machines"].push_back({{"campaign", m.campaign},
                                    {"stroke_mm", 2e3 * m.drive.amplitude},
                                    {"rpm", 60 * m.drive.frequency},
                                    {"vibration_angle_deg", m.drive.vibration_angle / degree},
                                    {"inclination_deg", m.drive.inclination / degree},
                                    {"layer_depth_mm", 1e3 * m.depth},
                                    {"probability", m.probability ? Json(*m.probability) : Json(nullptr)},
                                    {"layers", layers}});
    }
    return json;
}

}  // namespace vibrotrough::learn
