#include "core/temporary_folder.hpp"

#include "core/error.hpp"
#include "core/limits.hpp"

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>

#include <fmt/format.h>

namespace vibrotrough::core {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder(std::string_view purpose) {
    std::error_code failure;
    fs::path const parent = fs::temp_directory_path(failure);
    if (failure) {
        throw MissingError(
            fmt::format("there is no folder for temporary files ({}); set TMPDIR to a folder that exists",
                        failure.message()));
    }
    // The folder is also used by programs that are started elsewhere.
    std::string name = (fs::absolute(parent) / fmt::format("{}-XXXXXX", purpose)).string();
    if (::mkdtemp(name.data()) == nullptr) {
        throw MissingError(
            fmt::format("cannot make a temporary folder in {} ({}); set TMPDIR to another folder",
                        parent.string(), reason_of(errno)));
    }
    path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

}  // namespace vibrotrough::core
