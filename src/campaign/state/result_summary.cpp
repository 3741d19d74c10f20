#include "campaign/state/result_summary.hpp"

#include "campaign/state/case_state.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "store/summary.hpp"

#include <cstdint>

#include <nlohmann/json.hpp>
#include <sys/stat.h>

namespace vibrotrough::campaign {
namespace {

using Json = nlohmann::json;

std::filesystem::path summary_file(PlannedCase const& planned) {
    return planned.folder / "summary.cbor";
}

std::string layout() {
    return "vibrotrough summary 1 " + store::summary_layout();
}

/// Size, time and inode of a file; none when it is not a regular file.
std::optional<Json> stamp_of(std::filesystem::path const& file) {
    struct stat status {};
    if (::stat(file.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return {};
    std::int64_t const time = status.st_mtim.tv_sec * 1'000'000'000 + status.st_mtim.tv_nsec;
    return Json::array({status.st_size, time, status.st_ino});
}

std::string digest_of(Json::binary_t const& bytes) {
    return core::sha256_hex({reinterpret_cast<char const*>(bytes.data()), bytes.size()});
}

std::optional<store::CaseRecord> read_file(PlannedCase const& planned, Json const& stamp) {
    std::error_code missing;
    if (!std::filesystem::is_regular_file(summary_file(planned), missing)) return {};
    try {
        Json const file = Json::from_cbor(core::read_file(summary_file(planned)));
        auto const& bytes = file.at("summary").get_binary();
        if (file.at("layout") != layout() || file.at("result") != stamp ||
            file.at("sha256") != digest_of(bytes))
            return {};
        store::CaseRecord record = store::unpack_summary(bytes, planned.scenario());
        if (record.id == planned.id) return record;
    } catch (core::Error const&) {
        // Not readable, or not a summary: the same as if it were not there.
    } catch (Json::exception const&) {
    }
    return {};
}

}  // namespace

std::optional<FoundSummary> find_summary(PlannedCase const& planned) {
    auto const stamp = stamp_of(planned.result_file());
    if (!stamp) return {};
    if (auto record = read_file(planned, *stamp)) return FoundSummary{std::move(*record), false};
    auto const whole = read_whole_result(planned);
    if (!whole) return {};
    return FoundSummary{store::unpack_summary(store::pack_summary(*whole), planned.scenario()), true};
}

void write_summary(PlannedCase const& planned, store::CaseRecord const& record) {
    auto const stamp = stamp_of(planned.result_file());
    if (!stamp) return;
    Json::binary_t bytes(store::pack_summary(record));
    std::string const digest = digest_of(bytes);
    std::vector<std::uint8_t> const file = Json::to_cbor(
        {{"layout", layout()}, {"result", *stamp}, {"sha256", digest}, {"summary", std::move(bytes)}});
    try {
        core::replace_file(summary_file(planned), {reinterpret_cast<char const*>(file.data()), file.size()});
    } catch (core::MissingError const&) {
        // The folder may only be read, or the disk is full.
    }
}

}  // namespace vibrotrough::campaign
