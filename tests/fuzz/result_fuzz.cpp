// Whatever bytes stand where a result should be: they are a whole result, or refused. The same for the index of
// results. result.h5 carries a digest of itself, so that HDF5 sees only what the program has written.

#include "core/error.hpp"
#include "store/result_file.hpp"
#include "store/summary.hpp"

#include <cstdint>
#include <string>
#include <string_view>

#include <sys/mman.h>
#include <unistd.h>

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
    using namespace vibrotrough;
    static int const file = ::memfd_create("result", 0);
    if (::ftruncate(file, 0) != 0 || ::pwrite(file, data, size, 0) != static_cast<ssize_t>(size)) return 0;
    try {
        store::read_result("/proc/self/fd/" + std::to_string(file));
    } catch (Error const&) {
    }
    try {
        std::string_view bytes(reinterpret_cast<char const*>(data), size);
        while (!bytes.empty()) store::unpack_summary(bytes, Scenario{});
    } catch (Error const&) {
    }
    return 0;
}
