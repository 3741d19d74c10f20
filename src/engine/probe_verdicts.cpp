#include "engine/probe_verdicts.hpp"

#include "core/error.hpp"
#include "engine/probe_decks.hpp"
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
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr char const* law_source =
    "Tsuji, Tanaka & Ishida (1992), Hertz with limitForce and a tangential spring, integrated by this "
    "program";

ProbeResult near_to(std::string name, double expected, double tolerance, std::string unit) {
    return {std::move(name), {}, {}, std::move(unit), Comparison::near, expected, unknown, tolerance, {}, {}};
}

ProbeResult at_most(std::string name, double expected, double tolerance, std::string unit) {
    ProbeResult probe = near_to(std::move(name), expected, tolerance, std::move(unit));
    probe.comparison = Comparison::at_most;
    return probe;
}

/// Lets `measure` fill in the measured values, unless the engine failed.
template <typename Measure>
std::vector<ProbeResult> answer(std::vector<ProbeResult> probes, std::string problem, Measure&& measure) {
    try {
        if (problem.empty()) measure(probes);
    } catch (core::InputError const& error) {
        problem = error.what();
    }
    for (ProbeResult& probe : probes) probe.problem = problem;
    return probes;
}

/// The result of an impact, from the velocities before and after it.
struct ImpactMeasures {
    double restitution;    ///< normal speed after / before
    double coulomb_ratio;  ///< tangential impulse / (friction * normal impulse)
    double energy_ratio;   ///< kinetic energy, rotation included, after / before
};

ImpactMeasures measures(Impact const& impact, double vx, double vz, double spin) {
    double const radius = probe_material(0.5, impact_friction).radius;
    double const before = std::pow(impact.normal_speed, 2) + std::pow(impact.tangential_speed, 2);
    return {vz / impact.normal_speed,
            std::abs(impact.tangential_speed - vx) / (impact_friction * (impact.normal_speed + vz)),
            (vx * vx + vz * vz + 0.4 * std::pow(radius * spin, 2)) / before};
}

std::vector<ImpactMeasures> measured_impacts(fs::path const& folder, std::vector<Impact> const& impacts) {
    auto const after = read_samples(folder / "grains.dump", impacts.size()).back();
    std::vector<ImpactMeasures> all;
    for (std::size_t i = 0; i < impacts.size(); ++i)
        all.push_back(measures(impacts[i], after[i].vx, after[i].vz, after[i].spin));
    return all;
}

ImpactMeasures by_law(Impact const& impact) {
    double const nominal = probed_restitutions.at(static_cast<std::size_t>(impact.type - 1));
    auto const law = integrate_impact(probe_material(nominal, impact_friction), impact.normal_speed,
                                      impact.tangential_speed);
    return measures(impact, law.tangential_speed, law.normal_speed, law.spin);
}

double largest(std::vector<ImpactMeasures> const& all, double ImpactMeasures::*member) {
    return (*std::ranges::max_element(all, {}, member)).*member;
}

/// The largest deviation from the contact law among the impacts for which `chosen` is true.
template <typename Chosen>
double worst(std::vector<Impact> const& impacts, std::vector<ImpactMeasures> const& all,
             double ImpactMeasures::*member, Chosen&& chosen) {
    double deviation = 0;
    for (std::size_t i = 0; i < impacts.size(); ++i) {
        if (chosen(impacts[i]))
            deviation = std::max(deviation, std::abs(all[i].*member - by_law(impacts[i]).*member));
    }
    return deviation;
}

bool is_oblique(Impact const& impact) {
    return impact.tangential_speed != 0;
}

ProbeResult energy_probe(std::string name) {
    ProbeResult probe = at_most(std::move(name), 1, 0, "1");
    probe.question =
        "Does any impact gain energy? Largest ratio of the kinetic energies after and before the impact, "
        "including rotation.";
    probe.source = "conservation of energy";
    probe.tolerance_reason = "none: a contact can only dissipate energy";
    return probe;
}

ProbeResult coulomb_probe(std::string name, double tolerance, std::string reason) {
    ProbeResult probe = at_most(std::move(name), 1, tolerance, "1");
    probe.question =
        "Does friction obey Coulomb's law? Largest ratio of the tangential impulse to mu times the normal "
        "impulse.";
    probe.source =
        "Coulomb; without the contact options of the decks the ratio is 2.4 at nominal restitution 0.05";
    probe.tolerance_reason = std::move(reason);
    return probe;
}

ProbeResult impulse_probe(std::string name, std::string const& kind) {
    ProbeResult probe = at_most(std::move(name), 0, 0.003, "1");
    probe.question = fmt::format(
        "Oblique impacts that {}: largest deviation of tangential impulse / (mu normal impulse) from the "
        "contact law",
        kind);
    probe.source = law_source;
    probe.tolerance_reason = "engine and contact law agreed to 5e-4 with time steps of 1/1000 of a contact";
    return probe;
}

