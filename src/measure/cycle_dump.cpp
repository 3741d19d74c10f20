#include "measure/cycle_dump.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace vibrotrough::measure {
namespace {

using Snapshots = std::map<long, std::vector<DumpedGrain>>;

/// Reads the snapshots of one file. The first one, of the step at which the run started, belongs to the run
/// before it, which took its grains out.
void read_snapshots(core::TextFile const& file, std::string_view columns, int steps_per_cycle, long start,
                    Snapshots& all) {
    std::istringstream text(file.content);
    auto const damaged = [&] {
        throw core::InputError(fmt::format("{} is damaged; run its case again", file.path.string()));
    };
    // Whether there is a whole line; the engine may be writing the last one.
    auto const next = [&](std::string& line) { return std::getline(text, line) && !text.eof(); };
    auto const count_of_columns = static_cast<std::size_t>(std::ranges::count(columns, ' ')) + 1;
    std::string const header = fmt::format("ITEM: ATOMS {}", columns);
    std::string line;
    while (next(line)) {
        if (line != "ITEM: TIMESTEP") damaged();
        long step = -1, count = -1;
        std::vector<std::string> head(9);  // step, number of grains, box, columns
        for (std::size_t i = 1; i < head.size(); ++i)
            if (!next(head[i])) return;
        std::istringstream(head[1]) >> step;
        std::istringstream(head[3]) >> count;
        if (step < 0 || count < 0 || count > 100'000'000 || step % steps_per_cycle != 0 ||
            !head[8].starts_with(header))
            damaged();
        std::vector<DumpedGrain> grains;
        for (long i = 0; i < count; ++i) {
            if (!next(line)) return;
            DumpedGrain grain{static_cast<int>(step / steps_per_cycle), {}};
            std::istringstream numbers(line);
            for (std::size_t column = 0; column < count_of_columns; ++column)
                if (!(numbers >> grain.values.at(column))) damaged();
            grains.push_back(grain);
        }
        if (step > start) all[step] = std::move(grains);
    }
}

}  // namespace

std::optional<long> start_step(std::filesystem::path const& path, std::string_view name,
                               std::string_view ending) {
    std::string const file = path.filename().string(), begin = std::string(name) + ".";
    if (!file.starts_with(begin) || !file.ends_with(ending) || file.size() < begin.size() + ending.size())
        return {};
    long step = 0;
    char const* const last = file.data() + file.size() - ending.size();
    auto const [rest, failure] = std::from_chars(file.data() + begin.size(), last, step);
    return failure == std::errc() && rest == last ? std::optional(step) : std::nullopt;
}

std::vector<DumpedGrain> parse_cycle_dumps(std::vector<core::TextFile> const& files, std::string_view name,
                                           std::string_view columns, int steps_per_cycle) {
    std::map<long, core::TextFile const*> by_start;
    for (core::TextFile const& file : files)
        if (auto const start = start_step(file.path, name, ".dump")) by_start[*start] = &file;
    Snapshots all;
    for (auto const& [start, file] : by_start) {
        all.erase(all.upper_bound(start), all.end());
        read_snapshots(*file, columns, steps_per_cycle, start, all);
    }
    std::vector<DumpedGrain> found;
    for (auto const& [step, grains] : all) found.insert(found.end(), grains.begin(), grains.end());
    return found;
}

}  // namespace vibrotrough::measure
