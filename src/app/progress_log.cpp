#include "app/progress_log.hpp"

#include "app/standard_streams.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "core/time.hpp"
#include "core/version.hpp"

#include <cmath>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace vibrotrough::app {
namespace {

using Json = nlohmann::ordered_json;

/// A number, or null when it is not known.
Json known(double value) {
    return value >= 0 ? Json(value) : Json();
}

/// Its id and what distinguishes it.
std::string described(campaign::PlannedCase const& planned) {
    return planned.label.empty() ? planned.id : fmt::format("{} ({})", planned.id, planned.label);
}

Json as_json(campaign::RunningPacking const& one) {
    Json json{{"case", one.planned->id},
              {"label", one.planned->label},
              {"packing", one.packing},
              {"cycles", one.cycles},
              {"cycles_wanted", one.cycles_wanted},
              {"efficiency", nullptr},
              {"efficiency_half_width_statistics", nullptr},
              {"elapsed_s", one.elapsed},
              {"time_to_go_s", known(one.time_to_go)}};
    if (one.estimate && std::isfinite(one.estimate->mean)) {
        json["efficiency"] = one.estimate->mean;
        if (std::isfinite(one.estimate->half_width))
            json["efficiency_half_width_statistics"] = one.estimate->half_width;
    }
    return json;
}

}  // namespace

void JsonProgress::progressed(campaign::Progress const& progress) {
    bool const is_last = progress.left == 0 && progress.running == 0;
    if (!is_last && shown_ >= 0 && progress.elapsed - shown_ < 1) return;
    shown_ = progress.elapsed;
    Json engines = Json::array();
    for (auto const& one : progress.engines) engines.push_back(as_json(one));
    Json const json{{"event", "progress"},
                    {"time", core::utc_now()},
                    {"finished", progress.finished},
                    {"failed", progress.failed},
                    {"running", progress.running},
                    {"left", progress.left},
                    {"packings_done", progress.packings_done},
                    {"packings", progress.packings},
                    {"elapsed_s", progress.elapsed},
                    {"time_to_go_s", known(progress.time_to_go)},
                    {"core_time_s", progress.core_time},
                    {"core_time_to_go_s", known(progress.core_time_to_go)},
                    {"engines", engines}};
    tell("{}\n", json.dump());
}

void JsonProgress::case_ended(campaign::PlannedCase const& planned, core::Outcome outcome,
                              std::string const& message) {
    Json const json{{"event", "case_ended"},  {"time", core::utc_now()},     {"case", planned.id},
                    {"label", planned.label}, {"outcome", name_of(outcome)}, {"message", message}};
    tell("{}\n", json.dump(-1, ' ', true, Json::error_handler_t::replace));
}

void JsonProgress::noticed(campaign::PlannedCase const& planned, std::string const& message) {
    Json const json{
        {"event", "noticed"}, {"time", core::utc_now()}, {"case", planned.id}, {"message", message}};
    tell("{}\n", json.dump(-1, ' ', true, Json::error_handler_t::replace));
}

void CampaignLog::add(char const* level, std::string const& line) const {
    std::ofstream(file_, std::ios::app)
        << core::utc_now() << ' ' << level << ' ' << core::harmless(line) << '\n';
}

void CampaignLog::info(std::string const& line) const {
    add("info", line);
}

void CampaignLog::warn(std::string const& line) const {
    add("warning", line);
}

LoggingObserver::LoggingObserver(campaign::Observer& next, std::filesystem::path folder)
    : next_(next), folder_(std::move(folder)) {}

CampaignLog const& LoggingObserver::log() {
    if (!log_) {
        log_ = std::make_unique<CampaignLog>(folder_);
        log_->info(fmt::format("run starts: vibrotrough {} ({}) on {}, process {}", core::program_version(),
                               core::program_commit(), core::host_name(), ::getpid()));
    }
    return *log_;
}

void LoggingObserver::progressed(campaign::Progress const& progress) {
    log();
    next_.progressed(progress);
}

void LoggingObserver::noticed(campaign::PlannedCase const& planned, std::string const& message) {
    log().warn(fmt::format("case {}: {}", described(planned), message));
    next_.noticed(planned, message);
}

void LoggingObserver::stopping() {
    log().info("a signal asks for a stop");
    next_.stopping();
}

void LoggingObserver::case_ended(campaign::PlannedCase const& planned, core::Outcome outcome,
                                 std::string const& message) {
    if (message.empty()) {
        log().info(fmt::format("case {}: {}", described(planned), name_of(outcome)));
    } else {
        log().warn(fmt::format("case {}: {}: {}", described(planned), name_of(outcome), message));
    }
    next_.case_ended(planned, outcome, message);
}

}  // namespace vibrotrough::app
