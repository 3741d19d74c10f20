#include "learn/layer_search.hpp"

#include "scenario/reader/sample_cube.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <nlopt.hpp>

namespace vibrotrough::learn {
namespace {

using Point = std::vector<double>;

constexpr int samples_per_quantity = 64;
constexpr unsigned seed = 1;
constexpr std::size_t climbs = 3;       // from the sample
constexpr double far_apart = 0.1;       // of the cube's edge, between the points from which it climbs
constexpr int steps_per_quantity = 60;  // of a climb
constexpr int short_steps = 8;          // likewise
constexpr double first_step = 0.1, short_first_step = 0.02, last_step = 1e-5;  // of the cube's edge
/// The search aims so far inside each limit, relatively, so that what it finds lies inside and not on it.
constexpr double aim_inside = 1e-8;
constexpr double useless = -1e6;  // merit of what is of no use

double between(theory::Range const& range, double share) {
    return std::clamp(range.low + share * (range.high - range.low), range.low, range.high);
}

/// Equal ratios are equally far.
double ratio_between(theory::Range const& range, double share) {
    return std::clamp(range.low * std::pow(range.high / range.low, share), range.low, range.high);
}

/// One climb; the best that it meets is remembered.
class Climb {
  public:
    Climb(LayerSpace const& space, LayerGoal const& goal) : space_(space), goal_(goal) {
        for (std::size_t k = 0; k < goal.excesses.size(); ++k) limits_.push_back({this, k});
    }

    /// Looks at one point.
    void look_at(Point const& point) {
        if (point == last_) return;
        last_ = point;
        merit_ = useless;
        excesses_.assign(goal_.excesses.size(), 1);
        auto const layer = space_.at(point);
        if (!layer) return;
        for (std::size_t k = 0; k < excesses_.size(); ++k) {
            double const value = goal_.excesses[k](*layer);
            excesses_[k] = std::isfinite(value) ? value : (value < 0 ? -1 : 1);
        }
        double const merit = goal_.merit(*layer);
        if (!std::isfinite(merit)) return;
        merit_ = merit;
        bool const keeps_all = std::ranges::all_of(excesses_, [](double e) { return e <= 0; });
        if (keeps_all && (!best_ || merit > best_->merit)) best_ = FoundLayer{point, *layer, merit};
    }

    void run(Point point, double step, int steps) {
        if (point.empty()) return look_at(point);
        nlopt::opt optimiser(nlopt::LN_COBYLA, static_cast<unsigned>(point.size()));
        optimiser.set_lower_bounds(0);
        optimiser.set_upper_bounds(1);
        optimiser.set_max_objective(merit_of, this);
        for (Limit& limit : limits_) optimiser.add_inequality_constraint(excess_of, &limit, 1e-9);
        optimiser.set_initial_step(step);
        optimiser.set_xtol_abs(last_step);
        optimiser.set_maxeval(steps * static_cast<int>(point.size()));
        double value = 0;
        try {
            optimiser.optimize(point, value);
        } catch (nlopt::roundoff_limited const&) {
            return;  // the result is as good as rounding allows
        }
    }

    std::optional<FoundLayer> const& best() const { return best_; }

  private:
    struct Limit {
        Climb* climb;
        std::size_t number;
    };

    static double merit_of(Point const& x, Point&, void* self) {
        auto& me = *static_cast<Climb*>(self);
        me.look_at(x);
        return me.merit_;
    }
    static double excess_of(Point const& x, Point&, void* self) {
        auto const& limit = *static_cast<Limit*>(self);
        limit.climb->look_at(x);
        return limit.climb->excesses_[limit.number] + aim_inside;
    }

