#include "situations/campaign_on_disk.hpp"

#include "archive/bundle.hpp"
#include "campaign/execute/executors.hpp"
#include "campaign/schedule/forecast.hpp"
#include "campaign/state/campaign_folder.hpp"
#include "campaign/state/case_state.hpp"
#include "campaign/state/checkpoint.hpp"
#include "campaign/state/left_aside.hpp"
#include "compare/compared_cases.hpp"
#include "compare/exports.hpp"
#include "compare/report_data.hpp"
#include "compare/table.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "deck/deck.hpp"
#include "engine/run_report.hpp"
#include "scenario/example_campaign.hpp"
#include "store/result_file.hpp"
#include "store/sample_record.hpp"

#include <algorithm>
#include <fstream>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>
#include <unistd.h>

namespace vibrotrough::situations {
namespace {

namespace fs = std::filesystem;

void write(fs::path const& path, std::string const& bytes) {
    fs::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

Efficiencies efficiencies_of(compare::ComparedCases const& compared) {
    Efficiencies found;
    for (compare::Row const& row : compared.rows) {
        auto const object = compare::to_object(row, compared.columns);
        auto const& value = object.at("efficiency");
        found[object.at("case")] = value.is_null() ? std::nullopt : std::optional(value.get<double>());
    }
    return found;
}

/// What a run would leave beside results.
void write_other_files(fs::path const& folder, campaign::PlannedCase const& planned) {
    fs::path const packing = planned.packing_folder(1), batch = folder / "slurm" / "0001";
    for (auto const& [name, content] : deck::make_deck(*planned.prepared, {1}).files)
        write(packing / name, content);
    write(packing / "cycles.csv",
          "# SI units\nstep,grains,x_com,z_com,vz_com,mean_vx,mean_force_x,mean_force_z,flight_fraction\n"
          "0,10,0.018,0.01,0,0,0,0,0\n7200,10,0.019,0.01,0,0.1,0.01,-0.09,0.5\n");
    write(packing / "engine.out",
          "LIGGGHTS (Version x)\nVIBROTROUGH BEGIN cycle 0\nVIBROTROUGH DONE step 7200\n");
    write(packing / "packing.json", R"({"wall_time": 1, "core_time": 1, "started": "2026", "finished": "2026",
        "program_version": "0", "git_commit": "0", "host": "here", "engine_certificate": "",
        "cycles_sha256": "0", "layer_sha256": "0"})");
    write(packing / "checkpoint.json", R"({"cycle": 1, "file": "checkpoint.1.restart", "restart_sha256": "0",
        "commands_sha256": "0", "started": "2026", "wall_time": 1, "core_time": 1})");
    write(packing / "checkpoints.txt", "1\n");
    write(batch / "batch.json", R"({"name": "x", "job": 1})");
    write(batch / "tasks.txt", planned.id + " 1\n");
    write(batch / "task-0.lost", R"({"outcome": "interrupted", "message": "the node died"})");
    write(planned.folder.parent_path() / planned.id / "failure.json",
          R"({"outcome": "engine-error", "message": "it fell", "packing": 1, "attempts": 1})");
    write(folder / "friction.json",
          R"([{"layer": "x", "case": "y", "grain_friction": 0.5, "machine_number": 1,
        "max_relative_displacement": 1, "max_relative_displacement_half_width": 0.1, "creep_per_cycle": 0,
        "friction": 0.2, "friction_low": 0.1, "friction_high": 0.3, "mode": "PN", "message": ""}])");
    write(folder / "numerics.json",
          R"({"format": "vibrotrough numerics", "schema_version": 1, "cases": []})");
    write(folder / "observables.json",
          R"({"format": "vibrotrough observables", "schema_version": 1, "observables": []})");
}

/// Readers that no table needs.
void ask_readers(campaign::Plan const& plan) {
    for (campaign::PlannedCase const& planned : plan.cases) {
        campaign::read_known_packings(planned);
        campaign::last_checkpoint(planned.packing_folder(1));
        engine::examine_run(planned.packing_folder(1), {0, 0}, engine::Stage::driving);
    }
}

