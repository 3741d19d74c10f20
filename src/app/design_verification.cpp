#include "app/design_verification.hpp"

#include "app/learning.hpp"
#include "app/standard_streams.hpp"
#include "campaign/schedule/forecast.hpp"
#include "campaign/state/numerics_results.hpp"
#include "campaign/state/overview.hpp"
#include "campaign/state/result_summary.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "learn/corrected_model.hpp"
#include "learn/design_campaign.hpp"
#include "learn/design_report.hpp"
#include "prepare/numerical_errors.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include <fmt/format.h>

namespace vibrotrough::app {
namespace {

namespace fs = std::filesystem;

constexpr int most_machines = 12;
/// As precise and as large as the layers of the atlas. Several layers together tell the error of a model, and
/// what they leave open makes the next machine's layer deeper.
constexpr double wanted_half_width = 0.08, box_length = 8, box_width = 5;

/// What the simulation of one machine said.
struct Simulated {
    std::vector<learn::SimulatedLayer> layers;  ///< with a steady speed
    std::optional<std::string> no_speed;        ///< why one has none
    double core_time = 0;                       ///< s
    bool is_interrupted = false, is_too_dear = false;
};

/// The layers of a campaign that has run.
void read_layers(campaign::Plan const& plan, theory::Drive const& drive, Simulated& found) {
    auto const studied = campaign::read_case_numerics(plan.folder);
    for (campaign::PlannedCase const& planned : plan.cases) {
        double const friction = planned.scenario().trough.friction;
        auto const summary = campaign::find_summary(planned);
        if (!summary) {
            found.no_speed = fmt::format("the layer with a friction of {:.3f} has no result", friction);
            continue;
        }
        store::CaseRecord const& record = summary->record;
        for (auto const& packing : record.packings) found.core_time += packing.core_time;
        if (!record.estimate.mean || !record.estimate.half_width) {
            found.no_speed = fmt::format("the layer with a friction of {:.3f} ended as {}", friction,
                                         core::name_of(record.outcome));
            continue;
        }
        auto const study = studied.find(planned.id);
        double const numerics =
            study != studied.end() ? study->second : prepare::numerical_errors(planned.scenario()).total();
        found.layers.push_back({drive, friction, scenario::layer_height(planned.scenario()),
                                *record.estimate.mean, *record.estimate.half_width, numerics});
    }
}

double cost_to_go(campaign::Plan const& plan) {
    auto const cases = campaign::survey(plan, campaign::activity_in(plan.folder), {}, campaign::Trust::stamp);
    return campaign::forecast(cases).core_time;
}

/// Simulates a machine unless that would exceed what is left of the budget.
Simulated simulate_machine(fs::path const& file, theory::Drive const& drive,
                           VerificationOptions const& options, double left) {
    RunOptions running;
    running.campaign_file = file.string();
    running.output = (file.parent_path() / file.stem()).string();
    running.engine = options.engine;
    running.quiet = options.quiet;
    running.jobs = options.jobs;
    ReadyCampaign ready = prepare_run(running);
    Simulated found;
    if (ready.is_interrupted) {
        found.is_interrupted = true;
        return found;
    }
    if (double const cost = cost_to_go(ready.plan); cost > 0 && cost > left) {
        found.is_too_dear = true;
        found.core_time = cost;
        return found;
    }
    std::map<std::string, double> wanted;
    found.is_interrupted = !simulate(running, ready, wanted);
    if (!found.is_interrupted) read_layers(ready.plan, drive, found);
    return found;
}

/// What the models of a task promise of layers, beside what these are.
std::vector<learn::ComparedLayer> compared(learn::DesignTask const& task,
                                           std::vector<learn::SimulatedLayer> const& layers) {
    std::vector<learn::ComparedLayer> all;
    for (learn::SimulatedLayer const& layer : layers) {
        for (learn::DesignModel const& model : task.models) {
            auto const said = model.at({layer.drive, layer.depth}, layer.friction);
            if (!said) continue;
            double const missed = std::hypot(
                said->statistics_sd, model.missed(layer.drive, task.in_grains(layer.depth), task.confidence));
            all.push_back({layer.friction, model.name, said->efficiency,
                           atlas::deviations_in_half_width * missed, layer.efficiency,
                           std::hypot(layer.statistics_half_width, layer.numerical_error)});
        }
    }
    return all;
}

/// What a search for a machine finds.
template <class Search>
auto fitting(Search const& search) {
    try {
        return search();
    } catch (std::invalid_argument const& error) {
        throw core::InputError(fmt::format("no machine fits: {}; widen the limits", error.what()));
    }
}

/// One machine after the other.
class Verifier {
  public:
    Verifier(learn::DesignTask const& task, VerificationOptions const& options)
        : original_(with_known_errors(task)),
          options_(options),
          found_{original_, propose_machine(original_), {}} {}

