#include "archive/zip_file.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/limits.hpp"
#include "core/text.hpp"

#include <archive.h>
#include <archive_entry.h>
#include <fmt/format.h>
#include <locale.h>

namespace vibrotrough::archive {
namespace {

namespace fs = std::filesystem;

using Writer = std::unique_ptr<struct ::archive, decltype(&archive_write_free)>;
using Entry = std::unique_ptr<archive_entry, decltype(&archive_entry_free)>;

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

}  // namespace vibrotrough::archive
