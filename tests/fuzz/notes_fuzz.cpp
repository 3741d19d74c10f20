// Whatever lies in place of a note of JSON: it is believed or it has a fault, and what is believed is what it
// can be: finite numbers and counts that are not negative. Where the program writes the note, it is the same
// when it is written and read again.

#include "campaign/state/notes.hpp"
#include "core/note.hpp"
#include "evaluate/packing_files.hpp"
#include "learn/design_file.hpp"
#include "learn/notes.hpp"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

namespace {

using namespace vibrotrough;

void require(bool good) {
    if (!good) std::abort();
}

void require_number(std::optional<double> value, double least) {
    require(!value || (std::isfinite(*value) && *value >= least));
}

/// All numbers are finite.
void require_finite(core::note::Json const& json) {
    if (json.is_number()) require(std::isfinite(json.get<double>()));
    if (json.is_structured())
        for (auto const& value : json) require_finite(value);
}

/// What a reader believes; none when it names a fault. Any other error ends the process.
auto believed(auto const& read) -> std::optional<decltype(read())> {
    try {
        return read();
    } catch (core::note::Fault const& fault) {
        require(!std::string_view(fault.what()).empty());
        return {};
    }
}

void check_marker(std::string_view text) {
    evaluate::PackingFiles files;
    files.cycles_sha256 = "cycles";
    files.layer_sha256 = "layer";
    auto const marker = believed([&] { return evaluate::parse_marker(text, files); });
    if (!marker) return;
    require_number(marker->wall_time, 0);
    require_number(marker->core_time, 0);
    require_number(marker->start_efficiency, -INFINITY);
    std::string const written = to_json(files, *marker);
    require(to_json(files, evaluate::parse_marker(written, files)) == written);
}

void check_case(std::string_view text) {
    if (auto const failure = believed([&] { return campaign::parse_failure(text); })) {
        require(failure->packing >= 0 && failure->attempts >= 0 && !core::has_result(failure->outcome));
    }
    if (auto const seal = believed([&] { return campaign::parse_checkpoint(text); })) {
        require(seal->checkpoint.cycle >= 1);
        require_number(seal->checkpoint.wall_time, 0);
        require_number(seal->checkpoint.core_time, 0);
    }
    believed([&] { return campaign::parse_settled(text); });
}

void check_tasks(std::string_view text) {
    if (auto const batch = believed([&] { return campaign::parse_batch(text); })) {
        require(batch->job.value_or(1) > 0);
        require(batch->name.find_first_of(" '\"$`\\\n/") == std::string::npos);
    }
}

void check_campaign(std::string_view text) {
    if (auto const engine = believed([&] { return campaign::parse_engine(text); })) {
        std::string const written = to_json(*engine);
        require(to_json(campaign::parse_engine(written)) == written);
    }
    if (auto const tests = believed([&] { return campaign::parse_friction(text); })) {
        for (auto const& [layer, test] : *tests) {
            for (auto const& value : {test.friction, test.low, test.high, test.half_width})
                require_number(value, 0);
            require(*test.low <= *test.friction && *test.friction <= *test.high);
        }
    }
    if (auto const list = believed([&] { return campaign::parse_numerics(text); })) {
        for (auto const& one : *list) require_number(core::note::known_number(one, "numerical_error"), 0);
        list->dump();
    }
    if (auto const observables = believed([&] { return campaign::parse_observables(text); })) {
        for (auto const& one : *observables) {
            require(store::is_observable_name(one.name) && store::is_plain_unit(one.unit));
        }
        std::string const written = campaign::to_json(*observables);
        require(campaign::to_json(campaign::parse_observables(written)) == written);
    }
}

void check_learned(std::string_view text) {
    if (auto const wanted = believed([&] { return learn::parse_half_widths(text); })) {
        for (auto const& [id, half_width] : *wanted) require(std::isfinite(half_width) && half_width > 0);
    }
    if (auto const known = believed([&] { return learn::parse_calibration(text); })) {
        require(known->low <= known->median && known->median <= known->high);
        for (double const value : known->draws) require(std::isfinite(value));
        for (double const value : known->discrepancies) require(std::isfinite(value));
    }
    if (auto const page = believed([&] { return learn::proposed_machines(text); })) {
        require_finite(*page);
        require(!page->at("machines").empty());
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
    std::string_view const text(reinterpret_cast<char const*>(data), size);
    check_marker(text);
    check_case(text);
    check_tasks(text);
    check_campaign(text);
    check_learned(text);
    return 0;
}
