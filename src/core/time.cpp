#include "core/time.hpp"

#include <array>
#include <ctime>

#include <fmt/chrono.h>
#include <unistd.h>

namespace vibrotrough::core {

std::string utc_now() {
    return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

std::string host_name() {
    std::array<char, 256> name{};
    if (::gethostname(name.data(), name.size() - 1) != 0) return "unknown";
    return name.data();
}

}  // namespace vibrotrough::core
