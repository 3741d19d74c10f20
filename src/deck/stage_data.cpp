#include "deck/stage_data.hpp"

#include "deck/drive_formula.hpp"
#include "scenario/model/stage_motion.hpp"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace vibrotrough::deck {
namespace {

using Terms = std::vector<scenario::DriveTerm>;

/// The variables and velocities of one part.
struct PartFormulas {
    std::vector<Formula> variables = {};
    std::string speed_x = "0", speed_z = "0";
};

void add(PartFormulas& part, DriveFormula const& formula) {
    part.variables.insert(part.variables.end(), formula.terms.begin(), formula.terms.end());
}

/// Cycles of the trough's drive at constant frequency.
PartFormulas steady(scenario::DrivePart const& part) {
    PartFormulas formulas{
        {{"angle", "2*PI*(step%v_n)/v_n"}, {"angle_before", "2*PI*((step-1)%v_n)/v_n"}}, "0", "0"};
    for (auto const& [axis, terms, speed] :
         {std::tuple{"x", &part.to.along, &formulas.speed_x}, {"z", &part.to.normal, &formulas.speed_z}}) {
        DriveFormula const formula = drive_formula(*terms, axis);
        add(formulas, formula);
        *speed = formula.speed;
    }
    return formulas;
}

/// The share u of a ramp's time, and the angle of the drive there, at the step and at the one before.
void add_angles(PartFormulas& formulas, scenario::DrivePart const& part, int steps_per_cycle) {
    long const first = static_cast<long>(part.first_cycle) * steps_per_cycle;
    long const steps = static_cast<long>(part.cycles) * steps_per_cycle;
    double const mean = (part.first_frequency + part.frequency) / 2;
    double const linear = part.first_frequency / mean, square = (part.frequency / mean - linear) / 2;
    for (auto const& [ending, step] : {std::pair{"", "step"}, {"_before", "step-1"}}) {
        std::string const share = fmt::format("v_share{}", ending);
        formulas.variables.push_back(
            {fmt::format("share{}", ending), fmt::format("({}-{})/{}.0", step, first, steps)});
        formulas.variables.push_back(
            {fmt::format("angle{}", ending),
             fmt::format("2*PI*{}*{}*({}+({})*{})", part.cycles, share, linear, square, share)});
    }
}

/// The displacement along one axis at the share u: (1 - u) D_from + u D_to.
std::string blended(PartFormulas& formulas, scenario::DrivePart const& part, char const* axis,
                    char const* ending) {
    bool const along = axis[0] == 'x';
    auto const displacement = [&](char const* name, scenario::DriveMotion const& motion) {
        DriveFormula const formula =
            displacement_formula(along ? motion.along : motion.normal,
                                 fmt::format("{}_{}{}_", name, axis, ending), fmt::format("angle{}", ending));
        add(formulas, formula);
        return formula.speed;
    };
    std::string const from = displacement("from", part.from), to = displacement("to", part.to);
    return fmt::format("(1-v_share{0})*({1})+v_share{0}*({2})", ending, from, to);
}

PartFormulas ramp(scenario::DrivePart const& part, int steps_per_cycle) {
    PartFormulas formulas;
    add_angles(formulas, part, steps_per_cycle);
    for (auto const& [axis, speed] : {std::pair{"x", &formulas.speed_x}, {"z", &formulas.speed_z}}) {
        std::string const now = blended(formulas, part, axis, ""),
                          before = blended(formulas, part, axis, "_before");
        formulas.variables.push_back({fmt::format("place_{}", axis), now});
        formulas.variables.push_back({fmt::format("place_{}_before", axis), before});
        *speed = fmt::format("(v_place_{0}-v_place_{0}_before)/dt", axis);
    }
    return formulas;
}

std::string remark(scenario::DrivePart const& part, scenario::Stage const& stage) {
    std::string const what =
        stage.standstill
            ? std::string("standstill")
            : fmt::format("throw number {:.6g}, {:.6g} Hz, amplitude {:.6g} m", throw_number(stage.trough),
                          stage.trough.frequency, stage.trough.amplitude);
    return fmt::format("stage {}, {}cycles {} to {}: {}", part.stage + 1, part.ramp ? "ramp, " : "",
                       part.first_cycle + 1, part.first_cycle + part.cycles, what);
}

core::TemplateData describe_part(scenario::DrivePart const& part, scenario::Stage const& stage, int number,
                                 int steps_per_cycle) {
    PartFormulas const formulas = part.ramp ? ramp(part, steps_per_cycle) : steady(part);
    core::TemplateData entry;
    entry.set("part_number", std::to_string(number));
    entry.set("part_remark", remark(part, stage));
    entry.set("part_time_step", fmt::format("{}", part.cycle_time() / steps_per_cycle));
    std::vector<core::TemplateData> variables;
    for (Formula const& formula : formulas.variables) {
        core::TemplateData one;
        one.set("name", formula.name);
        one.set("expression", formula.expression);
        variables.push_back(std::move(one));
    }
    entry.set("part_variables", std::move(variables));
    entry.set("part_speed_x", formulas.speed_x);
    entry.set("part_speed_z", formulas.speed_z);
    return entry;
}

}  // namespace

void describe_stages(core::TemplateData& data, prepare::PreparedCase const& prepared) {
    data.set("staged", !prepared.stages.empty());
    if (prepared.stages.empty()) return;
    std::vector<core::TemplateData> parts;
    std::string part_of_cycle = "1";
    for (scenario::DrivePart const& part : drive_parts(prepared.stages)) {
        int const number = static_cast<int>(parts.size()) + 1;
        if (number > 1) part_of_cycle += fmt::format("+(${{done}}>={})", part.first_cycle);
        parts.push_back(describe_part(part, prepared.stages[static_cast<std::size_t>(part.stage)], number,
                                      prepared.time.steps_per_cycle));
    }
    data.set("part_of_cycle", part_of_cycle);
    data.set("parts", std::move(parts));
}

}  // namespace vibrotrough::deck
