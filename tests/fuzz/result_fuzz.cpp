// Whatever bytes stand where a result or its summary should be: they are whole, or refused. Both carry a
// digest of themselves, so that HDF5 and the reader of CBOR see only what the program has written.

#include "core/error.hpp"
#include "core/hash.hpp"
#include "store/result_file.hpp"
#include "store/summary.hpp"

#include <cstdint>
#include <cstdlib>
#include <string>

#include <sys/mman.h>
#include <unistd.h>

namespace {

using namespace vibrotrough;

void read(std::string const& bytes) {
    static int const file = ::memfd_create("result", 0);
    if (::ftruncate(file, 0) != 0) return;
    if (::pwrite(file, bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) return;
    try {
        store::read_result("/proc/self/fd/" + std::to_string(file));
    } catch (core::Error const&) {
    }
}

/// Also with a right digest under wrong bytes, which nobody but an attacker makes: this tests HDF5 itself.
bool const deep = std::getenv("VIBROTROUGH_FUZZ_DEEP") != nullptr;

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
    std::string const bytes(reinterpret_cast<char const*>(data), size);
    read(bytes);
    if (deep) read(bytes + "\nvibrotrough sha256 " + core::sha256_hex(bytes) + "\n");
    try {
        store::unpack_summary({data, size}, scenario::Scenario{});
    } catch (core::Error const&) {
    }
    return 0;
}
