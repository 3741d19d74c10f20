// Whatever an engine prints or leaves in its tables: the run gets a name and one printable line, and never
// crashes its driver.

#include "core/error.hpp"
#include "core/temporary_folder.hpp"
#include "core/text.hpp"
#include "engine/run_report.hpp"
#include "measure/cycle_series.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace {

namespace fs = std::filesystem;

fs::path const& folder() {
    static vibrotrough::core::TemporaryFolder const made("vibrotrough-fuzz");
    return made.path();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
    using namespace vibrotrough;
    if (size == 0) return 0;
    // The first byte chooses the exit status, a zero byte separates what was printed from the table.
    std::string const text(reinterpret_cast<char const*>(data) + 1, size - 1);
    auto const gap = std::min(text.find('\0'), text.size());
    std::ofstream(folder() / engine::output_file, std::ios::binary) << text.substr(0, gap);
    std::ofstream(folder() / "cycles.csv", std::ios::binary) << text.substr(std::min(gap + 1, text.size()));
    engine::ExitStatus const status =
        data[0] < 128 ? engine::ExitStatus{data[0], 0} : engine::ExitStatus{0, data[0] & 31};
    for (auto const stage : {engine::Stage::settling, engine::Stage::driving}) {
        engine::RunReport const report = engine::examine_run(folder(), status, stage);
        if (report.failure && name_of(*report.failure).empty()) std::abort();
        if (core::harmless(report.message) != report.message) std::abort();
    }
    try {
        measure::read_cycles(folder() / "cycles.csv", 500, 60);
    } catch (core::Error const&) {
    }
    return 0;
}
