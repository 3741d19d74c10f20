#include "campaign/execute/failure_cause.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/limits.hpp"
#include "evaluate/packing.hpp"

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <optional>

#include <fmt/format.h>
#include <unistd.h>

namespace vibrotrough::campaign {
namespace {

namespace fs = std::filesystem;

/// Why the folder takes no more, if it does not: tried, because free space alone says nothing about quotas.
std::optional<std::string> full_disk(fs::path const& folder) {
    fs::path const probe = folder / fmt::format(".probe-{}", ::getpid());
    std::optional<std::string> reason;
    try {
        core::write_file_atomically(probe, std::string(256 << 10, 'x'));
    } catch (core::DiskFullError const& error) {
        reason = error.what();
    } catch (core::MissingError const&) {
        // Not full, but the folder is gone or may not be written to.
    }
    std::error_code missing;
    fs::remove(probe, missing);
    return reason;
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

PackingEnd find_cause(PlannedCase const& planned, int packing, PackingEnd end, long memory_kills) {
    if (!end.failure || end.failure == core::Outcome::interrupted || end.failure == core::Outcome::disk_full)
        return end;  // it is known already
    fs::path const folder = planned.packing_folder(packing);
    evaluate::RunExtent const extent = evaluate::extent_of_run(*planned.prepared, folder);
    if (end.signal == SIGKILL && count_memory_kills() > memory_kills) {
        end.failure = core::Outcome::out_of_memory;
    } else if (auto const reason = full_disk(planned.folder);
               reason && end.failure != core::Outcome::out_of_memory) {
        end.failure = core::Outcome::disk_full;
        end.message = fmt::format("{} takes no more ({})", folder.string(), *reason);
    } else if (end.signal == SIGXFSZ) {
        end.failure = core::Outcome::disk_full;
        end.message = fmt::format("a file of {} cannot grow ({})", folder.string(), core::reason_of(EFBIG));
    } else if (extent.diverged) {
        end.failure = core::Outcome::diverged;
        end.message =
            fmt::format("cycles.csv holds a NaN or a speed above 100 times the trough's ({})", end.message);
    }
    end.message += fmt::format(" [packing {}, after {} cycles]", packing, extent.cycles);
    return end;
}

}  // namespace vibrotrough::campaign