bool slides(Impact const& impact) {
    return impact.tangential_speed > impact.normal_speed;
}

bool grips(Impact const& impact) {
    return is_oblique(impact) && !slides(impact);
}

}  // namespace

std::vector<ProbeResult> judge_fine_impacts(fs::path const& folder, std::string const& problem) {
    auto const& impacts = fine_impacts();
    std::vector<ProbeResult> probes;
    for (std::size_t i = 0; i < probed_restitutions.size(); ++i) {
        ProbeResult probe = near_to(fmt::format("restitution-{}", probed_restitutions[i]),
                                    by_law(impacts[i]).restitution, 0.003, "1");
        probe.question =
            fmt::format("Normal impact at nominal restitution {}: what is the realised restitution?",
                        probed_restitutions[i]);
        probe.source = law_source;
        probe.tolerance_reason =
            "engine and contact law agreed to 5e-4 with time steps of 1/1000 of a contact";
        probes.push_back(probe);
    }
    probes.push_back(coulomb_probe("coulomb", 1e-6, "the limit holds in every step, up to rounding"));
    probes.push_back(impulse_probe("sliding-impulse", "slide throughout"));
    probes.push_back(impulse_probe("gripping-impulse", "grip"));
    probes.push_back(energy_probe("energy"));
    return answer(std::move(probes), problem, [&](std::vector<ProbeResult>& list) {
        auto const all = measured_impacts(folder, impacts);
        for (std::size_t i = 0; i < probed_restitutions.size(); ++i) list[i].measured = all[i].restitution;
        list[5].measured = largest(all, &ImpactMeasures::coulomb_ratio);
        list[6].measured = worst(impacts, all, &ImpactMeasures::coulomb_ratio, slides);
        list[7].measured = worst(impacts, all, &ImpactMeasures::coulomb_ratio, grips);
        list[8].measured = largest(all, &ImpactMeasures::energy_ratio);
    });
}

std::vector<ProbeResult> judge_coarse_impacts(fs::path const& folder, std::string const& problem) {
    auto const& impacts = coarse_impacts();
    ProbeResult restitution = at_most("restitution-at-longest-step", 0, 0.03, "1");
    restitution.question =
        "At 20 % of the Rayleigh time, the longest time step of the decks: how far is the realised "
        "restitution from the contact law?";
    restitution.source = law_source;
    restitution.tolerance_reason =
        "0.021 was found at nominal restitution 0.1, because the contact begins and ends at any time within "
        "a step";
    std::vector<ProbeResult> probes{
        restitution,
        coulomb_probe("coulomb-at-longest-step", 1e-6, "the limit holds in every step, up to rounding"),
        energy_probe("energy-at-longest-step")};
    return answer(std::move(probes), problem, [&](std::vector<ProbeResult>& list) {
        auto const all = measured_impacts(folder, impacts);
        list[0].measured =
            worst(impacts, all, &ImpactMeasures::restitution, [](Impact const&) { return true; });
        list[1].measured = largest(all, &ImpactMeasures::coulomb_ratio);
        list[2].measured = largest(all, &ImpactMeasures::energy_ratio);
    });
}

namespace {

/// The slope of a grain's velocity over the second half of the run, when the spring of the contact is loaded.
double acceleration(std::vector<std::vector<GrainSample>> const& times, std::size_t grain, double interval) {
    double n = 0, t_sum = 0, v_sum = 0, tt = 0, tv = 0;
    for (std::size_t i = times.size() / 2; i < times.size(); ++i) {
        double const t = static_cast<double>(i) * interval, v = times[i][grain].vx;
        n += 1;
        t_sum += t;
        v_sum += v;
        tt += t * t;
        tv += t * v;
    }
    return (n * tv - t_sum * v_sum) / (n * tt - t_sum * t_sum);
}

std::vector<ProbeResult> incline_probes() {
    Incline const incline;
    double const sine = std::sin(incline.angle), cosine = std::cos(incline.angle);
    ContactMaterial const material = probe_material(0.5, incline.holding_friction);
    double const stiffness =
        8 * effective_shear(material) * std::sqrt(material.radius * resting_overlap(incline.angle));
    double const spring = sphere_mass(material) * scenario::gravity * sine / stiffness;
    ProbeResult sticking = at_most("sticking", 2 * spring, 0.05 * 2 * spring, "m");
    sticking.question =
        "A grain that cannot rotate, on an incline below its friction angle: how far does it move in 0.1 s?";
    sticking.source =
        "the undamped spring of the contact, k = 8 G* sqrt(R d), oscillates up to 2 m g sin(a) / k; a "
        "sliding grain would move 6 mm";
    sticking.tolerance_reason = "5 %: the normal overlap oscillates a little as well";
    double const sliding_expected = scenario::gravity * (sine - incline.sliding_friction * cosine);
    ProbeResult sliding = near_to("sliding", sliding_expected, 1e-3 * sliding_expected, "m/s2");
    sliding.question = "The same grain above its friction angle: what is its acceleration?";
    sliding.source = "g (sin(a) - mu cos(a))";
    sliding.tolerance_reason = "0.1 %; 1e-9 was found";
    double const rolling_expected = 5.0 / 7 * scenario::gravity * sine;
    ProbeResult rolling = near_to("rolling", rolling_expected, 2e-3 * rolling_expected, "m/s2");
    rolling.question = "A sphere that can rotate, with enough friction to roll: what is its acceleration?";
    rolling.source = "5/7 g sin(a), a rolling sphere";
    rolling.tolerance_reason =
        "0.2 %: the overlap shortens the lever arm by 0.04 %, and the undamped spring oscillates; 0.04 % was "
        "found";
    return {sticking, sliding, rolling};
}

}  // namespace

