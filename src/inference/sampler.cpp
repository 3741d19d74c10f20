#include "inference/sampler.hpp"

#include "inference/diagnostics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace vibrotrough::inference {
namespace {

using Point = std::vector<double>;
using Random = std::mt19937_64;

constexpr double impossible = -std::numeric_limits<double>::infinity();
/// Noise on each proposal, as a fraction of the bounds' width: it only keeps chains from the lattice that the
/// differences of a finite archive span.
constexpr double noise_of_proposals = 1e-6;
constexpr int steps_per_archive_entry = 5;

double uniform(Random& random) {
    return std::uniform_real_distribution<double>(0, 1)(random);
}

/// The state of one chain.
struct Chain {
    Point at;
    double density;
    Random random;
};

class Walk {
  public:
    Walk(LogDensity const& density, std::vector<Bounds> const& bounds, SamplerSettings const& settings)
        : density_(density), bounds_(bounds), settings_(settings) {
        for (int c = 0; c < settings.chains; ++c) {
            std::seed_seq seed{static_cast<std::uint32_t>(settings.seed),
                               static_cast<std::uint32_t>(settings.seed >> 32U),
                               static_cast<std::uint32_t>(c)};
            chains_.push_back({{}, impossible, Random(seed)});
            if (settings.starts.empty())
                start(chains_.back(), settings.points_per_start);
            else
                start_at(chains_.back(), settings.starts.at(static_cast<std::size_t>(c)));
        }
        keeps_archive_ = !settings.starts.empty();
        if (keeps_archive_) archive_ = settings.starts;
    }

    /// Fills the archive. What it holds after half of the steps, when chains may still be on their way, is
    /// thrown away; but not points about the peak, without which a few chains span too small a space.
    void warm_up(int steps) {
        for (int i = 1; i <= steps; ++i) {
            for (Chain& chain : chains_) step(chain);
            ++steps_;
            tell();
            if (i == steps / 2 && !keeps_archive_) archive_.clear();
            if (i % steps_per_archive_entry != 0) continue;
            for (Chain const& chain : chains_) archive_.push_back(chain.at);
        }
    }

    /// Appends `draws` states to each list of `kept`.
    void draw(int draws, std::vector<std::vector<double>>& kept) {
        for (int i = 0; i < draws; ++i) {
            for (std::size_t c = 0; c < chains_.size(); ++c) {
                step(chains_[c]);
                kept[c].insert(kept[c].end(), chains_[c].at.begin(), chains_[c].at.end());
            }
            ++steps_;
            tell();
        }
    }

  private:
    double density_at(Point const& point) const {
        for (std::size_t p = 0; p < point.size(); ++p) {
            if (!(point[p] >= bounds_[p].low && point[p] <= bounds_[p].high)) return impossible;
        }
        double const value = density_(point);
        return std::isnan(value) ? impossible : value;
    }

    void tell() const {
        if (settings_.progress) settings_.progress(steps_, settings_.warm_up + settings_.most_draws);
    }

    Point anywhere(Random& random) const {
        Point point;
        for (Bounds const& b : bounds_) point.push_back(b.low + (b.high - b.low) * uniform(random));
        return point;
    }

    void start(Chain& chain, int tries) {
        std::vector<Point> points;
        std::vector<double> densities;
        for (int i = 0; i < tries; ++i) {
            points.push_back(anywhere(chain.random));
            densities.push_back(density_at(points.back()));
            tell();
        }
        double const highest = *std::ranges::max_element(densities);
        if (!std::isfinite(highest)) {
            throw std::invalid_argument(
                "sample: the density is zero or infinite at all points that were tried");
        }
        std::vector<double> weights;
        for (double const d : densities) weights.push_back(std::exp(d - highest));
        auto const chosen =
            std::discrete_distribution<std::size_t>(weights.begin(), weights.end())(chain.random);
        chain.at = points[chosen];
        chain.density = densities[chosen];
        archive_.push_back(chain.at);
    }

