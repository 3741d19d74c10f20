#include "app/commands/command.hpp"
#include "app/engine_certificate.hpp"
#include "campaign/schedule/machine_speed.hpp"
#include "deck/campaign_check.hpp"
#include "deck/estimates.hpp"
#include "scenario/reader/swept_keys.hpp"
#include "store/quantity.hpp"

namespace vibrotrough::app {
namespace {

struct CheckArguments {
    std::string campaign_file;
    bool json = false;
};

Json number(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json describe(deck::Finding const& finding) {
    return {{"severity", to_string(finding.severity)},
            {"item", finding.item},
            {"key", finding.key},
            {"measured", number(finding.measured)},
            {"unit", finding.unit},
            {"bound", finding.at_least ? "at least" : "at most"},
            {"limit", number(finding.limit)},
            {"hard_limit", number(finding.hard_limit)},
            {"advice", finding.advice}};
}

Json describe(prepare::PreparedCase const& prepared, int number, std::string const& label, double speed) {
    Json findings = Json::array();
    for (deck::Finding const& finding : deck::check(prepared)) findings.push_back(describe(finding));
    int const packings = deck::expected_packings(prepared.scenario);
    double const work = deck::expected_work(prepared, packings);
    scenario::Grains const& grains = prepared.scenario.grains;
    double const density = mean_density(prepared.scenario);
    return {{"case", number},
            {"label", label},
            {"throw_number", prepared.throw_number},
            {"grain_density_kg_per_m3", density},
            {"bulk_density_kg_per_m3", scenario::settled_solid_fraction * density},
            {"youngs_modulus_pa", grains.youngs_modulus.value()},
            {"youngs_modulus_chosen", grains.is_modulus_chosen},
            {"findings", findings},
            {"numerical_error", prepared.numerics.total()},
            {"softness_error", prepared.numerics.softness},
            {"box_error", prepared.numerics.box},
            {"time_step_error", prepared.numerics.time_step},
            {"expected_packings", packings},
            {"expected_cycles_per_packing", deck::expected_cycles(prepared.scenario)},
            {"expected_grain_steps", work / prepared.step_cost()},
            {"relative_step_cost", prepared.step_cost()},
            {"expected_core_hours", work / speed / 3600}};
}

/// Prints case by case: all findings of ten thousand cases at once would need half a gigabyte.
void print_json(scenario::Campaign const& campaign, deck::CampaignCheck const& found,
                campaign::MachineSpeed const& speed) {
    Json const head{{"campaign", campaign.name},
                    {"warnings", found.warnings()},
                    {"errors", found.errors()},
                    {"grain_steps_per_cpu_second", speed.grain_steps},
                    {"remarks", found.remarks},
                    {"expected_bytes", found.bytes},
                    {"largest_bytes", found.largest_bytes},
                    {"engine_memory_bytes", found.engine_memory},
                    {"expected_core_hours", found.work / speed.grain_steps / 3600},
                    {"cases", Json::array()}};
    print_with_list(head, campaign.cases.size(), [&](std::size_t i) {
        scenario::Scenario const& one = campaign.cases[i];
        return describe(prepare::prepare_case(one), static_cast<int>(i) + 1, swept_label(one, campaign.swept),
                        speed.grain_steps);
    });
}

/// "600 kg/m3", or "500 to 600 kg/m3" when the cases differ.
std::string range_of(std::vector<double> const& values, double factor, char const* unit, int digits = 4) {
    auto const [least, most] = std::ranges::minmax(values);
    std::string const low = fmt::format("{:.{}g}", factor * least, digits);
    if (most - least <= 1e-9 * most) return fmt::format("{} {}", low, unit);
    return fmt::format("{} to {:.{}g} {}", low, factor * most, digits, unit);
}

/// One of the two was given; the user sees whether the other is as expected.
void print_densities(scenario::Campaign const& campaign) {
    std::vector<double> densities;
    for (scenario::Scenario const& one : campaign.cases) densities.push_back(mean_density(one));
    fmt::print("bulk density of the settled layer: {}, with grains of {} and a solid fraction of {}\n",
               range_of(densities, scenario::settled_solid_fraction, "kg/m3"),
               range_of(densities, 1, "kg/m3"), scenario::settled_solid_fraction);
}

/// The feeds of open troughs, however they were given.
void print_feeds(scenario::Campaign const& campaign) {
    std::vector<double> flows, rates;
    auto const add = [&](scenario::Scenario const& one, double flow) {
        flows.push_back(flow);
        rates.push_back(flow / (mean_density(one) * mean_grain_volume(one)));
    };
    for (auto const& one : campaign.cases) {
        if (!is_open(one)) continue;
        for (scenario::Stage const& stage : stages(one)) add(one, stage.mass_flow);
        if (one.stages.empty()) add(one, *one.feed.mass_flow);
    }
    if (!flows.empty())
        fmt::print("feed: {} = {}\n", range_of(flows, store::tonnes_per_hour, "t/h"),
                   range_of(rates, 1, "grains/s"));
}

/// The moduli of all cases, and who chose them.
void print_moduli(deck::CampaignCheck const& found) {
    std::string const values = range_of({found.least_modulus, found.most_modulus}, 1e-6, "MPa", 3);
    if (found.moduli_chosen == 0) {
        fmt::print("Young's modulus: {}, as given\n", values);
        return;
    }
    std::string const cases = found.moduli_chosen == found.cases
                                  ? ""
                                  : fmt::format(" in {} of {} cases", found.moduli_chosen, found.cases);
    fmt::print(
        "Young's modulus: {}, chosen{}: the lowest with which no layer of the campaign is softer than "
        "solver.softness allows\n",
        values, cases);
}

void print_text(scenario::Campaign const& campaign, deck::CampaignCheck const& found,
                campaign::MachineSpeed const& speed) {
    fmt::print("{:<8} {:<56} {:>10}   {}\n", "", "item (the worst of all cases)", "number", "limit");
    for (deck::CheckedItem const& item : found.items) {
        fmt::print("{:<8} {:<56} {:>10.3g}   {} {:.3g}{}\n", to_string(item.worst.severity), item.worst.item,
                   item.worst.measured, item.worst.at_least ? "at least" : "at most ", item.worst.limit,
                   item.worst.unit == "1" ? "" : " " + item.worst.unit);
    }
    for (deck::CheckedItem const& item : found.items) {
        if (item.worst.severity != deck::Severity::fine)
            fmt::print("{}: {}\n", to_string(item.worst.severity), describe(item, found.cases));
    }
    for (std::string const& remark : found.remarks) fmt::print("{}\n", remark);
    print_densities(campaign);
    print_feeds(campaign);
    print_moduli(found);
    fmt::print("{} case{}, about {:.0f} packings (as many as half_width needs) of {:.0f} cycles\n",
               found.cases, found.cases == 1 ? "" : "s", found.packings, found.cycles / found.packings);
    fmt::print("disk: {:.2g} MB, at most {:.2g} MB; memory of one engine: {:.2g} MB\n", found.bytes / 1e6,
               found.largest_bytes / 1e6, found.engine_memory / 1e6);
    fmt::print("expected cost: {:.2g} core-hours, at {:.2g} grain-steps per CPU second ({})",
               found.work / speed.grain_steps / 3600, speed.grain_steps,
               speed.is_measured ? "measured in the last campaign" : "a usual value");
    if (found.largest_step_cost > 1.05)
        fmt::print("; in the largest layer a step of a grain costs {:.2g} times as much",
                   found.largest_step_cost);
    fmt::print("\n");
}

/// Where there is an engine, it reads the meshes; without one their own checks have to do.
void try_meshes_if_any(std::string const& file, scenario::Campaign const& campaign) {
    if (std::ranges::none_of(campaign.cases, [](auto const& one) { return one.trough.mesh != nullptr; }))
        return;
    std::optional<engine::Engine> engine;
    try {
        engine = engine::find_engine({});
    } catch (core::MissingError const&) {
        return;
    }
    try_meshes(*engine, file, campaign.cases);
}

int run_check(CheckArguments const& options) {
    scenario::Campaign const campaign = scenario::read_campaign(options.campaign_file);
    deck::CampaignCheck const found = deck::check_campaign(campaign);
    campaign::MachineSpeed const speed = campaign::machine_speed();
    options.json ? print_json(campaign, found, speed) : print_text(campaign, found, speed);
    try_meshes_if_any(options.campaign_file, campaign);
    return found.errors() > 0 ? wrong_input : all_well;
}

}  // namespace

void add_check(CLI::App& program, int& exit_code) {
    auto const options = std::make_shared<CheckArguments>();
    CLI::App* const command = program.add_subcommand(
        "check", "Check a campaign before it is simulated, and estimate what it will cost");
    add_campaign_file(*command, options->campaign_file);
    command->add_flag("--json", options->json, "Print JSON for scripts, with all findings of all cases");
    command->footer(
        R"(Checks the time step against Rayleigh and Hertz times, the steps per contact and per cycle, the
overlaps at rest and at impact, the duration of contacts against that of flights, the periodic box, the neighbour lists,
the disk space and the memory of the engine. Prints a table with the worst case of each item, what to change, and the expected cost in
core-hours: of as many packings as the interval that measure.half_width asks for will probably need. 'vibrotrough plan'
uses the same rule, learns from the cases that have a result, and prints a range. The density of the grains and the
bulk density of the layer are printed both, whichever the campaign file gives. So is Young's modulus: where the file
leaves it out, each case gets the lowest one that is stiff enough for the depth and the drive of its layer. A given one
that is too low for them is an error.

'vibrotrough run' checks too: it shows warnings, and it refuses a campaign with errors unless --accept-findings is
given.

Example:
  vibrotrough check validation/demo/campaign.toml)");
    command->callback([options, &exit_code] { exit_code = run_check(*options); });
}

}  // namespace vibrotrough::app
