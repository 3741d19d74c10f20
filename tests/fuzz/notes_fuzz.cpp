// Whatever lies in place of a note of JSON, packing.json or a certificate: it is believed whole, or not at
// all, and what is believed is the same when it is written and read again.

#include "core/error.hpp"
#include "core/temporary_folder.hpp"
#include "engine/certificate.hpp"
#include "evaluate/packing_files.hpp"

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>

namespace {

using namespace vibrotrough;
namespace fs = std::filesystem;

fs::path const& folder() {
    static core::TemporaryFolder const made("vibrotrough-fuzz");
    return made.path();
}

void require(bool good) {
    if (!good) std::abort();
}

/// The tables of the packing are empty; "@cycles" and "@layer" stand for their digests.
void check_marker(std::string text) {
    for (char const* name : {"cycles.csv", "phases.csv"}) std::ofstream(folder() / name).close();
    auto const files = evaluate::read_packing_files(folder());
    for (auto const& [word, digest] :
         {std::pair("@cycles", files.cycles_sha256), std::pair("@layer", files.layer_sha256)}) {
        if (auto const at = text.find(word); at != std::string::npos)
            text.replace(at, std::string_view(word).size(), digest);
    }
    std::ofstream(folder() / "packing.json", std::ios::binary) << text;
    auto const marker = evaluate::read_marker(files);
    if (!marker) return;
    evaluate::write_marker(files, *marker);
    auto const again = evaluate::read_marker(files);
    require(again && again->started == marker->started && again->host == marker->host &&
            again->deck_sha256 == marker->deck_sha256 && again->start_efficiency == marker->start_efficiency);
}

void check_certificate(std::string_view text) {
    auto const certificate = engine::parse_certificate(text);
    if (!certificate) return;
    auto const again = engine::parse_certificate(to_json(*certificate));
    require(again && again->probes.size() == certificate->probes.size() &&
            again->passed() == certificate->passed());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
    std::string_view const text(reinterpret_cast<char const*>(data), size);
    try {
        check_marker(std::string(text));
    } catch (core::Error const&) {
    }
    check_certificate(text);
    return 0;
}
