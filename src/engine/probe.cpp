#include "engine/probe.hpp"

#include "core/atomic_file.hpp"
#include "core/hash.hpp"
#include "core/temporary_folder.hpp"
#include "core/time.hpp"
#include "deck/deck.hpp"
#include "deck/render.hpp"
#include "deck/trough_mesh.hpp"
#include "engine/contact_law.hpp"
#include "engine/run_report.hpp"
#include "engine/stop_signals.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <sstream>

#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <fmt/format.h>

namespace vibrotrough::engine {
namespace {

namespace fs = std::filesystem;
using core::TemplateData;

/// Version of the verdicts. Increase it with every change of them, so that certificates are made again.
constexpr int judgement = 3;

/// An engine that needs longer than this is considered to hang.
constexpr std::chrono::seconds patience{120};

/// Nominal restitution coefficients of grain types 1 to 5 on the floor.
constexpr std::array<double, 5> restitutions{0.1, 0.3, 0.5, 0.7, 0.9};
constexpr double friction = 0.23;
constexpr double side = 0.1;        // m, of the square floor
constexpr double time_step = 5e-7;  // s, 1/1000 of a contact, which resolves the contact law
constexpr double duration = 1e-3;   // s, in which all impacts end
constexpr double first_gap = 1e-5;  // m, between grain and floor
constexpr char const* grains_file = "grains.dump";

/// One impact. The number of the grain (from 1) is its position in the list of impacts.
struct Impact {
    int type;                 ///< of the grain, from 1
    double normal_speed;      ///< m/s
    double tangential_speed;  ///< m/s
};

/// Normal impacts; impacts so oblique that the contact slides throughout; impacts so steep that it grips.
std::vector<Impact> impacts() {
    std::vector<Impact> list;
    for (auto const& [normal, tangential] : {std::pair{0.5, 0.0}, {0.25, 0.5}, {0.25, 0.1}}) {
        for (int type = 1; type <= static_cast<int>(restitutions.size()); ++type)
            list.push_back({type, normal, tangential});
    }
    return list;
}

/// Grains of 3 mm, with which the contact options of the decks were chosen.
ContactMaterial material_of(Impact const& impact) {
    return {0.0015, 1400, 5e6, 0.35, restitutions.at(static_cast<std::size_t>(impact.type - 1)), friction};
}

std::string text(double number) {
    return fmt::format("{}", number);
}

/// `count` numbers with spaces between them.
template <typename Value>
std::string list_of(std::size_t count, Value&& value) {
    std::string list;
    for (std::size_t i = 0; i < count; ++i) list += fmt::format("{}{}", i == 0 ? "" : " ", value(i));
    return list;
}

}  // namespace

std::map<std::string, std::string> probe_deck() {
    std::vector<Impact> const list = impacts();
    ContactMaterial const material = material_of(list.front());
    std::size_t const types = restitutions.size() + 1;  // the last one is the floor
    TemplateData values;
    std::vector<TemplateData> grains(list.size());
    for (std::size_t i = 0; i < list.size(); ++i) {
        grains[i].set("id", std::to_string(i + 1));
        grains[i].set("type", std::to_string(list[i].type));
        // Away from the nodes and edges of the mesh, and so far apart that grains do not touch each other.
        grains[i].set("x", text(0.0071 + 0.009 * static_cast<double>(i % 10)));
        grains[i].set("y", text(0.0053 + 0.009 * static_cast<double>(i / 10)));
        grains[i].set("z", text(material.radius + first_gap));
        grains[i].set("vx", text(list[i].tangential_speed));
        grains[i].set("vz", text(-list[i].normal_speed));
    }
    values.set("grains", grains);
    values.set("floor_type", std::to_string(types));
    values.set("side", text(side));
    values.set("skin", text(0.6 * material.radius));
    values.set("time_step", text(time_step));
    values.set("moduli", list_of(types, [&](std::size_t) { return material.youngs_modulus; }));
    values.set("poisson_ratios", list_of(types, [&](std::size_t) { return material.poisson_ratio; }));
    // Of each pair of types; only those with the floor matter.
    values.set("restitutions", list_of(types * types, [&](std::size_t i) {
                   return restitutions[std::min({i / types, i % types, restitutions.size() - 1})];
               }));
    values.set("frictions", list_of(types * types, [](std::size_t) { return friction; }));
    values.set("diameter", text(2 * material.radius));
    values.set("density", text(material.density));
    values.set("steps", std::to_string(std::lround(duration / time_step)));
    return {{"in.liggghts", deck::render_template("probes/impact", values)},
            {"trough.stl", deck::flat_trough_stl(side, side, side / 5)}};
}

namespace {

/// Runs the deck in the folder. @return why the engine failed, an empty text when it did not; none if it was
/// interrupted
std::optional<std::string> run_deck(Engine const& engine, fs::path const& folder,
                                    std::map<std::string, std::string> const& files) {
    for (auto const& [name, content] : files) core::write_file_atomically(folder / name, content);
    boost::asio::io_context context;
    boost::asio::signal_set signals(context);
    add_stop_signals(signals);
    boost::asio::steady_timer clock(context, patience);
    bool interrupted = false;
    std::string problem;
    EngineProcess process(context, engine, folder, [&](ExitStatus status) {
        problem = examine_run(folder, status, Stage::driving).message;
        signals.cancel();
        clock.cancel();
    });
    signals.async_wait([&](auto const& cancelled, int) {
        if (cancelled) return;
        interrupted = true;
        process.terminate();
    });
    clock.async_wait([&](auto const& cancelled) {
        if (!cancelled) process.terminate();
    });
    context.run();
    return interrupted ? std::nullopt : std::optional(problem);
}

/// What becomes of the speeds of a grain.
struct Bounce {
    double restitution;    ///< normal speed after / before
    double coulomb_ratio;  ///< tangential impulse / (friction * normal impulse)
};

Bounce bounce_of(Impact const& impact, double tangential_speed, double normal_speed) {
    return {normal_speed / impact.normal_speed, std::abs(impact.tangential_speed - tangential_speed) /
                                                    (friction * (impact.normal_speed + normal_speed))};
}

Bounce by_law(Impact const& impact) {
    auto const law = integrate_impact(material_of(impact), impact.normal_speed, impact.tangential_speed);
    return bounce_of(impact, law.tangential_speed, law.normal_speed);
}

/// From the last sample that the engine dumped; empty when it is not whole.
std::vector<Bounce> by_engine(fs::path const& folder) {
    std::string const dump = text_of_output(folder / grains_file);
    std::istringstream rows(dump.substr(std::min(dump.rfind("ITEM: ATOMS"), dump.size())));
    std::string heading;
    std::getline(rows, heading);
    std::vector<Bounce> bounces;
    for (Impact const& impact : impacts()) {
        std::size_t id = 0;
        double x = 0, z = 0, vx = 0, vz = 0, spin = 0;
        if (!(rows >> id >> x >> z >> vx >> vz >> spin) || id != bounces.size() + 1) return {};
        bounces.push_back(bounce_of(impact, vx, vz));
    }
    return bounces;
}

std::vector<ProbeResult> judge(std::vector<Bounce> const& bounces) {
    // The engine and the contact law agreed to 5e-4 with this time step.
    constexpr double tolerance = 0.003;
    std::vector<Impact> const list = impacts();
    std::vector<ProbeResult> probes;
    for (std::size_t i = 0; i < restitutions.size(); ++i) {
        std::string const nominal = text(restitutions.at(i));
        probes.push_back(
            {"restitution-" + nominal,
             fmt::format("Normal impact at nominal restitution {}: what is the realised restitution?",
                         nominal),
             by_law(list[i]).restitution, bounces[i].restitution, tolerance});
    }
    // The limit holds in every step, up to rounding. Without the contact options of the decks the ratio is
    // 2.4 at nominal restitution 0.05.
    ProbeResult coulomb{
        "coulomb",
        "Does friction obey Coulomb's law? Largest ratio of the tangential impulse to mu times the "
        "normal impulse, or 1 where it is below.",
        1, 1, 1e-6};
    ProbeResult oblique{
        "oblique-impulse",
        "Oblique impacts: largest deviation of tangential impulse / (mu normal impulse) from the contact law",
        0, 0, tolerance};
    for (std::size_t i = 0; i < bounces.size(); ++i) {
        double const ratio = bounces[i].coulomb_ratio;
        coulomb.measured = std::max(coulomb.measured, ratio);
        oblique.measured = std::max(oblique.measured, std::abs(ratio - by_law(list[i]).coulomb_ratio));
    }
    probes.push_back(coulomb);
    probes.push_back(oblique);
    return probes;
}

}  // namespace

std::optional<Certificate> probe_engine(Engine const& engine, EngineIdentity const& identity) {
    core::TemporaryFolder const folder("vibrotrough-probe");
    auto problem = run_deck(engine, folder.path(), probe_deck());
    if (!problem) return {};
    std::vector<Bounce> bounces;
    if (problem->empty()) bounces = by_engine(folder.path());
    if (problem->empty() && bounces.empty())
        problem = fmt::format("{} is missing or incomplete; is the disk full?", grains_file);
    Certificate certificate{identity, core::utc_now(), {}, *problem};
    if (problem->empty()) certificate.probes = judge(bounces);
    return certificate;
}

std::optional<std::string> read_meshes(Engine const& engine, deck::Deck const& deck) {
    std::map<std::string, std::string> files = deck.settle_files;
    std::string text = std::move(files.extract(deck::settle_file).mapped());
    // What follows the meshes pours the grains in.
    text.resize(std::min(text.size(), text.find("\nfix             integrate ")));
    // Without a grain the engine has no size to sort grains by.
    constexpr std::string_view map = "atom_modify     map array";
    if (auto const at = text.find(map); at != text.npos) text.insert(at + map.size(), " sort 0 0");
    files["in.liggghts"] = text + fmt::format("\nrun 0\nprint \"{} step 0\"\n", deck::end_marker);
    core::TemporaryFolder const folder("vibrotrough-mesh");
    return run_deck(engine, folder.path(), files);
}

std::string digest_of_probes() {
    std::string text = std::to_string(judgement);
    for (auto const& [name, content] : probe_deck()) text += "\n" + name + "\n" + content;
    return core::sha256_hex(text);
}

}  // namespace vibrotrough::engine