    void start_at(Chain& chain, Point const& point) const {
        chain.at = point;
        chain.density = density_at(point);
        if (!std::isfinite(chain.density))
            throw std::invalid_argument("sample: the density is zero or infinite at a start");
    }

    Point proposal(Chain& chain) const {
        double const kind = uniform(chain.random);
        if (kind < 0.1 || archive_.size() < 3) return anywhere(chain.random);
        auto const d = static_cast<double>(bounds_.size());
        double const gamma = kind < 0.2 ? 1 : 2.38 / std::sqrt(2 * d);
        std::uniform_int_distribution<std::size_t> choose(0, archive_.size() - 1);
        std::size_t const one = choose(chain.random), other = choose(chain.random);
        Point point = chain.at;
        for (std::size_t p = 0; p < point.size(); ++p) {
            double const width = bounds_[p].high - bounds_[p].low;
            point[p] += gamma * (archive_[one][p] - archive_[other][p]) +
                        width * noise_of_proposals * std::normal_distribution<double>()(chain.random);
        }
        return point;
    }

    void step(Chain& chain) {
        Point const next = proposal(chain);
        double const density = density_at(next);
        if (!(std::log(uniform(chain.random)) < density - chain.density)) return;
        chain.at = next;
        chain.density = density;
    }

    LogDensity const& density_;
    std::vector<Bounds> const& bounds_;
    SamplerSettings const& settings_;
    int steps_ = 0;  ///< of each chain
    std::vector<Chain> chains_;
    std::vector<Point> archive_;
    bool keeps_archive_ = false;
};

void check(std::vector<Bounds> const& bounds, SamplerSettings const& s) {
    bool const settings = s.chains >= 2 && s.warm_up >= 100 && s.draws >= 8 && s.points_per_start >= 1;
    bool const starts = s.starts.empty() || s.starts.size() >= static_cast<std::size_t>(s.chains);
    if (!settings || !starts || bounds.empty()) throw std::invalid_argument("sample: settings out of range");
    for (Bounds const& b : bounds) {
        if (!(std::isfinite(b.low) && std::isfinite(b.high) && b.low < b.high))
            throw std::invalid_argument("sample: bounds must be finite, and low below high");
    }
}

void judge(Sample& sample, SamplerSettings const& settings) {
    sample.rhat.clear();
    sample.ess.clear();
    sample.converged = true;
    for (int p = 0; p < sample.parameters; ++p) {
        Chains const chains{sample.of(p), sample.chains};
        sample.rhat.push_back(rank_normalised_rhat(chains));
        sample.ess.push_back(effective_sample_size(chains));
        if (!(sample.rhat.back() <= settings.largest_rhat && sample.ess.back() >= settings.least_ess))
            sample.converged = false;
    }
}

}  // namespace

std::span<double const> Sample::draw(int chain, int number) const {
    auto const p = static_cast<std::size_t>(parameters);
    return std::span(values).subspan(static_cast<std::size_t>(chain * draws + number) * p, p);
}

std::vector<double> Sample::of(int parameter) const {
    std::vector<double> result;
    auto const stride = static_cast<std::size_t>(parameters);
    for (auto i = static_cast<std::size_t>(parameter); i < values.size(); i += stride)
        result.push_back(values[i]);
    return result;
}

Sample sample(LogDensity const& density, std::vector<Bounds> const& bounds, SamplerSettings const& settings) {
    check(bounds, settings);
    Walk walk(density, bounds, settings);
    walk.warm_up(settings.warm_up);
    Sample result{settings.chains, 0, static_cast<int>(bounds.size()), {}, {}, {}, false};
    std::vector<std::vector<double>> kept(static_cast<std::size_t>(settings.chains));
    for (int more = settings.draws; !result.converged && more > 0;
         more = std::min(result.draws, settings.most_draws - result.draws)) {
        walk.draw(more, kept);
        result.draws += more;
        result.values.clear();
        for (auto const& chain : kept) result.values.insert(result.values.end(), chain.begin(), chain.end());
        judge(result, settings);
    }
    return result;
}

}  // namespace vibrotrough::inference
