#include "app/commands.hpp"
#include "app/exit_code.hpp"
#include "app/point_mass.hpp"
#include "campaign/execute/executors.hpp"
#include "campaign/state/campaign_folder.hpp"
#include "compare/compared_cases.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/shell.hpp"
#include "view/frames.hpp"
#include "view/table_vtk.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

namespace vibrotrough::app {
namespace {

namespace fs = std::filesystem;

struct Options {
    std::string folder;
    std::string id;
    bool table = false;
};

/// Writes the campaign's table for ParaView and returns its path.
fs::path export_table(campaign::Plan const& plan) {
    fs::path const path = plan.folder / "view" / "campaign.vtt";
    core::make_folder(path.parent_path());
    view::write_table(path, compare::compared_cases(plan, campaign::activity_in(plan.folder)).rows);
    return fs::absolute(path).lexically_normal();
}

void print_table(campaign::Plan const& plan) {
    fmt::print("table of all cases: open with: paraview {}\n", core::shell_word(export_table(plan)));
}

/// Exports the frames that a case's first packing has written so far; nothing when it has none.
std::optional<view::ExportedFrames> export_case(campaign::PlannedCase const& planned) {
    fs::path const packing = planned.packing_folder(1);
    if (planned.scenario().output.frames_per_cycle == 0 || !fs::exists(packing / "dump" / "frames.csv"))
        return {};
    scenario::Trough const& trough = planned.scenario().trough;
    view::FrameSource const source{
        .folder = packing / "dump",
        .trough = packing / "trough.stl",
        .time_step = planned.prepared->time.time_step,
        .angular_frequency = planned.prepared->angular_frequency,
        .drive = planned.prepared->motion,
        .width = planned.scenario().layer.width,
        .point_mass = point_mass_beside(*planned.prepared),
        .caption = fmt::format("{}, case {}: throw number {:.4g}, machine number {:.4g}, friction {:.3g}",
                               planned.scenario().campaign, planned.id, planned.prepared->throw_number,
                               planned.prepared->machine_number, trough.friction)};
    bool const terminal = ::isatty(STDERR_FILENO) == 1;
    auto exported = view::export_frames(source, planned.folder / "frames", [&](int written, int all) {
        if (terminal) fmt::print(stderr, "\r{}: {} of {} frames\x1b[K", planned.id, written, all);
    });
    if (terminal) fmt::print(stderr, "\r\x1b[K");
    return exported;
}

int run(Options const& options) {
    campaign::Plan const plan = campaign::open_plan(options.folder);
    if (options.table) {
        print_table(plan);
        return all_well;
    }
    bool known = options.id.empty();
    int exported = 0;
    for (campaign::PlannedCase const& planned : plan.cases) {
        if (!options.id.empty() && planned.id != options.id) continue;
        known = true;
        auto const frames = export_case(planned);
        if (!frames) continue;
        ++exported;
        fmt::print(
            "case {}: {} frames; open with: sh {}\n", planned.id, frames->frames,
            core::shell_word(fs::absolute(frames->scene).lexically_normal().parent_path() / "view.sh"));
    }
    if (!known) {
        throw core::InputError(fmt::format("--case: {} has no case {}; 'vibrotrough status {}' lists them",
                                           options.folder, options.id, options.folder));
    }
    bool const asked_for = std::ranges::any_of(
        plan.cases, [](auto const& planned) { return planned.scenario().output.frames_per_cycle > 0; });
    if (exported == 0 && asked_for) {
        throw core::InputError(
            fmt::format("{} holds no frames yet; wait until its first cases run", options.folder));
    }
    if (exported == 0) {
        throw core::InputError(fmt::format(
            "{} holds no frames; write frames_per_cycle = 20 under [output] in the campaign file and "
            "run it again",
            options.folder));
    }
    if (options.id.empty()) print_table(plan);
    return all_well;
}

}  // namespace

void add_export(CLI::App& program, int& exit_code) {
    auto const options = std::make_shared<Options>();
    CLI::App* const command =
        program.add_subcommand("export", "Write a campaign's frames for ParaView (.pvd and .vtp)");
    command->add_option("DIR", options->folder, "The campaign's folder, as given to run --output")
        ->required();
    command->add_option("--case", options->id, "Only this case; default: all that have frames")
        ->type_name("ID");
    command->add_flag("--table", options->table,
                      "Only the table of all cases (view/campaign.vtt), no frames");
    command->footer(
        "Frames come from the first packing of each case when the campaign asks for them: [output] "
        "frames_per_cycle.\n"
        "The grains, the trough, the theory's point mass as a block that moves in step, and the layer's "
        "profile each are a\n"
        ".pvd; view.sh opens all of them. Without --case the campaign's table is written, too. Works while a "
        "case runs.\n"
        "Exit codes: 0 all well; 2 the input is wrong or there is no frame; 3 something is missing (disk).\n"
        "Example: vibrotrough export runs/demo");
    command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace vibrotrough::app
