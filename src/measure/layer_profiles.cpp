#include "measure/layer_profiles.hpp"

#include "core/error.hpp"
#include "measure/constants.hpp"
#include "measure/cycle_dump.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <string>

#include <fmt/format.h>

namespace vibrotrough::measure {
namespace {

namespace fs = std::filesystem;

/// All numbers in a line; std::nullopt if the line contains anything else.
std::optional<std::vector<double>> numbers_of(std::string_view line) {
    std::vector<double> numbers;
    char const* at = line.data();
    char const* const end = line.data() + line.size();
    while (true) {
        while (at != end && *at == ' ') ++at;
        if (at == end) return numbers;
        double number = 0;
        auto const [next, failure] = std::from_chars(at, end, number);
        if (failure != std::errc() || (next != end && *next != ' ')) return {};
        numbers.push_back(number);
        at = next;
    }
}

/// Reads a snapshot: step and number of bins, and then a line per bin with its number, middle, grains,
/// density and means.
class SnapshotParser {
  public:
    explicit SnapshotParser(core::TextFile const& file) : file_(file) {}

    std::vector<Snapshot> parse() {
        std::string const& content = file_.content;
        for (std::size_t start = 0; start < content.size();) {
            std::size_t const end = content.find('\n', start);
            if (end == std::string::npos) break;
            std::string_view const line(content.data() + start, end - start);
            start = end + 1;
            ++line_number_;
            if (line.empty() || line.front() == '#') continue;
            take(line);
        }
        if (left_ > 0) snapshots_.pop_back();
        return std::move(snapshots_);
    }

  private:
    void take(std::string_view line) {
        auto numbers = numbers_of(line);
        if (!numbers) refuse();
        if (left_ == 0) {
            if (numbers->size() != 2 || !((*numbers)[1] >= 1 && (*numbers)[1] <= 1e7)) refuse();
            snapshots_.push_back({static_cast<long>((*numbers)[0]), {}});
            left_ = static_cast<int>((*numbers)[1]);
            return;
        }
        if (numbers->size() < 5) refuse();
        snapshots_.back().bins.push_back(
            {(*numbers)[1], (*numbers)[2], (*numbers)[3], {numbers->begin() + 4, numbers->end()}});
        --left_;
    }
    [[noreturn]] void refuse() const {
        throw core::InputError(
            fmt::format("{}:{}: the line is damaged; expected {}", file_.path.string(), line_number_,
                        left_ == 0 ? "a step and a number of bins" : "the numbers of a bin"));
    }

