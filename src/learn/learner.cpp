#include "learn/learner.hpp"

#include "campaign/state/result_summary.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "learn/notes.hpp"
#include "scenario/reader/design.hpp"
#include "scenario/reader/sample_cube.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::learn {
namespace {

constexpr int domain_points = 200;
constexpr unsigned domain_seed = 20261122;
/// A case that goes on is to have so much of its half-width, which doubles its packings.
constexpr double narrowing = 0.7;

double median(std::vector<double> values) {
    auto const middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

}  // namespace

std::map<std::string, double> read_wanted_half_widths(std::filesystem::path const& folder) {
    auto const file = folder / "learn.json";
    if (!std::filesystem::exists(file)) return {};
    try {
        return parse_half_widths(core::read_file(file, core::largest_note));
    } catch (core::note::Fault const& fault) {
        throw core::InputError(
            fmt::format("{} is damaged; remove it, and learning begins its choice anew ({})", file.string(),
                        fault.what()));
    }
}

void write_wanted_half_widths(std::filesystem::path const& folder,
                              std::map<std::string, double> const& wanted) {
    nlohmann::json const json{
        {"format", "vibrotrough learn"}, {"schema_version", 1}, {"half_widths", wanted}};
    core::write_file_atomically(folder / "learn.json", json.dump(2) + "\n");
}

Learner::Learner(campaign::Plan const& plan, scenario::CaseMaker const& maker, LearnGoal goal)
    : plan_(plan),
      maker_(maker),
      goal_(goal),
      points_(campaign_points(plan, maker)),
      trend_(maker, points_.inputs, {}) {
    if (maker.domain().empty()) {
        throw core::InputError(
            "the campaign file has no [domain]; write for example [domain] and below it "
            "\"trough.throw_number\" = { from = "
            "1, to = 3 }");
    }
    domain_ = make_domain();
}

std::vector<Learner::DomainPoint> Learner::make_domain() const {
    std::vector<DomainPoint> domain;
    auto const& axes = maker_.domain();
    auto const cube = scenario::sample_cube(scenario::SampleMethod::sobol, domain_points,
                                            static_cast<int>(axes.size()), domain_seed);
    for (auto const& row : cube) {
        atlas::Place place;
        for (atlas::SurfaceInput const& input : points_.inputs) {
            auto const axis = std::ranges::find(axes, input.key, &scenario::DomainAxis::key);
            if (axis == axes.end())
                throw core::InputError(fmt::format(
                    "{} is varied beside the [domain]; move it into the domain or fix it", input.key));
            place.push_back(axis->at(row[static_cast<std::size_t>(axis - axes.begin())]));
        }
        if (auto const value = trend_.efficiency_at(place)) domain.push_back({std::move(place), *value});
    }
    if (domain.empty())
        throw core::InputError("the theory has no mean speed anywhere in the domain; choose another one");
    return domain;
}

void Learner::concentrate_on(std::vector<atlas::Place> const& places) {
    domain_.clear();
    for (atlas::Place const& place : places) {
        if (auto const value = trend_.efficiency_at(place)) domain_.push_back({place, *value});
    }
    if (domain_.empty())
        throw core::InputError(
            "the theory has no mean speed where the posterior lies; free other quantities");
}

double Learner::first_half_width(scenario::Scenario const& scenario) const {
    return std::max(goal_.half_width, scenario.measure.half_width);
}

DomainCertainty Learner::certainty(atlas::Surface const& surface) const {
    DomainCertainty found{{}, 0, {0, -1}, 0};
    for (DomainPoint const& point : domain_) {
        atlas::SurfaceValue const value = surface.at(point.place, point.theory);
        found.mean_half_width += value.half_width * value.half_width;
        if (value.half_width > found.at_worst.half_width) {
            found.at_worst = value;
            found.worst = point.place;
            found.worst_theory = point.theory;
        }
    }
    found.mean_half_width = std::sqrt(found.mean_half_width / static_cast<double>(domain_.size()));
    return found;
}

LearnStatus Learner::look() {
    points_ = campaign_points(plan_, maker_);
    wanted_ = read_wanted_half_widths(plan_.folder);
    core_times_.clear();
    for (campaign::PlannedCase const& planned : plan_.cases) {
        auto const summary = campaign::find_summary(planned);
        if (!summary) continue;
        double& sum = core_times_[planned.id];
        for (auto const& packing : summary->record.packings) sum += packing.core_time;
    }
    surface_.emplace(surface_of(points_));
    LearnStatus status{static_cast<int>(points_.points.size()),
                       static_cast<int>(points_.apart.size()),
                       least_points(*surface_),
                       certainty(*surface_),
                       surface_->quality(),
                       surface_->doubts(),
                       0,
                       0,
                       trend_.is_atlas() && !rests_on_atlas(*surface_)};
    for (auto const& [id, time] : core_times_) status.core_time += time;
    double const ratio = status.certainty.at_worst.half_width / goal_.half_width;
    status.core_time_to_go = ratio > 1 ? status.core_time * (ratio * ratio - 1) : 0;
    return status;
}

bool Learner::has_reached(LearnStatus const& status, LearnGoal const& goal) {
    return status.certainty.at_worst.half_width <= goal.half_width && status.quality.coverage_is_right() &&
           status.quality.points >= status.least_points;
}

std::vector<Learner::Candidate> Learner::candidates() const {
    std::vector<Candidate> all;
    std::vector<double> times;
    for (auto const& [id, time] : core_times_) times.push_back(time);
    double const usual = median(times);
    double const first = std::max(goal_.half_width, plan_.cases.front().scenario().measure.half_width);
    for (DomainPoint const& point : domain_)
        all.push_back(
            {{"", point.place, point.theory, surface_->at(point.place, point.theory).efficiency, first},
             "",
             first,
             usual});
    for (atlas::SurfacePoint const& point : points_.points) {
        auto const planned = std::ranges::find(plan_.cases, point.case_id, &campaign::PlannedCase::id);
        double const wanted = narrowing * point.half_width;
        auto const& measure = planned->scenario().measure;
        if (wanted < measure.half_width || measure.max_packings < 2) continue;
        // A case that did not become as precise as asked has all the packings and cycles that it may have.
        auto const asked = wanted_.find(point.case_id);
        if (asked != wanted_.end() && point.half_width > asked->second) continue;
        // Two means of these half-widths combine to one of the half-width wanted.
        double const equivalent =
            1 / std::sqrt(1 / (wanted * wanted) - 1 / (point.half_width * point.half_width));
        double const more = core_times_.at(point.case_id) * (1 / (narrowing * narrowing) - 1);
        all.push_back({{point.case_id, point.place, point.theory, point.efficiency, equivalent},
                       point.case_id,
                       wanted,
                       more});
    }
    return all;
}

std::vector<LearnStep> Learner::choose() const {
    atlas::Surface believed = *surface_;
    std::vector<Candidate> candidates = this->candidates();
    double spent = 0;
    for (auto const& [id, time] : core_times_) spent += time;
    std::vector<LearnStep> steps;
    while (static_cast<int>(steps.size()) < goal_.batch && !candidates.empty()) {
        DomainCertainty const now = certainty(believed);
        for (Candidate& candidate : candidates) {
            atlas::SurfacePoint const& p = candidate.point;
            double sum = 0;
            for (DomainPoint const& d : domain_)
                sum += believed.variance_reduction(d.place, d.theory, p.place, p.theory, p.half_width);
            double const mean = sum / static_cast<double>(domain_.size()) / std::pow(now.mean_half_width, 2);
            double const worst =
                believed.variance_reduction(now.worst, now.worst_theory, p.place, p.theory, p.half_width) /
                std::pow(now.at_worst.half_width, 2);
            candidate.worth = (mean + worst) / candidate.core_time;
        }
        auto const best = std::ranges::max_element(candidates, {}, &Candidate::worth);
        spent += best->core_time;
        if (!(best->worth > 0) || spent > goal_.budget) break;
        LearnStep step{{}, best->case_id, best->wanted, best->core_time};
        if (best->case_id.empty()) step.added = trend_.scenario_at(best->point.place);
        steps.push_back(std::move(step));
        believed.believe(best->point);
        candidates.erase(best);
    }
    return steps;
}

}  // namespace vibrotrough::learn