    LayerSpace const& space_;
    LayerGoal const& goal_;
    std::vector<Limit> limits_;
    std::vector<double> excesses_;
    Point last_{-1};
    double merit_ = useless;
    std::optional<FoundLayer> best_;
};

bool are_apart(Point const& a, Point const& b) {
    for (std::size_t k = 0; k < a.size(); ++k)
        if (std::abs(a[k] - b[k]) > far_apart) return true;
    return false;
}

/// The best points of the sample that are not close to each other.
std::vector<Point> best_of_sample(LayerSpace const& space, LayerGoal const& goal) {
    std::vector<FoundLayer> all;
    for (Point const& point : space.sample()) {
        auto const layer = space.at(point);
        // Limits cost less than the merit, which may ask a model.
        if (!layer || !std::ranges::all_of(goal.excesses, [&](auto const& one) { return one(*layer) <= 0; }))
            continue;
        double const merit = goal.merit(*layer);
        if (std::isfinite(merit)) all.push_back({point, *layer, merit});
    }
    std::ranges::stable_sort(all, std::greater(), &FoundLayer::merit);
    std::vector<Point> chosen;
    for (FoundLayer const& one : all) {
        bool const is_new =
            std::ranges::all_of(chosen, [&](Point const& other) { return are_apart(one.point, other); });
        if (is_new || chosen.empty()) chosen.push_back(one.point);
        if (chosen.size() == climbs) break;
    }
    return chosen;
}

}  // namespace

LayerSpace::LayerSpace(theory::DriveSpace const& space, theory::Range const& depth)
    : space_(space), depth_(depth) {
    auto const add = [&](Quantity quantity, theory::Range const& range) {
        if (range.low < range.high) free_.push_back(quantity);
    };
    add(angle, space.vibration_angle);
    add(inclination, space.inclination);
    add(frequency, space.frequency);
    add(amplitude, space.amplitude);
    add(depth_of_layer, depth);
}

std::optional<DesignLayer> LayerSpace::at(std::vector<double> const& point) const {
    auto const share = [&](Quantity quantity) {
        auto const found = std::ranges::find(free_, quantity);
        return found == free_.end() ? 0 : point[static_cast<std::size_t>(found - free_.begin())];
    };
    double const beta = between(space_.vibration_angle, share(angle));
    double const alpha = between(space_.inclination, share(inclination));
    // The largest acceleration that both limits allow, and with it the largest frequency and amplitude.
    double const most =
        (1 - aim_inside) * space_.gravity *
        std::min(space_.max_machine_number, space_.max_throw_number * std::cos(alpha) / std::sin(beta));
    theory::Range frequencies = space_.frequency, amplitudes = space_.amplitude;
    frequencies.high = std::min(frequencies.high, std::sqrt(most / amplitudes.low) / (2 * std::numbers::pi));
    if (frequencies.high < frequencies.low) return {};
    double const f = ratio_between(frequencies, share(frequency));
    amplitudes.high = std::min(amplitudes.high, most / std::pow(2 * std::numbers::pi * f, 2));
    if (amplitudes.high < amplitudes.low * (1 - aim_inside)) return {};
    amplitudes.high = std::max(amplitudes.high, amplitudes.low);
    return DesignLayer{{f, ratio_between(amplitudes, share(amplitude)), beta, alpha},
                       ratio_between(depth_, share(depth_of_layer))};
}

std::vector<Point> LayerSpace::sample() const {
    auto const count = static_cast<int>(free_.size());
    if (count == 0) return {Point{}};
    auto points =
        scenario::sample_cube(scenario::SampleMethod::sobol, samples_per_quantity * count, count, seed);
    for (Quantity const largest : {amplitude, depth_of_layer}) {
        auto const found = std::ranges::find(free_, largest);
        if (found == free_.end()) continue;
        auto more = points;
        for (Point& point : more) point[static_cast<std::size_t>(found - free_.begin())] = 1;
        points.insert(points.end(), more.begin(), more.end());
    }
    return points;
}

std::vector<FoundLayer> best_layers(LayerSpace const& space, LayerGoal const& goal,
                                    std::vector<Point> const& starts) {
    auto from = best_of_sample(space, goal);
    from.insert(from.end(), starts.begin(), starts.end());
    std::vector<FoundLayer> found;
    for (Point const& point : from) {
        Climb climb(space, goal);
        climb.look_at(point);
        climb.run(point, first_step, steps_per_quantity);
        if (climb.best()) found.push_back(*climb.best());
    }
    std::ranges::stable_sort(found, std::greater(), &FoundLayer::merit);
    return found;
}

std::optional<FoundLayer> polished(LayerSpace const& space, LayerGoal const& goal, Point const& start) {
    Climb climb(space, goal);
    climb.look_at(start);
    climb.run(start, short_first_step, short_steps);
    return climb.best();
}

}  // namespace vibrotrough::learn
