// What the page calls: functions with arrays of doubles, and texts as JSON. The names of all numbers are in
// page_names(), so that the scripts of the page have no list of their own.

#include "page/machine.hpp"
#include "theory/errors.hpp"
#include "theory/unusual.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

using namespace vibrotrough;

namespace {

using Json = nlohmann::json;  // numbers that are not finite are null

page::Machines& machines() {
    static page::Machines all;
    return all;
}

std::string& last_error() {
    static std::string text;
    return text;
}

/// The modes that were seen, so that an array of doubles can hold them: 0 is none.
std::vector<theory::ModeCode>& modes() {
    static std::vector<theory::ModeCode> seen{0};
    return seen;
}

double number_of(theory::ModeCode mode) {
    auto const found = std::find(modes().begin(), modes().end(), mode);
    if (found == modes().end()) modes().push_back(mode);
    return static_cast<double>(std::find(modes().begin(), modes().end(), mode) - modes().begin());
}

page::Settings settings_of(double const* numbers) {
    page::Settings settings{};
    std::copy_n(numbers, page::setting_count, settings.value.begin());
    return settings;
}

std::vector<std::string> speed_names(std::string const& of) {
    std::vector<std::string> names;
    for (char const* const name :
         {"efficiency", "speed", "low", "high", "flow", "flow_low", "flow_high", "mode"})
        names.push_back(of + "_" + name);
    return names;
}

void append(std::vector<double>& numbers, page::Speed const& s) {
    for (double const value :
         {s.efficiency, s.speed, s.low, s.high, s.flow, s.flow_low, s.flow_high, number_of(s.mode)})
        numbers.push_back(value);
}

std::vector<std::string> answer_names() {
    std::vector<std::string> names{"throw_number", "machine_number", "trough_speed", "depth_in_grains",
                                   "rule_speed",   "rule_flow",      "model",        "trust"};
    for (char const* const of : {"mass", "layer", "atlas", "best"}) {
        auto const more = speed_names(of);
        names.insert(names.end(), more.begin(), more.end());
    }
    return names;
}

std::vector<double> numbers_of(page::Answer const& a) {
    std::vector<double> numbers{a.throw_number,
                                a.machine_number,
                                a.trough_speed,
                                a.depth_in_grains,
                                a.rule_speed,
                                a.rule_flow,
                                static_cast<double>(a.model),
                                static_cast<double>(a.trust)};
    for (page::Speed const* const speed : {&a.mass, &a.layer, &a.atlas, &a.best}) append(numbers, *speed);
    return numbers;
}

void put(page::Answer const& answer, double* numbers) {
    std::vector<double> const list = numbers_of(answer);
    std::copy(list.begin(), list.end(), numbers);
}

Json described(theory::Motion const& motion) {
    Json phases = Json::array();
    for (theory::Phase const& phase : motion.phases)
        phases.push_back(
            {{"kind", theory::to_string(phase.kind)}, {"start", phase.start}, {"end", phase.end}});
    return {{"mode", motion.mode},
            {"outcome", theory::to_string(motion.outcome)},
            {"period_cycles", motion.period_cycles},
            {"flight_number", motion.flight_number},
            {"phases", std::move(phases)}};
}

Json described_landing(page::Settings const& settings, theory::Motion const& motion) {
    if (motion.outcome != theory::Outcome::periodic || motion.phases.empty()) return nullptr;
    page::Landing const found = page::landing(settings);
    return {{"impact_speed", found.impact_speed}, {"power_per_area", found.power_per_area}};
}

Json words(page::Settings const& settings) {
    theory::Motion const mass = theory::solve(settings.inputs().point()),
                         layer = theory::solve(page::layer_of(settings)).motion;
    page::Answer const answer = machines()(settings);
    auto const why = page::untested(settings, answer);
    Json outside = Json::array();
    for (atlas::Outside const& one : page::outside_atlas(settings)) outside.push_back(one.why);
    return {{"mass", described(mass)},
            {"layer", described(layer)},
            {"landing", described_landing(settings, mass)},
            {"untested", why ? Json(*why) : Json()},
            {"outside_atlas", std::move(outside)},
            {"unusual", page::unusual(settings, answer)}};
}

/// Runs a function whose errors are told by page_error(). @return 0, or 1 after an error
template <class Function>
int guarded(Function const& function) {
    try {
        function();
        return 0;
    } catch (std::exception const& error) {
        last_error() = error.what();
        return 1;
    }
}

}  // namespace

