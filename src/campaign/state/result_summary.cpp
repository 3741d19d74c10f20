#include "campaign/state/result_summary.hpp"

#include "campaign/state/case_state.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "evaluate/case.hpp"
#include "store/summary.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

namespace vibrotrough::campaign {
namespace {

using Json = nlohmann::json;

std::filesystem::path summary_file(PlannedCase const& planned) {
    return planned.folder / "summary";
}

/// Size, time and inode of a file, as a list in JSON; none when it is not a regular file.
std::optional<std::string> stamp_of(std::filesystem::path const& file) {
    struct stat status {};
    if (::stat(file.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return {};
    std::int64_t const time = status.st_mtim.tv_sec * 1'000'000'000 + status.st_mtim.tv_nsec;
    return fmt::format("[{},{},{}]", status.st_size, time, status.st_ino);
}

/// The first line of the file, in JSON: what the summary was made from. The second one is the SHA-256 of the
/// result, and the packed summary follows.
std::string header(std::string const& stamp) {
    static std::string const layout = Json("vibrotrough summary 7 " + store::summary_layout()).dump();
    return "{\"layout\":" + layout + ",\"result\":" + stamp + "}\n";
}

constexpr std::size_t digest_line = 65;  ///< length of the second line

std::string digest_of_result(PlannedCase const& planned) {
    return core::sha256_hex(core::read_file(planned.result_file()));
}

std::optional<store::CaseRecord> read_file(PlannedCase const& planned, std::string const& stamp,
                                           Trust trust) {
    std::error_code missing;
    if (!std::filesystem::is_regular_file(summary_file(planned), missing)) return {};
    try {
        std::string const file = core::read_file(summary_file(planned)), expected = header(stamp);
        std::size_t const start = expected.size() + digest_line;
        if (!file.starts_with(expected) || file.size() < start || file[start - 1] != '\n') return {};
        std::string_view const digest = std::string_view(file).substr(expected.size(), digest_line - 1);
        std::span const bytes(reinterpret_cast<std::uint8_t const*>(file.data()), file.size());
        store::CaseRecord record = store::unpack_summary(bytes.subspan(start), planned.scenario());
        if (record.id != planned.id || (trust != Trust::stamp && digest_of_result(planned) != digest))
            return {};
        judge_again(planned, record);
        return record;
    } catch (core::Error const&) {
        // Not readable, or not a summary: the same as if it were not there.
    }
    return {};
}

}  // namespace

std::optional<FoundSummary> find_summary(PlannedCase const& planned, Trust trust) {
    auto const stamp = stamp_of(planned.result_file());
    if (!stamp) return {};
    if (auto record = read_file(planned, *stamp, trust)) return FoundSummary{std::move(*record), false};
    auto const whole = read_whole_result(planned);
    if (!whole) return {};
    FoundSummary found{store::summary_of(*whole), true};
    found.record.scenario = planned.scenario();  // with the files that result.h5 only names
    return found;
}

bool is_summary_of_result(PlannedCase const& planned, store::CaseRecord const& summary) {
    auto const whole = read_whole_result(planned);
    return whole && store::pack_summary(*whole) == store::pack_summary(summary);
}

void write_summary(PlannedCase const& planned, store::CaseRecord const& record) {
    auto const stamp = stamp_of(planned.result_file());
    if (!stamp) return;
    std::vector<std::uint8_t> const bytes = store::pack_summary(record);
    try {
        core::replace_file(
            summary_file(planned),
            (header(*stamp) + digest_of_result(planned) + "\n").append(bytes.begin(), bytes.end()));
    } catch (core::MissingError const&) {
        // The folder may only be read, or the disk is full.
    }
}

}  // namespace vibrotrough::campaign
