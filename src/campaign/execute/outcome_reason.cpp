#include "campaign/execute/outcome_reason.hpp"

#include "core/atomic_file.hpp"
#include "core/csv.hpp"
#include "measure/cycle_series.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <optional>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace vibrotrough::campaign {
namespace {

namespace fs = std::filesystem;

/// Why the folder takes no more, if it does not: tried, because free space alone says nothing about quotas.
std::optional<std::string> full_disk(fs::path const& folder) {
    fs::path const probe = folder / fmt::format(".probe-{}", ::getpid());
    int const file = ::open(probe.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    int reason = file < 0 ? errno : 0;
    if (file >= 0) {
        std::vector<char> const content(256 << 10, 'x');
        ssize_t const written = ::write(file, content.data(), content.size());
        if (written < 0) reason = errno;
        if (written >= 0 && written < static_cast<ssize_t>(content.size())) reason = ENOSPC;
        if (reason == 0 && ::fsync(file) != 0) reason = errno;
        ::close(file);
        ::unlink(probe.c_str());
    }
    if (reason != ENOSPC && reason != EDQUOT && reason != EFBIG) return {};
    return std::strerror(reason);
}

struct Reached {
    int cycles = 0;
    bool blew_up = false;
};

bool is_sane(double speed, double limit) {
    return std::isfinite(speed) && std::abs(speed) <= limit;
}

Reached how_far(PlannedCase const& planned, fs::path const& folder) {
    Reached reached;
    double const limit = 100 * angular_frequency(planned.scenario.trough) * planned.scenario.trough.amplitude;
    try {
        std::string const text = core::read_file(folder / "cycles.csv");
        core::CsvReader table(
            text, "cycles.csv",
            {.comments = true, .blanks = true, .growing = true, .numbers = core::CsvNumbers::any});
        std::vector<double> row(table.columns().size());
        for (; table.next(row); ++reached.cycles) {
            for (std::size_t column = 0; column < row.size(); ++column) {
                bool const is_speed =
                    table.columns()[column] == "vz_com" || table.columns()[column] == "mean_vx";
                reached.blew_up |= !std::isfinite(row[column]) || (is_speed && !is_sane(row[column], limit));
            }
        }
    } catch (core::Error const&) {  // the file is missing or damaged: what was read so far counts
    }
    reached.cycles = std::max(0, reached.cycles - 1);  // the first line is the start
    return reached;
}

bool speaks_of_memory(std::string const& message) {
    constexpr std::array<char const*, 5> words{"Failed to allocate", "Failed to reallocate", "bad_alloc",
                                               "Cannot allocate memory", "out of memory"};
    return std::ranges::any_of(words, [&](char const* word) { return message.find(word) != message.npos; });
}

}  // namespace

long count_memory_kills() {
    try {
        std::string const counts = core::read_file("/proc/vmstat");
        constexpr std::string_view name = "\noom_kill ";
        auto const at = counts.find(name);
        return at == std::string::npos ? 0 : std::strtol(counts.c_str() + at + name.size(), nullptr, 10);
    } catch (core::MissingError const&) {
        return 0;  // another kernel
    }
}

PackingOutcome find_reason(PlannedCase const& planned, int packing, PackingOutcome outcome,
                           long memory_kills) {
    if (outcome.well || outcome.outcome == "interrupted") return outcome;
    fs::path const folder = planned.packing_folder(packing);
    Reached const reached = how_far(planned, folder);
    bool const killed = outcome.message.find("signal 9") != std::string::npos;
    if (speaks_of_memory(outcome.message) || (killed && count_memory_kills() > memory_kills)) {
        outcome.outcome = "out-of-memory";
    } else if (auto const reason = full_disk(planned.folder)) {
        outcome = {false, "disk-full", fmt::format("{} takes no more ({})", folder.string(), *reason)};
    } else if (reached.blew_up) {
        outcome = {false, "diverged",
                   fmt::format("cycles.csv holds a NaN or a speed beyond 100 times the trough's ({})",
                               outcome.message)};
    }
    outcome.message += fmt::format(" [packing {}, after {} cycles]", packing, reached.cycles);
    return outcome;
}

}  // namespace vibrotrough::campaign