extern "C" {

/// Why the last function failed.
char const* page_error() {
    return last_error().c_str();
}

/// The names of settings, of the numbers of an answer and of a frame.
char const* page_names() {
    static std::string text;
    text =
        Json({{"settings", page::setting_names()},
              {"answer", answer_names()},
              {"frame",
               {"time", "kind", "trough_x", "trough_y", "travel", "gap", "normal_force", "tangential_force"}},
              {"largest_usual_machine_number", theory::largest_usual_machine_number}})
            .dump();
    return text.c_str();
}

/// The letters of a mode by the number that stands for it in an answer.
char const* page_mode(int number) {
    static std::string text;
    bool const known = number >= 0 && static_cast<std::size_t>(number) < modes().size();
    text = known ? theory::to_string(modes()[static_cast<std::size_t>(number)]) : "";
    return text.c_str();
}

/// Gets the atlas ready.
int page_prepare_atlas() {
    return guarded([] { machines().prepare_atlas(); });
}

/// @param numbers  in the order of answer_names()
int page_answer(double const* settings, double* numbers) {
    return guarded([&] { put(machines()(settings_of(settings)), numbers); });
}

/// Answers at equally spaced values of one setting, one after another; NaN where there is none.
int page_curve(double const* settings, int axis, double from, double to, int count, double* numbers) {
    std::size_t const width = answer_names().size();
    auto const setting = static_cast<page::Setting>(axis);
    return guarded([&] {
        for (int i = 0; i < count; ++i, numbers += width) {
            double const value = count < 2 ? from : from + (to - from) * i / (count - 1);
            std::fill_n(numbers, width, std::nan(""));
            try {
                put(machines()(settings_of(settings).with(setting, value)), numbers);
            } catch (theory::PhaseError const&) {
            }
        }
    });
}

/// One row of a map: efficiency, speed, mode and machine number at equally spaced values of one setting.
int page_map_row(double const* settings, int axis, double from, double to, int count, int rolling,
                 double* numbers) {
    auto const setting = static_cast<page::Setting>(axis);
    return guarded([&] {
        for (int i = 0; i < count; ++i, numbers += 4) {
            double const value = count < 2 ? from : from + (to - from) * i / (count - 1);
            std::fill_n(numbers, 4, std::nan(""));
            try {
                page::Settings const here = settings_of(settings).with(setting, value);
                theory::Inputs const inputs = here.inputs();
                auto const grains =
                    rolling ? std::optional(here[page::Setting::rolling_friction]) : std::nullopt;
                theory::Efficiency const found = machines().efficiency(inputs.point(), grains);
                numbers[0] = found.velocity_efficiency;
                numbers[1] = found.velocity_efficiency * inputs.velocity_scale().value();
                numbers[2] = number_of(found.mode);
                numbers[3] = theory::machine_number(inputs.point());
            } catch (theory::PhaseError const&) {
            }
        }
    });
}

/// The motion over a period, `count` frames of 8 numbers.
int page_frames(double const* settings, int rolling, int count, double* numbers) {
    return guarded([&] {
        for (page::Frame const& f : page::frames(settings_of(settings), rolling != 0, count)) {
            for (double const value : {f.time, f.kind, f.trough_x, f.trough_y, f.travel, f.gap,
                                       f.normal_force, f.tangential_force})
                *numbers++ = value;
        }
    });
}

/// Phases, landing, and what is not tested or unusual, as JSON; empty after an error.
char const* page_words(double const* settings) {
    static std::string text;
    text.clear();
    guarded([&] { text = words(settings_of(settings)).dump(); });
    return text.c_str();
}
}
