#include "archive/zip_file.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/limits.hpp"
#include "core/text.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include <archive.h>
#include <archive_entry.h>
#include <fmt/format.h>
#include <locale.h>
#include <unistd.h>

namespace vibrotrough::archive {
namespace {

namespace fs = std::filesystem;

using Writer = std::unique_ptr<struct ::archive, decltype(&archive_write_free)>;
using Reader = std::unique_ptr<struct ::archive, decltype(&archive_read_free)>;
using Entry = std::unique_ptr<archive_entry, decltype(&archive_entry_free)>;

constexpr std::size_t longest_name = 1000;  // bytes
constexpr std::size_t piece = std::size_t{1} << 16;

[[noreturn]] void refuse_to_write(fs::path const& path, char const* reason) {
    throw core::MissingError(fmt::format("cannot write {} ({}); free disk space or choose another place",
                                         path.string(), reason == nullptr ? "unknown reason" : reason));
}

/// libarchive says no more than "Write error" where a system call has a reason.
std::string reason_of_failure(struct ::archive* writer) {
    int const error = archive_errno(writer);
    if (error > 0) return core::reason_of(error);
    char const* const reason = archive_error_string(writer);
    return reason == nullptr ? "unknown reason" : reason;
}

[[noreturn]] void refuse_to_read(fs::path const& path, std::string const& reason) {
    throw core::InputError(fmt::format("{} {}; nothing of it is used", path.string(), reason));
}

/// libarchive takes names in the letters of the locale. While an object exists, these are UTF-8 in this
/// thread, whatever the user's locale is.
class Utf8Names {
  public:
    Utf8Names() : utf8_(::newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr)) {
        if (utf8_ != nullptr) before_ = ::uselocale(utf8_);
    }
    ~Utf8Names() {
        if (utf8_ == nullptr) return;
        ::uselocale(before_);
        ::freelocale(utf8_);
    }
    Utf8Names(Utf8Names const&) = delete;
    Utf8Names& operator=(Utf8Names const&) = delete;

  private:
    locale_t utf8_, before_ = nullptr;
};

/// A ZIP file that is read from its beginning: without its list of contents, which may be as large as it
/// likes.
Reader open_zip(fs::path const& path) {
    Reader reader(archive_read_new(), archive_read_free);
    if (!reader || archive_read_support_format_zip_streamable(reader.get()) != ARCHIVE_OK)
        throw core::MissingError("libarchive cannot read ZIP files here");
    if (archive_read_open_filename(reader.get(), path.c_str(), piece) != ARCHIVE_OK)
        refuse_to_read(path, fmt::format("is not a ZIP file ({})", archive_error_string(reader.get())));
    return reader;
}

std::string damage(struct ::archive* reader) {
    char const* const reason = archive_error_string(reader);
    return fmt::format("is damaged ({})", reason == nullptr ? "unknown reason" : core::harmless(reason));
}

/// Hands the content of an entry on.
void read_content(fs::path const& path, struct ::archive* reader, ZipSink const& sink) {
    std::array<char, piece> buffer{};
    while (true) {
        la_ssize_t const count = archive_read_data(reader, buffer.data(), buffer.size());
        if (count == 0) return;
        if (count < 0) refuse_to_read(path, damage(reader));
        sink(std::string_view(buffer.data(), static_cast<std::size_t>(count)));
    }
}

}  // namespace

struct ZipWriter::State {
    fs::path path;
    core::NewFile file;
    Writer writer{archive_write_new(), archive_write_free};

    explicit State(fs::path const& name) : path(name), file(name) {}
};

ZipWriter::ZipWriter(fs::path const& path) : state_(std::make_unique<State>(path)) {
    struct ::archive* const writer = state_->writer.get();
    if (archive_write_set_format_zip(writer) != ARCHIVE_OK ||
        archive_write_zip_set_compression_deflate(writer) != ARCHIVE_OK ||
        archive_write_open_fd(writer, state_->file.descriptor()) != ARCHIVE_OK)
        refuse_to_write(path, archive_error_string(writer));
}

