#include "engine/probe_output.hpp"

#include "core/atomic_file.hpp"
#include "core/csv.hpp"
#include "core/text.hpp"
#include "deck/deck.hpp"
#include "engine/run_report.hpp"

#include <array>
#include <cstring>
#include <sstream>

#include <fmt/format.h>

namespace vibrotrough::engine {
namespace {

core::InputError unreadable(std::filesystem::path const& path) {
    return core::InputError(
        fmt::format("{} is missing or incomplete; is the disk full?", path.filename().string()));
}

}  // namespace

std::vector<std::vector<GrainSample>> read_samples(std::filesystem::path const& path, std::size_t grains) {
    std::istringstream file(text_of_output(path));
    std::vector<std::vector<GrainSample>> times;
    for (std::string line; std::getline(file, line);) {
        if (!line.starts_with("ITEM: ATOMS")) continue;
        std::vector<GrainSample>& samples = times.emplace_back();
        for (std::size_t i = 0; i < grains; ++i) {
            std::size_t id = 0;
            GrainSample one{};
            if (!(file >> id >> one.x >> one.z >> one.vx >> one.vz >> one.spin) || id != i + 1)
                throw unreadable(path);
            samples.push_back(one);
        }
    }
    if (times.size() < 2) throw unreadable(path);
    return times;
}

std::vector<TroughSample> read_trough_samples(std::filesystem::path const& path) {
    std::vector<TroughSample> samples;
    try {
        std::string const text = core::read_file(path);
        // The deck writes the columns' names as a comment.
        core::CsvReader table(text, path.filename().string(),
                              {.comments = true,
                               .numbers = core::CsvNumbers::any,
                               .columns = {"step", "x", "z", "force_z", "grains"}});
        std::array<double, 5> row{};
        while (table.next(row)) samples.push_back({row[0], row[1], row[2], row[3], row[4]});
    } catch (core::Error const&) {
        throw unreadable(path);
    }
    if (samples.empty()) throw unreadable(path);
    return samples;
}

std::string problem_of_run(std::filesystem::path const& folder, ExitStatus status) {
    std::istringstream file(text_of_output(folder / output_file));
    bool ended = false;
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with("ERROR")) return core::harmless(line);
        if (line.starts_with(deck::end_marker)) ended = true;
    }
    if (status.signal != 0)
        return fmt::format("the engine was killed by signal {} ({})", status.signal,
                           strsignal(status.signal));
    if (status.code != 0)
        return fmt::format("the engine ended with exit code {} and no message", status.code);
    if (!ended)
        return "the engine ended with exit code 0 but without writing its end marker; is the disk full?";
    return {};
}

}  // namespace vibrotrough::engine
