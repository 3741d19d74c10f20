#include "core/version.hpp"

#include "version_data.hpp"

namespace vibrotrough::core {

std::string_view program_version() {
    return VIBROTROUGH_VERSION;
}

std::string_view program_commit() {
    return VIBROTROUGH_COMMIT;
}

}  // namespace vibrotrough::core
