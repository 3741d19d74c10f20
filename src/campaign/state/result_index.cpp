#include "campaign/state/result_index.hpp"

#include "campaign/state/case_state.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "store/summary.hpp"

#include <utility>

#include <nlohmann/json.hpp>
#include <sys/stat.h>

namespace vibrotrough::campaign {
namespace {

using Json = nlohmann::json;

/// The file is CBOR of {"layout": text, "sha256": of the entries, "entries": bytes}. The bytes are CBOR of
/// one [case id, size, time, inode, summary] per result.
std::string layout() {
    return "vibrotrough index 2 " + store::summary_layout();
}

std::string digest_of(Json::binary_t const& bytes) {
    return core::sha256_hex({reinterpret_cast<char const*>(bytes.data()), bytes.size()});
}

}  // namespace

ResultIndex::ResultIndex(Plan const& plan) : file_(plan.folder / ".index") {
    try {
        load();
    } catch (core::Error const&) {
        entries_.clear();  // There is no such file.
    } catch (Json::exception const&) {
        entries_.clear();  // It is damaged, or of another version.
    }
}

void ResultIndex::load() {
    Json const file = Json::from_cbor(core::read_file(file_));
    auto const& bytes = file.at("entries").get_binary();
    if (file.at("layout") != layout() || file.at("sha256") != digest_of(bytes)) return;
    Json entries = Json::from_cbor(bytes.begin(), bytes.end());
    for (Json& one : entries) {
        Stamp const stamp{one.at(1).get<std::int64_t>(), one.at(2).get<std::int64_t>(),
                          one.at(3).get<std::int64_t>()};
        entries_.emplace(one.at(0).get<std::string>(), Entry{stamp, std::move(one.at(4).get_binary())});
    }
}

std::optional<ResultIndex::Stamp> ResultIndex::stamp_of(std::filesystem::path const& file) {
    struct stat status {};
    if (::stat(file.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return {};
    return Stamp{status.st_size, status.st_mtim.tv_sec * 1'000'000'000 + status.st_mtim.tv_nsec,
                 static_cast<std::int64_t>(status.st_ino)};
}

std::optional<store::CaseRecord> ResultIndex::find(PlannedCase const& planned) {
    auto const stamp = stamp_of(planned.result_file());
    if (!stamp) return {};
    auto const found = entries_.find(planned.id);
    if (found != entries_.end() && found->second.stamp == *stamp) {
        try {
            return store::unpack_summary(found->second.summary, planned.scenario());
        } catch (core::InputError const&) {
            // The same as if it were not there.
        }
    }
    auto const record = read_whole_result(planned);
    if (!record) return {};
    Entry& entry = entries_[planned.id];
    entry = {*stamp, store::pack_summary(*record)};
    changed_ = true;
    return store::unpack_summary(entry.summary, planned.scenario());
}

void ResultIndex::remember(PlannedCase const& planned, store::CaseRecord const& record) {
    auto const stamp = stamp_of(planned.result_file());
    if (!stamp) return;
    entries_[planned.id] = {*stamp, store::pack_summary(record)};
    changed_ = true;
}

void ResultIndex::save() {
    if (!changed_) return;
    Json entries = Json::array();
    for (auto const& [id, entry] : entries_) {
        auto const& [size, time, inode] = entry.stamp;
        entries.push_back({id, size, time, inode, Json::binary(entry.summary)});
    }
    Json::binary_t bytes(Json::to_cbor(entries));
    std::string const digest = digest_of(bytes);
    std::vector<std::uint8_t> const file =
        Json::to_cbor({{"layout", layout()}, {"sha256", digest}, {"entries", std::move(bytes)}});
    try {
        core::write_file_atomically(file_, {reinterpret_cast<char const*>(file.data()), file.size()});
        changed_ = false;
    } catch (core::MissingError const&) {
        // The folder may only be read.
    }
}

}  // namespace vibrotrough::campaign
