#pragma once

#include "campaign/execute/campaign_driver.hpp"
#include "campaign/state/left_aside.hpp"
#include "core/parallel.hpp"
#include "scenario/reader/campaign_file.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace vibrotrough::app {

/// Says in one line on standard error what of a campaign's folder is not in what the command shows. Says
/// nothing when nothing is left aside.
void tell_left_aside(campaign::Plan const& plan, std::vector<campaign::CaseOverview> const& cases);

/// The case that --case names. @throws core::InputError when the campaign has none with this id
campaign::PlannedCase const& case_named(campaign::Plan const& plan, std::string const& id);

/// The options of every command that simulates a campaign.
struct RunOptions {
    std::string campaign_file;          ///< path
    std::string output;                 ///< folder of the results; empty for runs/NAME
    std::string engine;                 ///< path of the engine; empty for the one on the PATH
    std::string progress = "text";      ///< text, json or none
    bool quiet = false;                 ///< the same as none
    bool accept_failed_probes = false;  ///< run an engine that failed its probes
    bool accept_findings = false;       ///< run although the check found errors
    bool allow_setup = false;           ///< let the tasks of a cluster run the lines of the key setup
    bool allow_extra = false;           ///< let the decks be made from engine.templates
    std::string templates;              ///< folder of templates of the decks; empty for the program's own
    int jobs = core::count_available_cores();  ///< cores to use

    /// Declares the options of a command.
    void add_to(CLI::App& command);
    /// The observer that shows the progress as asked.
    std::unique_ptr<campaign::Observer> make_observer() const;
};

/// The options of a command that simulates a study of its own beside the results of a campaign.
struct StudyOptions {
    std::string output;                        ///< folder of the campaign's results; empty for runs/NAME
    std::string engine;                        ///< path of the engine; empty for the one on the PATH
    bool accept_failed_probes = false;         ///< run an engine that failed its probes
    bool allow_extra = false;                  ///< let the decks be made from engine.templates
    int jobs = core::count_available_cores();  ///< cores to use

    /// Declares the options of a command.
    void add_to(CLI::App& command);
};

/// The folder of a campaign's results. @param output  as given; empty for runs/NAME
std::filesystem::path results_folder(std::string const& output, std::string const& name);

/// The engine at a path, or the one on the PATH. @throws core::MissingError when there is none
engine::Engine engine_at(std::string const& path);

/// Simulates the campaign of a study on this machine until it is done.
/// @param file  of the campaign
campaign::Summary run_study(StudyOptions const& options, engine::Engine const& engine, campaign::Plan& plan,
                            std::filesystem::path const& file, scenario::RunSettings const& settings = {});

/// A campaign that is ready to be run.
struct ReadyCampaign {
    scenario::Campaign campaign;         ///< as its file says
    campaign::Plan plan;                 ///< its cases
    campaign::ExecutorKind const* kind;  ///< that it asks for
    campaign::ExecutorInputs inputs;     ///< of the executor
    bool is_interrupted;                 ///< by a signal, while the engine was tested
};

/// Reads and checks a campaign, finds and tests the engine, and makes the plan in the folder of the results.
/// @throws core::InputError when the campaign is wrong, core::MissingError when there is no usable engine,
/// the disk refuses, or another process drives the campaign
ReadyCampaign prepare_run(RunOptions const& options);

/// Simulates the cases of a campaign, shows the progress as asked, logs it, and writes campaign.h5.
campaign::Summary drive_campaign(RunOptions const& options, ReadyCampaign& ready,
                                 campaign::Policy const& policy, campaign::Until until,
                                 campaign::ExecutorKind const& kind);

/// Makes the tasks of a cluster take several packings each, so that a task lasts about `minutes`; the
/// duration of a packing comes from the campaign's forecast. Nothing: one packing per task.
void size_tasks(ReadyCampaign& ready, std::optional<int> minutes);

}  // namespace vibrotrough::app
