#include "compare/record_files.hpp"

#include "core/atomic_file.hpp"
#include "prepare/prepared_case.hpp"
#include "scenario/model/recorded_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>

namespace vibrotrough::compare {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr std::size_t most_samples = 20000;  ///< 1.5 MB

/// Position, or acceleration, along and normal to the trough.
std::array<double, 2> motion_at(scenario::DriveMotion const& motion, double frequency, double cycles,
                                bool is_acceleration) {
    auto const sum = [&](std::vector<scenario::DriveTerm> const& terms) {
        double value = 0;
        for (scenario::DriveTerm const& term : terms) {
            double const omega = 2 * std::numbers::pi * frequency * term.order;
            value += (is_acceleration ? -omega * omega : 1) * term.amplitude *
                     std::sin(2 * std::numbers::pi * term.order * cycles + term.phase);
        }
        return value;
    };
    return {sum(motion.along), sum(motion.normal)};
}

std::string samples_csv(scenario::RecordedMotion const& record, scenario::Trough const& trough) {
    scenario::DriveMotion const motion = drive_motion(trough);
    std::string text = "time_s,cycles,along,normal,left_out_along,left_out_normal,deck_along,deck_normal\n";
    for (std::size_t i = 0; i < std::min(record.time.size(), most_samples); ++i) {
        double const cycles = (record.time[i] - record.time.front()) * trough.waveform->frequency;
        text += fmt::format("{:.9g},{:.6f},{:.6g},{:.6g}", record.time[i], cycles, record.samples[0][i],
                            record.samples[1][i]);
        if (i < record.left_out[0].size()) {
            auto const [along, normal] =
                motion_at(motion, trough.waveform->frequency, cycles, record.is_acceleration);
            text += fmt::format(",{:.6g},{:.6g},{:.6g},{:.6g}\n", record.left_out[0][i],
                                record.left_out[1][i], along, normal);
        } else {
            text += ",,,,\n";
        }
    }
    return text;
}

std::string cycle_csv(scenario::Trough const& trough, bool is_acceleration) {
    constexpr int per_cycle = 720;
    std::string text = "cycles,along,normal\n";
    for (int i = 0; i <= per_cycle; ++i) {
        double const cycles = static_cast<double>(i) / per_cycle;
        auto const [along, normal] =
            motion_at(drive_motion(trough), trough.waveform->frequency, cycles, is_acceleration);
        text += fmt::format("{:.6g},{:.6g},{:.6g}\n", cycles, along, normal);
    }
    return text;
}

}  // namespace

Json write_records(std::vector<campaign::CaseOverview> const& cases, fs::path const& folder) {
    std::vector<scenario::Trough const*> known;
    Json records = Json::array();
    for (campaign::CaseOverview const& one : cases) {
        scenario::Trough const& trough = one.planned->prepared->scenario.trough;
        if (!trough.waveform) continue;
        auto const same = std::ranges::find_if(known, [&](scenario::Trough const* other) {
            return other->waveform == trough.waveform && other->waveform_order == trough.waveform_order;
        });
        auto const place = static_cast<std::size_t>(same - known.begin());
        if (same == known.end()) {
            known.push_back(&trough);
            scenario::RecordedMotion const record = recorded_motion(*trough.waveform);
            fs::path const path = folder / "records";
            core::make_folder(path);
            core::write_file_atomically(path / fmt::format("{}.csv", place + 1), samples_csv(record, trough));
            core::write_file_atomically(path / fmt::format("{}_cycle.csv", place + 1),
                                        cycle_csv(trough, record.is_acceleration));
            records.push_back({{"file", trough.waveform->file.name},
                               {"unit", record.is_acceleration ? "m/s2" : "m"},
                               {"remarks", trough.waveform->remarks},
                               {"samples", record.time.size()},
                               {"cases", Json::array()}});
        }
        records.at(place)["cases"].push_back(one.planned->id);
    }
    return records;
}

}  // namespace vibrotrough::compare
