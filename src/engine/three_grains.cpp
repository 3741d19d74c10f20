#include "engine/three_grains.hpp"

#include "core/error.hpp"
#include "deck/check.hpp"
#include "deck/render.hpp"
#include "engine/probe_output.hpp"
#include "scenario/model/scenario.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

namespace vibrotrough::engine {
namespace {

namespace fs = std::filesystem;

constexpr double spacing = 0.03;  // m between groups; the largest grain has 20 mm
constexpr double middle = 0.05;   // m, y of the small grains
constexpr double friction = 0.5;  // grain on grain in probe_world()
constexpr double degree = std::numbers::pi / 180;
constexpr int samples = 400;
constexpr char const* paper = "Vyas et al., Computer Physics Communications 310 (2025) 109524";

std::string text(double number) {
    return fmt::format("{}", number);
}

/// The place of one group.
struct Group {
    double ratio;             ///< large over small diameter
    double half_distance;     ///< m, of the large grains' centres
    double small_x, small_z;  ///< m, of the small grain relative to the middle of the large ones
};

double group_x(std::size_t number) {
    return spacing * (static_cast<double>(number) + 0.5);
}

/// The longest time step of campaign decks for grains of this size, s.
double longest_step(double small_diameter) {
    ContactMaterial material = probe_material(0.5, friction);
    material.radius = small_diameter / 2;
    return 0.2 * rayleigh_time(material);
}

core::TemplateData data_of(std::vector<Group> const& groups, std::string const& title, double small_diameter,
                           double duration) {
    double const time_step = longest_step(small_diameter);
    int const every = std::max(1, static_cast<int>(duration / time_step / samples));
    core::TemplateData values = probe_world(title, time_step);
    values.set("length", text(spacing * static_cast<double>(groups.size())));
    values.set("width", text(2 * middle));
    values.set("bottom", "-0.2");
    values.set("diameter", text(small_diameter));
    values.set("sample_steps", std::to_string(every));
    values.set("steps", std::to_string(every * (static_cast<int>(duration / time_step / every) + 2)));
    std::vector<core::TemplateData> list;
    for (std::size_t i = 0; i < groups.size(); ++i) {
        Group const& group = groups[i];
        core::TemplateData one;
        one.set("x", text(group_x(i)));
        one.set("y", text(middle));
        one.set("left_y", text(middle - group.half_distance));
        one.set("right_y", text(middle + group.half_distance));
        one.set("small_x", text(group_x(i) + group.small_x));
        one.set("small_z", text(group.small_z));
        one.set("large_diameter", text(group.ratio * small_diameter));
        one.set("left_id", std::to_string(3 * i + 1));
        one.set("right_id", std::to_string(3 * i + 2));
        one.set("small_id", std::to_string(3 * i + 3));
        list.push_back(one);
    }
    values.set("groups", list);
    return values;
}

ProbeResult probe(std::string name, Comparison comparison, double expected, double tolerance,
                  std::string unit) {
    return {std::move(name),
            {},
            {},
            std::move(unit),
            comparison,
            expected,
            std::numeric_limits<double>::quiet_NaN(),
            tolerance,
            {},
            {}};
}

template <typename Measure>
std::vector<ProbeResult> answer(std::vector<ProbeResult> probes, std::string problem, Measure&& measure) {
    try {
        if (problem.empty()) measure(probes);
    } catch (core::InputError const& error) {
        problem = error.what();
    }
    for (ProbeResult& one : probes) one.problem = problem;
    return probes;
}

/// Distance of the small grain's centre from the line of the large grains' centres while it touches both and
/// these touch each other, in radii of the small grain: sqrt((q + 1)^2 - q^2).
double gap_distance(double ratio) {
    return std::sqrt(2 * ratio + 1);
}

double time_between_samples(double small_diameter, double duration) {
    double const time_step = longest_step(small_diameter);
    return time_step * std::max(1, static_cast<int>(duration / time_step / samples));
}

double longest_roll(GapRoll const& roll) {
    return rolling_time(roll, deck::probed_size_ratios.back());
}

/// The angle of a small grain at a time, between two samples by a straight line.
double angle_at(std::vector<std::vector<GrainSample>> const& times, std::size_t group, double sample) {
    auto const angle = [&](std::size_t i) {
        GrainSample const& grain = times.at(i)[3 * group + 2];
        return std::atan2(grain.x - group_x(group), grain.z);
    };
    auto const before = static_cast<std::size_t>(sample);
    if (before + 1 >= times.size()) throw core::InputError("grains.dump ends too early; is the disk full?");
    double const part = sample - static_cast<double>(before);
    return (1 - part) * angle(before) + part * angle(before + 1);
}

/// Below and above the limit for each ratio.
std::vector<Group> nip_groups(Nip const& nip) {
    std::vector<Group> groups;
    for (double const ratio : deck::probed_size_ratios) {
        for (double const side : {-1, 1}) {
            double const angle = std::atan(friction) + side * nip.beside_limit;
            double const reach = (ratio + 1) * nip.small_diameter / 2;
            groups.push_back({ratio, reach * std::cos(angle), reach * std::sin(angle), 0});
        }
    }
    return groups;
}

}  // namespace

double rolling_time(GapRoll const& roll, double ratio) {
    double const r = roll.small_diameter / 2, distance = r * gap_distance(ratio);
    double const inertia = 1 + 0.4 * std::pow((ratio + 1) / gap_distance(ratio), 2);
    double const rate = scenario::gravity / (distance * inertia);
    // Energy: phi'^2 = 2 rate (cos(phi_0) - cos(phi)). With phi = phi_0 + u^2 the integrand of the time,
    // dphi / phi', stays finite where the grain starts; the midpoint rule is then good to 1e-8.
    constexpr int parts = 20000;
    double const width = std::sqrt(roll.end_angle - roll.start_angle) / parts;
    double time = 0;
    for (int i = 0; i < parts; ++i) {
        double const u = (i + 0.5) * width, angle = roll.start_angle + u * u;
        time += 2 * u * width / std::sqrt(2 * rate * (std::cos(roll.start_angle) - std::cos(angle)));
    }
    return time;
}

ProbeDeck gap_roll_deck() {
    GapRoll const roll;
    std::vector<Group> groups;
    for (double const ratio : deck::probed_size_ratios) {
        double const r = roll.small_diameter / 2, distance = r * gap_distance(ratio);
        groups.push_back(
            {ratio, ratio * r, distance * std::sin(roll.start_angle), distance * std::cos(roll.start_angle)});
    }
    core::TemplateData const values =
        data_of(groups, "a small grain rolls over the gap between two large ones", roll.small_diameter,
                longest_roll(roll));
    return {"three-grains-roll", {{"in.liggghts", deck::render_template("probes/three_grains", values)}}};
}

ProbeDeck nip_deck() {
    Nip const nip;
    core::TemplateData values =
        data_of(nip_groups(nip), "two large grains squeeze a small one", nip.small_diameter, nip.duration);
    values.set("gravity", "0");
    values.set("approach", true);
    values.set("speed", text(nip.speed));
    return {"three-grains-nip", {{"in.liggghts", deck::render_template("probes/three_grains", values)}}};
}

std::vector<ProbeResult> judge_gap_roll(fs::path const& folder, std::string const& problem) {
    GapRoll const roll;
    std::vector<ProbeResult> probes;
    for (double const ratio : deck::probed_size_ratios) {
        ProbeResult one = probe(fmt::format("three-grains-roll-{}", ratio), Comparison::near,
                                roll.end_angle / degree, 0.1, "degree");
        one.question = fmt::format(
            "A small grain rolls from {:.0f} degrees over the gap between two grains that are {} times as "
            "large: what is its angle when it should be at {:.0f} degrees?",
            roll.start_angle / degree, ratio, roll.end_angle / degree);
        one.source = fmt::format(
            "energy of a grain that rolls on both; {} found grains caught from a ratio of "
            "about 3 on",
            paper);
        one.tolerance_reason =
            "contacts are soft, and an error of the start grows fourfold until the end; 0.01 was found";
        probes.push_back(one);
    }
    return answer(std::move(probes), problem, [&](std::vector<ProbeResult>& list) {
        auto const times = read_samples(folder / "grains.dump", 3 * list.size());
        double const interval = time_between_samples(roll.small_diameter, longest_roll(roll));
        for (std::size_t i = 0; i < list.size(); ++i) {
            double const time = rolling_time(roll, deck::probed_size_ratios.at(i));
            list[i].measured = angle_at(times, i, time / interval) / degree;
        }
    });
}

std::vector<ProbeResult> judge_nip(fs::path const& folder, std::string const& problem) {
    Nip const nip;
    auto const count = static_cast<double>(deck::probed_size_ratios.size());
    ProbeResult held = probe("three-grains-held", Comparison::at_most, 0, nip.held, "1");
    held.question =
        "Two large grains squeeze a small one, 1 degree below the angle at which friction holds it: how far "
        "does it "
        "move in its radii, at most, over all size ratios?";
    held.source = "tan(angle) < mu, the nip of a roller crusher, whatever the sizes";
    held.tolerance_reason =
        "the springs of the contacts yield by 0.002 radii; an expelled grain moves by 0.12";
    ProbeResult expelled = probe("three-grains-expelled", Comparison::near, count, 0, "1");
    expelled.question =
        "The same, 1 degree above that angle: at how many of the size ratios is the small grain expelled?";
    expelled.source = fmt::format("tan(angle) > mu, whatever the sizes; {} found grains caught", paper);
    expelled.tolerance_reason = "none: a grain that moves by less than 0.05 radii is caught";
    return answer({held, expelled}, problem, [&](std::vector<ProbeResult>& list) {
        auto const groups = nip_groups(nip);
        auto const last = read_samples(folder / "grains.dump", 3 * groups.size()).back();
        double const radius = nip.small_diameter / 2;
        list[0].measured = list[1].measured = 0;
        for (std::size_t i = 0; i < groups.size(); ++i) {
            double const moved = (last[3 * i + 2].x - group_x(i) - groups[i].small_x) / radius;
            bool const below = i % 2 == 0;
            if (below) list[0].measured = std::max(list[0].measured, std::abs(moved));
            if (!below && moved > nip.expelled) list[1].measured += 1;
        }
    });
}

}  // namespace vibrotrough::engine
