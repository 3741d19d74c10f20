#include "theory/limits.hpp"

#include "app/commands/command.hpp"
#include "app/commands/theory/options.hpp"
#include "core/text.hpp"

namespace vibrotrough::app {
namespace {

struct TheoryLimitsArguments {
    QuantityOptions quantities;
    bool json = false;
};

struct Inputs {
    double tan_beta, tan_alpha, mu;
};

Inputs read(TheoryLimitsArguments const& o) {
    Inputs in{};
    in.tan_beta = std::max(o.quantities.value("--tan-vibration-angle").value_or(0.5), 1e-9);
    in.tan_alpha = o.quantities.value("--tan-inclination").value_or(0);
    in.mu = o.quantities.required("--friction");
    tell_unusual(theory::MachineNumbers{{}, {}, {}, in.mu, std::atan(in.tan_beta)});
    if (std::abs(in.tan_alpha) >= in.mu) {
        throw core::InputError(fmt::format(
            "--friction {}: is not above |tan(alpha)| = {:g}, so that the mass runs away; write a "
            "larger friction",
            in.mu, std::abs(in.tan_alpha)));
    }
    return in;
}

Json answers(TheoryLimitsArguments const& options, Inputs const& in) {
    theory::Limits const limits = theory::limits(in.tan_beta, in.tan_alpha, in.mu);
    Json json = {
        {"throw_number_of_whole_cycle_flight", limits.whole_cycle_throw_number},
        {"efficiency_at_whole_cycle_flight", limits.whole_cycle_efficiency},
        {"best_throw_number_small_angle", limits.best_throw_number_small_angle},
        {"best_throw_number", limits.best.throw_number},
        {"efficiency_at_best_throw_number", limits.best.velocity_efficiency},
        {"small_angle_efficiency", limits.small_angle_efficiency},
        {"pn_machine_number_level_small_angle", limits.pn_machine_number},
    };
    auto const gamma = options.quantities.value("--throw-number");
    if (!gamma) return json;
    auto const pn = theory::pn_motion({*gamma, in.tan_beta, in.tan_alpha, in.mu});
    json["pn_closed_form"] = nullptr;
    if (pn) {
        json["pn_closed_form"] = {{"positive_start_rad", pn->positive_start},
                                  {"positive_end_rad", pn->positive_end},
                                  {"positive_displacement", pn->positive_displacement},
                                  {"negative_displacement", pn->negative_displacement},
                                  {"velocity_efficiency", pn->velocity_efficiency}};
    }
    return json;
}

void print_text(Json const& json, Inputs const& in) {
    auto const line = [&](char const* words, char const* key) {
        fmt::print("{:<68} {}\n", words,
                   core::without_sign_of_zero(fmt::format("{:.6f}", json[key].get<double>())));
    };
    line("throw number of a flight of one cycle, sqrt(1 + pi^2) (Eq. 15)",
         "throw_number_of_whole_cycle_flight");
    line("  efficiency there, small vibration angle, level", "efficiency_at_whole_cycle_flight");
    line("throw number of maximum efficiency, small vibration angle (Eq. 19)",
         "best_throw_number_small_angle");
    line(fmt::format("throw number of maximum efficiency at tan(beta) = {:g}, mu = {:g}", in.tan_beta, in.mu)
             .c_str(),
         "best_throw_number");
    line("  efficiency there", "efficiency_at_best_throw_number");
    line("efficiency for small vibration angle, large K, no flight (Eq. 21)", "small_angle_efficiency");
    line("machine number from which the mode is PN, beta = 0, level", "pn_machine_number_level_small_angle");
    if (!json.contains("pn_closed_form")) return;
    if (json["pn_closed_form"].is_null()) {
        fmt::print("PN mode in closed form (Eq. 20): the motion is not in the PN mode\n");
        return;
    }
    Json const& pn = json["pn_closed_form"];
    fmt::print("PN mode in closed form (Eq. 20): P from {:.6f} to {:.6f} rad, efficiency {:.6f}\n",
               pn["positive_start_rad"].get<double>(), pn["positive_end_rad"].get<double>(),
               pn["velocity_efficiency"].get<double>());
}

}  // namespace

void add_theory_limits(CLI::App& theory, int& exit_code) {
    CLI::App* const command = theory.add_subcommand(
        "limits",
        "Print the closed-form results of the theory, such as the throw number of maximum efficiency");
    auto const options = std::make_shared<TheoryLimitsArguments>();
    options->quantities.add_to(*command,
                               {{"--friction"},
                                {"--tan-vibration-angle", "; default: 0.5"},
                                {"--tan-inclination", ", uphill positive; default: 0"},
                                {"--throw-number", "; with it, the PN mode in closed form is printed"}});
    command->add_flag("--json", options->json, "Print JSON");
    command->footer(
        std::string(
            R"(Prints the throw number of maximum efficiency and how it changes with mu tan(beta) (Eqs. 15 and 19 of
Sloot & Kruyt 1996), the efficiency in the limit of small vibration angles (Eq. 21), the machine number at which the PN
mode begins, and with --throw-number the PN mode in closed form (Eq. 20).

)") + mode_letters +
        R"(

Example:
  vibrotrough theory limits --friction 0.35 --tan-inclination -0.1 --tan-vibration-angle 0.5)");
    command->callback([options, &exit_code] {
        Inputs const in = read(*options);
        Json const json = answers(*options, in);
        options->json ? fmt::print("{}\n", json.dump(2)) : print_text(json, in);
        exit_code = all_well;
    });
}

}  // namespace vibrotrough::app
