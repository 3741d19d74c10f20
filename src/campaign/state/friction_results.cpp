#include "campaign/state/friction_results.hpp"

#include "campaign/state/case_state.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::campaign {
namespace {

using core::note::Json;

evaluate::LayerFriction measure_one(PlannedCase const& planned) {
    if (auto const record = read_whole_result(planned))
        return evaluate::evaluate_friction_test(*planned.prepared, planned.id, *record, planned.folder);
    auto const failure = read_failure(planned);
    std::string const why =
        failure ? fmt::format("{}: {}", name_of(failure->outcome), failure->message) : "not finished";
    return evaluate::failed_friction_test(*planned.prepared, planned.id, why);
}

}  // namespace

std::vector<evaluate::LayerFriction> measure_friction(Plan const& plan) {
    std::vector<evaluate::LayerFriction> tests;
    for (PlannedCase const& planned : plan.cases) tests.push_back(measure_one(planned));
    return tests;
}

std::filesystem::path friction_file(std::filesystem::path const& campaign_folder) {
    return campaign_folder / "friction.json";
}

void write_friction(std::filesystem::path const& campaign_folder,
                    std::vector<evaluate::LayerFriction> const& tests) {
    Json list = Json::array();
    for (evaluate::LayerFriction const& test : tests) {
        list.push_back({{"layer", test.layer},
                        {"case", test.case_id},
                        {"grain_friction", test.grain_friction},
                        {"machine_number", test.machine_number},
                        {"max_relative_displacement", core::note::known_or_null(test.displacement)},
                        {"max_relative_displacement_half_width", core::note::known_or_null(test.half_width)},
                        {"creep_per_cycle", test.creep},
                        {"friction", core::note::known_or_null(test.friction)},
                        {"friction_low", core::note::known_or_null(test.low)},
                        {"friction_high", core::note::known_or_null(test.high)},
                        {"mode", test.mode},
                        {"message", test.message}});
    }
    core::write_file_atomically(friction_file(campaign_folder),
                                core::note::sealed({{"layers", std::move(list)}}));
}

std::map<std::string, evaluate::LayerFriction> read_friction(std::filesystem::path const& campaign_folder) {
    auto const path = friction_file(campaign_folder);
    if (!std::filesystem::is_regular_file(path)) return {};
    try {
        return parse_friction(core::read_file(path, core::largest_note));
    } catch (core::note::Fault const& fault) {
        throw core::InputError(
            fmt::format("{} is damaged; run 'vibrotrough friction-test' again or delete it ({})",
                        path.string(), fault.what()));
    }
}

}  // namespace vibrotrough::campaign
