#include "app/campaign_run.hpp"
#include "app/commands/command.hpp"
#include "campaign/execute/executors.hpp"
#include "campaign/state/campaign_folder.hpp"
#include "compare/compared_cases.hpp"
#include "compare/point_mass_csv.hpp"
#include "deck/atom_types.hpp"
#include "deck/trough_mesh.hpp"
#include "scenario/model/stage_motion.hpp"
#include "view/frames.hpp"
#include "view/scene.hpp"
#include "view/vtk.hpp"

#include <unistd.h>

namespace vibrotrough::app {
namespace {

struct ExportArguments {
    std::string folder;
    std::string id;
    std::string colour = "velocity";
};

/// The theory's point mass beside the grains; none when its motion has no period.
std::optional<view::TheoryMotion> theory_motion(prepare::PreparedCase const& prepared) {
    auto found = compare::point_mass_motion(prepared);
    if (!found) return {};
    compare::PointMassScale const& scale = found->scale;
    return view::TheoryMotion{std::move(found->motion), scale.length_x, scale.length_z, scale.phase_at_start};
}

/// The types of a mixture's materials; none of other layers.
std::vector<std::pair<int, std::string>> materials_of(prepare::PreparedCase const& prepared) {
    std::vector<std::pair<int, std::string>> list;
    for (std::size_t i = 0; prepared.materials.size() > 1 && i < prepared.materials.size(); ++i)
        list.emplace_back(deck::atom_type_of(prepared, static_cast<int>(i)), prepared.materials[i].name);
    return list;
}

/// The meshes of its walls that move with the trough.
std::vector<fs::path> walls_in(fs::path const& packing) {
    std::vector<fs::path> found;
    for (std::string const name : deck::wall_files)
        if (fs::exists(packing / name)) found.push_back(packing / name);
    return found;
}

/// The meshes of the trough without its walls.
std::vector<fs::path> trough_in(fs::path const& packing, prepare::PreparedCase const& prepared) {
    std::vector<fs::path> meshes{packing / "trough.stl"};
    for (std::size_t i = 0; i < prepared.domain.parts.size(); ++i)
        meshes.push_back(packing / deck::part_file(i));
    return meshes;
}

/// What the scene says of the drive: its stages, or its numbers.
std::string drive_caption(prepare::PreparedCase const& prepared) {
    if (!prepared.stages.empty()) return fmt::format("a drive in {} stages", prepared.stages.size());
    return fmt::format("throw number {:.4g}, machine number {:.4g}", prepared.throw_number,
                       prepared.machine_number);
}

/// "case ID (layer.height 6 mm)", and from the second packing on its number.
std::string title(campaign::PlannedCase const& planned, int packing) {
    std::string const swept = planned.label.empty() ? "" : fmt::format(" ({})", planned.label);
    return fmt::format("case {}{}{}", planned.id, swept,
                       packing == 1 ? "" : fmt::format(", packing {}", packing));
}

/// Exports the frames that a packing of a case has written so far. None when there are no frames.
std::optional<view::ExportedFrames> export_packing(campaign::PlannedCase const& planned, int number,
                                                   view::Colour colour) {
    fs::path const packing = planned.packing_folder(number);
    if (!writes_frames(planned.scenario().output, number) || !fs::exists(packing / "dump" / "frames.csv"))
        return {};
    scenario::Trough const& trough = planned.scenario().trough;
    view::FrameSource const source{
        .folder = packing / "dump",
        .trough = trough_in(packing, *planned.prepared),
        .walls = walls_in(packing),
        .time_step = planned.prepared->time.time_step,
        .angular_frequency = planned.prepared->angular_frequency,
        .drive = planned.prepared->motion,
        .width = planned.scenario().layer.width,
        .point_mass = theory_motion(*planned.prepared),
        .caption = fmt::format("{}, {}: {}, friction {:.3g}", planned.scenario().campaign,
                               title(planned, number), drive_caption(*planned.prepared), trough.friction),
        .colour = colour,
        .parts = drive_parts(planned.prepared->stages),
        .steps_per_cycle = planned.prepared->time.steps_per_cycle,
        .materials = materials_of(*planned.prepared)};
    bool const terminal = ::isatty(STDERR_FILENO) == 1;
    fs::path const target = planned.folder / (number == 1 ? "frames" : fmt::format("frames-{}", number));
    auto exported = view::export_frames(source, target, [&](int written, int all) {
        if (!terminal) return;
        tell_text("\r\x1b[K");
        tell("{}: {} of {} frames", title(planned, number), written, all);
    });
    if (terminal) tell_text("\r\x1b[K");
    return exported;
}

/// Exports the frames of all packings of a case, prints a line for each, and returns how many there were.
int export_case(campaign::PlannedCase const& planned, view::Colour colour) {
    int exported = 0;
    for (int packing = 1; packing <= planned.scenario().measure.max_packings; ++packing) {
        auto const frames = export_packing(planned, packing, colour);
        if (!frames) continue;
        ++exported;
        fmt::print(
            "{}: {} frames; open with: sh {}\n", title(planned, packing), frames->frames,
            core::shell_word(fs::absolute(frames->scene).lexically_normal().parent_path() / "view.sh"));
    }
    return exported;
}

int run_export(ExportArguments const& options) {
    view::require_vtk();
    campaign::Plan const plan = campaign::open_plan(options.folder);
    view::Colour const colour = view::colour_named(options.colour);
    int exported = 0;
    if (!options.id.empty()) {
        exported = export_case(case_named(plan, options.id), colour);
    } else {
        for (campaign::PlannedCase const& planned : plan.cases) exported += export_case(planned, colour);
    }
    bool const wanted = std::ranges::any_of(
        plan.cases, [](auto const& planned) { return planned.scenario().output.frames_per_cycle > 0; });
    if (exported == 0 && wanted) {
        throw core::InputError(
            fmt::format("{} holds no frames yet; wait until the first cases run", options.folder));
    }
    if (exported == 0) {
        throw core::InputError(fmt::format(
            "{} holds no frames; write frames_per_cycle = 20 under [output] in the campaign file, and run it "
            "again",
            options.folder));
    }
    return all_well;
}

}  // namespace

void add_export(CLI::App& program, int& exit_code) {
    auto const options = std::make_shared<ExportArguments>();
    CLI::App* const command = program.add_subcommand(
        "export", std::string("Write the frames of a campaign for ParaView") +
                      (view::has_vtk() ? "" : " (not in this program, which was built without VTK)"));
    add_campaign_folder(*command, options->folder);
    add_text(*command, "--case", options->id, "Only this case; default: all cases with frames", "ID");
    command
        ->add_option("--colour", options->colour,
                     "What the scene colours the grains by: velocity (along the trough, less the layer's "
                     "mean), spin (across the trough), height, trough (velocity relative to it), size, or "
                     "material (of a mixture); default: velocity")
        ->check(CLI::IsMember({"velocity", "spin", "height", "trough", "size", "material"}))
        ->type_name("NAME");
    command->footer(
        view::vtk_help() +
        R"(Frames are snapshots of the grains. They are written while the first packing of each case is
simulated if the campaign file asks for them with frames_per_cycle under [output], or while those packings are that
frame_packings names. Those of the first packing are exported into the folder 'frames' of the case, those of packing 2
into 'frames-2'.

With contacts = true under [output], contacts.pvd holds the contacts of the grains with their forces.

Four .pvd files are written for each case: the grains, the trough, the theory's point mass (a block that moves in step
with the grains), and the velocity profile of the layer; with walls a fifth. The script view.sh beside them opens them
all. Prints the commands that open the files. Works while a case runs. The table of all cases can be opened in ParaView as
'vibrotrough compare --csv' writes it.

Example:
  vibrotrough export runs/demo)");
    command->callback([options, &exit_code] { exit_code = run_export(*options); });
}

}  // namespace vibrotrough::app