    core::TextFile const& file_;
    int line_number_ = 0;
    int left_ = 0;  ///< number of bins of the current snapshot that have not been read yet
    std::vector<Snapshot> snapshots_;
};

/// The step at which the run that wrote NAME.STEP.txt started.
std::optional<long> start_of(fs::path const& path, std::string_view name) {
    return start_step(path, name, ".txt");
}

/// The snapshots of the evaluated cycles, sorted by phase.
std::vector<std::vector<Snapshot const*>> by_phase(std::vector<Snapshot> const& snapshots,
                                                   ProfileFacts const& facts) {
    std::vector<std::vector<Snapshot const*>> phases(static_cast<std::size_t>(facts.phases));
    long const n = facts.steps_per_cycle;
    for (Snapshot const& one : snapshots) {
        if (one.step <= facts.discarded * n || one.step > facts.used * n) continue;
        phases[static_cast<std::size_t>(one.step % n * facts.phases / n)].push_back(&one);
    }
    return phases;
}

/// The mean v_x between two fractions of the mass, counted from the bottom. All bins have the same volume, so
/// that their masses are as their densities.
double mean_between(Snapshot const& one, double from, double to) {
    double mass = 0;
    for (Bin const& bin : one.bins) mass += bin.density;
    double below = 0, sum = 0;
    for (Bin const& bin : one.bins) {
        double const low = std::max(below, from * mass), high = std::min(below + bin.density, to * mass);
        if (high > low) sum += (high - low) * bin.means[0];
        below += bin.density;
    }
    return sum / ((to - from) * mass);
}

/// The mean over the phases of the mean over the snapshots of each phase.
template <class Value>
std::optional<double> mean_over_phases(std::vector<std::vector<Snapshot const*>> const& phases,
                                       Value const& value) {
    double sum = 0;
    int seen = 0;
    for (auto const& snapshots : phases) {
        double at_phase = 0;
        for (Snapshot const* one : snapshots) at_phase += value(*one);
        if (snapshots.empty()) continue;
        sum += at_phase / static_cast<double>(snapshots.size());
        ++seen;
    }
    if (seen == 0) return {};
    return sum / seen;
}

/// The first and last bin that ever contained a grain, as a half-open range.
std::pair<std::size_t, std::size_t> occupied(std::vector<std::vector<Snapshot const*>> const& phases) {
    std::size_t first = std::numeric_limits<std::size_t>::max(), last = 0;
    for (auto const& snapshots : phases) {
        for (Snapshot const* one : snapshots) {
            for (std::size_t b = 0; b < one->bins.size(); ++b) {
                if (one->bins[b].grains == 0) continue;
                first = std::min(first, b);
                last = std::max(last, b + 1);
            }
        }
    }
    return {first, last};
}

void add_bin(Profiles& profiles, std::vector<Snapshot const*> const& snapshots, std::size_t bin,
             std::size_t phase, ProfileFacts const& facts) {
    double grains = 0, density = 0, vx = 0, vz = 0;
    for (Snapshot const* one : snapshots) {
        Bin const& b = one->bins[bin];
        grains += b.grains;
        density += b.density;
        vx += b.grains * b.means[0];
        vz += b.grains * b.means[1];
    }
    profiles.phase.push_back(2 * std::numbers::pi * static_cast<double>(phase) / facts.phases);
    profiles.height.push_back(snapshots.front()->bins[bin].position - facts.trough_z[phase]);
    profiles.solid_fraction.push_back(density / static_cast<double>(snapshots.size()) / facts.density);
    profiles.velocity_x.push_back(grains > 0 ? vx / grains - facts.trough_vx[phase] : gap);
    profiles.velocity_z.push_back(grains > 0 ? vz / grains - facts.trough_vz[phase] : gap);
}

/// The variance of the height of the surface along the trough.
double surface_variance(Snapshot const& one) {
    double sum = 0, squares = 0, filled = 0;
    for (Bin const& bin : one.bins) {
        if (bin.grains == 0) continue;
        double const height = 2 * bin.means[0];
        sum += height;
        squares += height * height;
        ++filled;
    }
    if (filled < 2) return 0;
    return std::max(0.0, squares - sum * sum / filled) / (filled - 1);
}

}  // namespace

std::vector<Snapshot> read_snapshots(fs::path const& folder, std::string_view name) {
    std::vector<core::TextFile> files;
    std::error_code missing;
    for (auto const& entry : fs::directory_iterator(folder, missing)) {
        if (start_of(entry.path(), name)) files.push_back(core::read_text_file(entry.path()));
    }
    return parse_snapshots(files, folder, name);
}

std::vector<Snapshot> parse_snapshots(std::vector<core::TextFile> const& files, fs::path const& folder,
                                      std::string_view name) {
    std::map<long, core::TextFile const*> by_start;
    for (core::TextFile const& file : files) {
        if (auto const start = start_of(file.path, name)) by_start[*start] = &file;
    }
    if (by_start.empty())
        throw core::MissingError(
            fmt::format("{} does not contain {}.*.txt; run the packing again", folder.string(), name));
    std::vector<Snapshot> all;
    for (auto const& [start, file] : by_start) {
        std::erase_if(all, [first = start](Snapshot const& one) { return one.step >= first; });
        for (Snapshot& one : SnapshotParser(*file).parse()) {
            if (!all.empty() && one.bins.size() != all.front().bins.size())
                throw core::InputError(
                    fmt::format("{} contains snapshots of different size", file->path.string()));
            all.push_back(std::move(one));
        }
    }
    return all;
}

Profiles layer_profiles(std::vector<Snapshot> const& snapshots, ProfileFacts const& facts) {
    auto const phases = by_phase(snapshots, facts);
    auto const [first, last] = occupied(phases);
    Profiles profiles{};
    for (std::size_t phase = 0; phase < phases.size(); ++phase) {
        if (phases[phase].empty()) continue;
        for (std::size_t bin = first; bin < last; ++bin) add_bin(profiles, phases[phase], bin, phase, facts);
    }
    std::optional<double> const difference = mean_over_phases(phases, [](Snapshot const& one) {
        return mean_between(one, 2.0 / 3, 1) - mean_between(one, 0, 1.0 / 3);
    });
    double const drive = std::ranges::max(facts.trough_vx);
    bool const conveyed = std::abs(facts.conveying_speed) > 0.01 * drive;
    if (conveyed && difference) profiles.velocity_gradient = *difference / facts.conveying_speed;
    return profiles;
}

Surface layer_surface(std::vector<Snapshot> const& snapshots, ProfileFacts const& facts) {
    auto const phases = by_phase(snapshots, facts);
    Surface surface{};
    for (std::size_t phase = 0; phase < phases.size(); ++phase) {
        if (phases[phase].empty()) continue;
        for (Bin const& bin : phases[phase].back()->bins) {
            surface.phase.push_back(2 * std::numbers::pi * static_cast<double>(phase) / facts.phases);
            surface.x.push_back(bin.position);
            surface.height.push_back(bin.grains > 0 ? 2 * bin.means[0] : gap);
        }
    }
    if (auto const variance = mean_over_phases(phases, surface_variance))
        surface.wiggle_amplitude = std::sqrt(2 * *variance);
    return surface;
}

}  // namespace vibrotrough::measure
