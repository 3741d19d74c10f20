#include "campaign/state/result_index.hpp"

#include "campaign/state/case_state.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "store/summary.hpp"

#include <cstring>

#include <sys/stat.h>

namespace vibrotrough::campaign {
namespace {

constexpr std::size_t id_length = 12;
constexpr std::size_t digest_length = 64;

std::string head() {
    return "vibrotrough index " + store::summary_layout() + "\n";
}

template <typename Number>
void put(std::string& bytes, Number number) {
    char raw[sizeof number];
    std::memcpy(raw, &number, sizeof number);
    bytes.append(raw, sizeof number);
}

template <typename Number>
Number take(std::string_view& bytes) {
    Number number{};
    if (bytes.size() < sizeof number) throw core::InputError("the index ends too early");
    std::memcpy(&number, bytes.data(), sizeof number);
    bytes.remove_prefix(sizeof number);
    return number;
}

}  // namespace

ResultIndex::ResultIndex(Plan const& plan) : file_(plan.folder / ".index") {
    try {
        load();
    } catch (core::Error const&) {
        entries_.clear();  // none, of another version, or damaged: made anew
    }
}

void ResultIndex::load() {
    std::string const content = core::read_file(file_);
    std::string const start = head();
    if (content.size() < start.size() + digest_length || !content.starts_with(start)) return;
    std::string_view bytes(content);
    std::string_view const digest = bytes.substr(bytes.size() - digest_length);
    bytes.remove_suffix(digest_length);
    if (core::sha256_hex(bytes) != digest) return;
    bytes.remove_prefix(start.size());
    while (!bytes.empty()) {
        if (bytes.size() < id_length) throw core::InputError("the index ends too early");
        std::string const id(bytes.substr(0, id_length));
        bytes.remove_prefix(id_length);
        Entry entry{};
        entry.stamp = {take<std::int64_t>(bytes), take<std::int64_t>(bytes), take<std::int64_t>(bytes)};
        auto const size = take<std::uint32_t>(bytes);
        if (bytes.size() < size) throw core::InputError("the index ends too early");
        entry.summary = std::string(bytes.substr(0, size));
        bytes.remove_prefix(size);
        entries_.emplace(id, std::move(entry));
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
            std::string_view bytes = found->second.summary;
            return store::unpack_summary(bytes, planned.scenario());
        } catch (core::InputError const&) {
            // As good as not there.
        }
    }
    auto const record = read_whole_result(planned);
    if (!record) return {};
    Entry& entry = entries_[planned.id];
    entry = {*stamp, store::pack_summary(*record)};
    changed_ = true;
    std::string_view bytes = entry.summary;
    return store::unpack_summary(bytes, planned.scenario());
}

void ResultIndex::remember(PlannedCase const& planned, store::CaseRecord const& record) {
    auto const stamp = stamp_of(planned.result_file());
    if (!stamp) return;
    entries_[planned.id] = {*stamp, store::pack_summary(record)};
    changed_ = true;
}

void ResultIndex::save() {
    if (!changed_) return;
    std::string bytes = head();
    for (auto const& [id, entry] : entries_) {
        if (id.size() != id_length) continue;
        bytes += id;
        put(bytes, entry.stamp.size);
        put(bytes, entry.stamp.time);
        put(bytes, entry.stamp.inode);
        put(bytes, static_cast<std::uint32_t>(entry.summary.size()));
        bytes += entry.summary;
    }
    bytes += core::sha256_hex(bytes);
    try {
        core::write_file_atomically(file_, bytes);
        changed_ = false;
    } catch (core::MissingError const&) {
    }
}

}  // namespace vibrotrough::campaign