std::vector<ProbeResult> judge_incline(fs::path const& folder, std::string const& problem) {
    return answer(incline_probes(), problem, [&](std::vector<ProbeResult>& list) {
        Incline const incline;
        auto const times = read_samples(folder / "grains.dump", 3);
        double const interval = incline.time_step * incline.sample_steps;
        double reach = 0;
        for (auto const& grains : times) reach = std::max(reach, std::abs(grains[0].x - times.front()[0].x));
        list[0].measured = reach;
        list[1].measured = acceleration(times, 1, interval);
        list[2].measured = acceleration(times, 2, interval);
    });
}

std::vector<ProbeResult> judge_contact(fs::path const& folder, std::string const& problem) {
    MovingTrough const motion = sliding_trough();
    ProbeResult least = near_to("weight-least", 1, 1e-6, "1");
    least.question = fmt::format(
        "{} grains at the overlap that carries their weight, with the trough moving under them for a cycle: "
        "what is the smallest force / (m g)?",
        motion.grains);
    least.source =
        "each grain has exactly one contact with the trough, also at edges, diagonals and periodic faces";
    least.tolerance_reason =
        "one contact more or less changes it by 0.036; the force follows Hertz's law up to rounding";
    ProbeResult most = least;
    most.name = "weight-most";
    most.question = "The same deck: what is the largest force / (m g)?";
    return answer({least, most}, problem, [&](std::vector<ProbeResult>& list) {
        ContactMaterial const material = probe_material(0.5, 0.5);
        auto const samples = read_trough_samples(folder / "trough.csv");
        double const weight = motion.grains * sphere_mass(material) * scenario::gravity;
        auto const [low, high] = std::ranges::minmax_element(samples, {}, &TroughSample::force_z);
        list[0].measured = -high->force_z / weight;  // the grains press downwards
        list[1].measured = -low->force_z / weight;
        for (TroughSample const& sample : samples) {
            if (sample.grains != motion.grains)
                throw core::InputError(
                    fmt::format("{:g} grains instead of {}", sample.grains, motion.grains));
        }
    });
}

std::vector<ProbeResult> judge_drive(fs::path const& folder, std::string const& problem) {
    MovingTrough const motion = flying_trough();
    ProbeResult drive = at_most("drive", 0, 1e-6, "1");
    drive.question =
        "The motion of the trough over a cycle: what is the largest deviation from A sin(omega t), divided "
        "by the amplitude?";
    drive.source = "the deck sets the velocities (X(t) - X(t - dt)) / dt, whose sum is X(t)";
    drive.tolerance_reason = "rounding; 1e-14 was found";
    return answer({drive}, problem, [&](std::vector<ProbeResult>& list) {
        double const amplitude = std::hypot(motion.amplitude_x, motion.amplitude_z);
        auto const samples = read_trough_samples(folder / "trough.csv");
        if (samples.back().step != motion.steps)
            throw core::InputError("trough.csv does not contain the whole cycle");
        double largest_deviation = 0;
        for (TroughSample const& sample : samples) {
            double const displacement = std::sin(2 * std::numbers::pi * sample.step / motion.steps);
            largest_deviation =
                std::max(largest_deviation, std::hypot(sample.x - motion.amplitude_x * displacement,
                                                       sample.z - motion.amplitude_z * displacement));
        }
        list[0].measured = largest_deviation / amplitude;
    });
}

}  // namespace vibrotrough::engine