    VerifiedDesign run() {
        core::make_folder(options_.output);
        for (int number = 1; number <= most_machines; ++number) {
            if (!is_worth_simulating()) return ended(learn::Verdict::no_machine, "");
            // What is known of it is its own simulation.
            if (found_.design.feasible && was_simulated(found_.design))
                return ended(learn::Verdict::verified, "");
            if (!try_machine(number)) return found_;
            found_.design = propose_machine(found_.task);
        }
        return ended(learn::Verdict::too_many, fmt::format("{} machines were not enough", most_machines));
    }

  private:
    /// A calibration says what its model misses draw by draw; the correction takes their root mean square. Of
    /// a material that no model knows the layers will tell.
    static learn::DesignTask with_known_errors(learn::DesignTask task) {
        task.unknown_material.reset();
        double squares = 0;
        for (double const one : task.friction.discrepancies) squares += one * one;
        for (learn::DesignModel& model : task.models) {
            if (!model.uses_calibrated_discrepancy) continue;
            model.uses_calibrated_discrepancy = false;
            model.discrepancy = std::sqrt(squares / static_cast<double>(task.friction.discrepancies.size()));
        }
        return task;
    }

    /// Whether the last machine that was simulated is this one.
    bool was_simulated(learn::RiskDesign const& design) const {
        if (found_.verification.machines.empty()) return false;
        learn::SimulatedMachine const& last = found_.verification.machines.back();
        return last.drive.frequency == design.drive.frequency &&
               last.drive.amplitude == design.drive.amplitude &&
               last.drive.vibration_angle == design.drive.vibration_angle &&
               last.drive.inclination == design.drive.inclination && last.depth == design.depth;
    }

    learn::CheckedLayer layer() const { return {wanted_half_width, box_length, box_width}; }
    learn::Verification& verification() { return found_.verification; }

    VerifiedDesign ended(learn::Verdict verdict, std::string const& why) {
        verification().verdict = verdict;
        verification().why = why;
        return found_;
    }

    /// Whether the models expect it to reach the mass flow, be they tested there or not.
    bool is_worth_simulating() const { return found_.design.sure_flow >= found_.task.mass_flow * (1 - 1e-9); }

    /// @return whether another machine is to be tried
    bool try_machine(int number) {
        fs::path const file = fs::path(options_.output) / fmt::format("machine_{}.toml", number);
        core::write_file_atomically(file, learn::design_campaign(found_.task, found_.design, layer()));
        Simulated const simulated =
            simulate_machine(file, found_.design.drive, options_, options_.budget - verification().core_time);
        if (simulated.is_interrupted) {
            found_.is_interrupted = true;
            return false;
        }
        if (simulated.is_too_dear) {
            ended(learn::Verdict::budget,
                  fmt::format("the next machine would take about {:.2g} core-hours, and {:.2g} are left; "
                              "the same command with more goes on",
                              simulated.core_time / 3600,
                              std::max(0.0, options_.budget - verification().core_time) / 3600));
            return false;
        }
        verification().core_time += simulated.core_time;
        if (simulated.no_speed) {
            ended(learn::Verdict::no_speed, *simulated.no_speed);
            return false;
        }
        return !accepts(file, simulated.layers);
    }

    /// Corrects the models with the layers. @return whether the machine is the answer
    bool accepts(fs::path const& file, std::vector<learn::SimulatedLayer> const& layers) {
        auto const promised = compared(found_.task, layers);
        layers_.insert(layers_.end(), layers.begin(), layers.end());
        for (std::size_t i = 0; i < original_.models.size(); ++i)
            found_.task.models[i] = learn::corrected_design_model(
                original_.models[i], layers_, *original_.grain_diameter, original_.confidence);
        theory::Drive const drive = found_.design.drive;
        double const depth = found_.design.depth;
        auto const choices = found_.design.choices;
        found_.design = learn::judge_machine(found_.task, drive, depth);
        found_.design.choices = choices;
        std::optional<double> probability;
        if (!found_.design.untested) probability = found_.design.probability;
        bool const agrees = std::ranges::all_of(promised, &learn::ComparedLayer::agrees);
        verification().machines.push_back({file.string(), drive, depth, promised, probability});
        if (!options_.quiet)
            tell("design: machine {} is simulated: {} what was promised; it carries the mass flow with {}\n",
                 verification().machines.size(), agrees ? "as" : "other than",
                 probability ? fmt::format("{:.1f} %", 100 * *probability)
                             : "a probability that is not known");
        if (!agrees || !found_.design.feasible) return false;
        ended(learn::Verdict::verified, "");
        return true;
    }

    learn::DesignTask original_;
    VerificationOptions options_;
    VerifiedDesign found_;
    std::vector<learn::SimulatedLayer> layers_;
};

}  // namespace

learn::RiskDesign propose_machine(learn::DesignTask const& task) {
    return fitting([&] { return learn::design_with_risk(task); });
}

VerifiedDesign verify_design(learn::DesignTask const& task, VerificationOptions const& options) {
    return Verifier(task, options).run();
}

}  // namespace vibrotrough::app
