#include "theory/drive_search.hpp"

#include "theory/detail/ranges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <nlopt.hpp>

namespace vibrotrough::theory {
namespace {

using std::numbers::pi;
constexpr double no_limit = std::numeric_limits<double>::infinity();
/// The search aims so far inside each limit, relatively, so that what it finds lies inside and not on it.
constexpr double margin = 1e-8;

/// The search variables: logarithms of frequency and amplitude, vibration angle, inclination.
using Variables = std::vector<double>;

Variables low(DriveSpace const& s) {
    return {std::log(s.frequency.low), std::log(s.amplitude.low), s.vibration_angle.low, s.inclination.low};
}
Variables high(DriveSpace const& s) {
    return {std::log(s.frequency.high), std::log(s.amplitude.high), s.vibration_angle.high,
            s.inclination.high};
}

class Search {
  public:
    Search(DriveSpace const& space, DriveFunction const& merit, std::vector<DriveFunction> const& excesses)
        : space_(space), merit_function_(merit), excess_functions_(excesses), excesses_(excesses.size() + 1) {
        for (std::size_t k = 0; k < excesses_.size(); ++k) limits_.push_back({this, k});
    }

    Drive drive(Variables const& x) const {
        auto const within = [](double value, Range const& r) { return std::clamp(value, r.low, r.high); };
        return {within(std::exp(x[0]), space_.frequency), within(std::exp(x[1]), space_.amplitude),
                within(x[2], space_.vibration_angle), within(x[3], space_.inclination)};
    }

    /// One climb; the best that it meets is remembered.
    Variables climb(nlopt::algorithm algorithm, Variables start, int evaluations, double tolerance) {
        nlopt::opt optimiser(algorithm, 4);
        optimiser.set_lower_bounds(low(space_));
        optimiser.set_upper_bounds(high(space_));
        optimiser.set_max_objective(merit_of, this);
        for (Limit& limit : limits_) optimiser.add_inequality_constraint(excess_of, &limit, 1e-9);
        optimiser.set_maxeval(evaluations);
        optimiser.set_xtol_rel(tolerance);
        double value = 0;
        try {
            optimiser.optimize(start, value);
        } catch (nlopt::roundoff_limited const&) {
            return start;  // the result is as good as rounding allows
        }
        return start;
    }

    std::optional<Variables> const& best() const { return best_; }

  private:
    struct Limit {
        Search* search;
        std::size_t number;
    };

    static double merit_of(Variables const& x, Variables&, void* self) {
        auto& me = *static_cast<Search*>(self);
        me.evaluate(x);
        return me.merit_;
    }
    static double excess_of(Variables const& x, Variables&, void* self) {
        auto const& limit = *static_cast<Limit*>(self);
        limit.search->evaluate(x);
        return limit.search->excesses_[limit.number] + margin;
    }

    /// NLopt asks for the merit and for each limit of the same drive one after another.
    void evaluate(Variables const& x) {
        if (x == last_) return;
        Drive const d = drive(x);
        double const merit = merit_function_(d);
        excesses_[0] = excess(space_, d);
        for (std::size_t k = 0; k < excess_functions_.size(); ++k) {
            double const value = excess_functions_[k](d);
            excesses_[k + 1] = std::isfinite(value) ? value : (value < 0 ? -1 : 1);
        }
        last_ = x;
        merit_ = std::isfinite(merit) ? merit : -1e6;  // the mass runs away: not a usable machine
        bool const keeps_all = std::ranges::all_of(excesses_, [](double e) { return e <= 0; });
        if (keeps_all && std::isfinite(merit) && merit > best_merit_) {
            best_merit_ = merit;
            best_ = x;
        }
    }

    DriveSpace const& space_;
    DriveFunction const& merit_function_;
    std::vector<DriveFunction> const& excess_functions_;
    std::vector<double> excesses_;
    std::vector<Limit> limits_;
    Variables last_;
    double merit_ = 0, best_merit_ = -no_limit;
    std::optional<Variables> best_;
};

}  // namespace

double Drive::angular_frequency() const {
    return 2 * pi * frequency;
}
double Drive::trough_speed() const {
    return angular_frequency() * amplitude * std::cos(vibration_angle);
}
double Drive::machine_number(double gravity) const {
    return angular_frequency() * angular_frequency() * amplitude / gravity;
}
double Drive::throw_number(double gravity) const {
    return machine_number(gravity) * std::sin(vibration_angle) / std::cos(inclination);
}

void check(DriveSpace const& s) {
    auto const range = [](Range const& r, double least, double most, char const* name, char const* text) {
        detail::require_range(r.low >= least && r.low <= r.high && r.high <= most, name, r.high, text);
    };
    range(s.frequency, 1e-3, 1e4, "frequency", "from low to high within [0.001, 10000] Hz");
    range(s.amplitude, 1e-7, 10, "amplitude", "from low to high within [1e-7, 10] m");
    range(s.vibration_angle, 1e-6, pi / 2 - 1e-6, "vibration_angle", "from low to high within (0, pi/2)");
    range(s.inclination, -pi / 2 + 1e-6, pi / 2 - 1e-6, "inclination",
          "from low to high within (-pi/2, pi/2)");
    detail::require_range(s.max_machine_number > 0 && s.max_machine_number <= 1e4, "max_machine_number",
                          s.max_machine_number, "(0, 1e4]");
    detail::require_range(s.max_throw_number > 0 && s.max_throw_number <= 1e4, "max_throw_number",
                          s.max_throw_number, "(0, 1e4]");
}

double excess(DriveSpace const& space, Drive const& drive) {
    return std::log(std::max(drive.machine_number(space.gravity) / space.max_machine_number,
                             drive.throw_number(space.gravity) / space.max_throw_number));
}

std::optional<Drive> best_drive(DriveSpace const& space, DriveFunction const& merit,
                                std::vector<DriveFunction> const& excesses,
                                DriveSearchSettings const& settings) {
    check(space);
    Search search(space, merit, excesses);
    nlopt::srand(1);
    Variables start = low(space);
    Variables const ends = high(space);
    for (std::size_t i = 2; i < start.size(); ++i) start[i] = (start[i] + ends[i]) / 2;
    if (excess(space, search.drive(start)) > 0) {
        start[2] = low(space)[2];  // the least vigorous machine that the ranges allow
        if (excess(space, search.drive(start)) > 0)
            throw std::invalid_argument(
                "even the lowest frequency and amplitude exceed the largest machine number or throw number");
    }
    Variables const rough = search.climb(nlopt::GN_ISRES, start, settings.global_evaluations, 1e-9);
    search.climb(nlopt::LN_COBYLA, search.best().value_or(rough), settings.local_evaluations, 1e-10);
    if (!search.best()) return {};
    return search.drive(*search.best());
}

}  // namespace vibrotrough::theory