/// A number of a damaged result, or a result that is missing without a word.
std::string fault_of(CampaignOnDisk const& campaign, campaign::Plan const& plan,
                     compare::ComparedCases const& compared) {
    std::size_t shown = 0, known = 0;
    for (auto const& [id, value] : efficiencies_of(compared)) {
        auto const true_value = campaign.truth().find(id);
        shown += value ? 1U : 0U;
        if (value && (true_value == campaign.truth().end() || *value != true_value->second))
            return fmt::format("case {} has the efficiency {}", id, *value);
    }
    for (auto const& [id, value] : campaign.truth()) known += value ? 1U : 0U;
    std::string const left = describe(campaign::find_left_aside(plan, compared.cases), plan);
    if (shown < known && left.empty()) return fmt::format("{} of {} results in silence", shown, known);
    std::string const said = core::harmless(left) + compare::to_table(compared.rows, {}, compared.columns);
    if (left.find('\n') != left.npos) return "a sentence of several lines";
    return std::ranges::any_of(said, [](unsigned char c) { return c < ' ' && c != '\n'; })
               ? "a control character"
               : "";
}

}  // namespace

CampaignOnDisk::CampaignOnDisk() {
    fs::path const file = own_.path() / "campaign.toml";
    write(file, example_campaign + "\n[sweep]\n\"grains.friction\" = [0.4, 0.5]\n");
    campaign::Plan plan = campaign::make_plan(scenario::read_campaign(file), folder_, "LIGGGHTS 3.8.0");
    plan.own = (core::make_folder(folder_), std::make_shared<core::OwnFolder const>(folder_));
    campaign::freeze(plan, file, {"/usr/bin/liggghts", "LIGGGHTS 3.8.0", 1, R"({"format": "x"})"});
    write_other_files(folder_, plan.cases.front());
    double efficiency = 0.5;
    for (campaign::PlannedCase const& planned : plan.cases) {
        campaign::write_case_files(planned);
        store::CaseRecord record = store::sample_record(planned.id);
        record.estimate.mean = efficiency += 0.125;
        store::write_result(planned.result_file(), record);
    }
    campaign::write_campaign_file(plan);  // and the summaries
    for (auto const& entry : fs::recursive_directory_iterator(folder_)) {
        if (!entry.is_regular_file()) continue;
        std::string const name = entry.path().lexically_relative(folder_).string();
        names_.push_back(name);
        contents_[name] = core::read_file(entry.path());
    }
    std::ranges::sort(names_);
    truth_ = efficiencies_of(compare::compared_cases(plan, {}));
}

void CampaignOnDisk::rot(std::string const& name, std::string const& bytes) const {
    fs::path const path = folder_ / name;
    struct stat status {};
    ::stat(path.c_str(), &status);
    std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
    timespec const times[2]{status.st_atim, status.st_mtim};
    ::utimensat(AT_FDCWD, path.c_str(), times, 0);
}

void CampaignOnDisk::remove(std::string const& name) const {
    fs::remove_all(folder_ / name);
}

void CampaignOnDisk::restore(std::vector<std::string> const& names) const {
    for (std::string const& name : names) {
        std::error_code missing;
        bool const is_file = fs::symlink_status(folder_ / name, missing).type() == fs::file_type::regular;
        if (!is_file) remove(name);
        is_file ? rot(name, contents_.at(name)) : write(folder_ / name, contents_.at(name));
    }
}

Answer ask(CampaignOnDisk const& campaign, Depth depth, fs::path const& scratch) {
    try {
        campaign::Plan const plan = campaign::open_plan(campaign.folder());
        auto const activity = campaign::activity_in(plan.folder);
        auto const cases = campaign::survey(plan, activity, {}, campaign::Trust::stamp);
        campaign::forecast(cases);
        ask_readers(plan);
        compare::ComparedCases const compared = compare::compared_cases(plan, activity);
        compare::to_csv(compared.rows, compared.columns);
        if (!nlohmann::json::accept(compare::to_json(compared.rows, compared.columns))) return {"no JSON"};
        if (std::string fault = fault_of(campaign, plan, compared); !fault.empty()) return {fault};
        if (depth == Depth::shown) return {};
        if (campaign::is_campaign_file_outdated(plan)) campaign::write_campaign_file(plan);
        compare::write_report_data(plan, activity, scratch / "data");
        archive::write_bundle(plan, activity, scratch / "bundle.zip", {{}, {}, true});
    } catch (core::Error const& error) {
        // Several mistakes of a file are a line each.
        for (std::string const& said : error.problems())
            if (said.empty() || said.find('\n') != said.npos)
                return {"an error that is not one line: " + said};
    } catch (std::system_error const& error) {
        // main() adds what to do. Its text may not be several lines either.
        if (std::string(error.what()).find('\n') != std::string::npos) return {error.what()};
    } catch (std::exception const& error) {
        return {fmt::format("an internal error: {}", error.what())};
    }
    return {};
}

}  // namespace vibrotrough::situations