ZipWriter::~ZipWriter() = default;

void ZipWriter::add(std::string const& name, std::string_view content) {
    Utf8Names const names;
    struct ::archive* const writer = state_->writer.get();
    Entry const entry(archive_entry_new(), archive_entry_free);
    archive_entry_set_pathname(entry.get(), name.c_str());
    archive_entry_set_filetype(entry.get(), AE_IFREG);
    archive_entry_set_perm(entry.get(), 0644);
    archive_entry_set_size(entry.get(), static_cast<la_int64_t>(content.size()));
    if (archive_write_header(writer, entry.get()) != ARCHIVE_OK ||
        archive_write_data(writer, content.data(), content.size()) !=
            static_cast<la_ssize_t>(content.size()) ||
        archive_write_finish_entry(writer) != ARCHIVE_OK)
        refuse_to_write(state_->path, reason_of_failure(writer).c_str());
}

void ZipWriter::finish() {
    if (archive_write_close(state_->writer.get()) != ARCHIVE_OK)
        refuse_to_write(state_->path, archive_error_string(state_->writer.get()));
    state_->file.finish(core::Sync::yes);
}

void read_zip(fs::path const& path, std::function<ZipSink(std::string const& name)> const& file,
              std::function<void()> const& done) {
    Utf8Names const names;
    Reader const reader = open_zip(path);
    for (archive_entry* entry = nullptr;;) {
        int const found = archive_read_next_header(reader.get(), &entry);
        if (found == ARCHIVE_EOF) break;
        if (found != ARCHIVE_OK) refuse_to_read(path, damage(reader.get()));
        char const* const utf8 = archive_entry_pathname_utf8(entry);
        std::string name = utf8 == nullptr ? "" : utf8;
        bool const is_folder = name.ends_with('/') || archive_entry_filetype(entry) == AE_IFDIR;
        if (is_folder && name.ends_with('/')) name.pop_back();
        if (!is_safe_name(name)) {
            refuse_to_read(path, fmt::format("holds an entry '{}' that could lead out of its folder", name));
        }
        if (is_folder) continue;
        if (archive_entry_filetype(entry) != AE_IFREG || archive_entry_is_encrypted(entry) != 0) {
            refuse_to_read(path, fmt::format("holds '{}', which is not an ordinary file", name));
        }
        read_content(path, reader.get(), file(name));
        done();
    }
}

std::string first_name_in_zip(fs::path const& path) {
    // PKWARE's APPNOTE.TXT, 4.3.7: the length of the first name stands at byte 26, the name at byte 30.
    std::array<unsigned char, 30> head{};
    core::Descriptor const file = core::open_to_read(path, core::Kinds::regular);
    std::string name;
    if (::read(file.number(), head.data(), head.size()) == static_cast<ssize_t>(head.size()) &&
        std::memcmp(head.data(), "PK\3\4", 4) == 0) {
        name.resize(static_cast<std::size_t>(head[26]) + 256 * static_cast<std::size_t>(head[27]));
        ssize_t const count = ::read(file.number(), name.data(), name.size());
        name.resize(count < 0 ? 0 : static_cast<std::size_t>(count));
    }
    return name;
}

bool is_safe_name(std::string_view name) {
    if (name.empty() || name.size() > longest_name || core::harmless(name) != name) return false;
    if (name.find_first_of("\\:\n\t") != std::string_view::npos) return false;
    for (std::size_t begin = 0; begin <= name.size();) {
        std::size_t const end = std::min(name.find('/', begin), name.size());
        std::string_view const part = name.substr(begin, end - begin);
        if (part.empty() || part == "." || part == ".." || part.size() > 255) return false;
        begin = end + 1;
    }
    return true;
}

}  // namespace vibrotrough::archive
