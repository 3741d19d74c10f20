#include "theory/map.hpp"

#include "app/commands/command.hpp"
#include "app/commands/theory/options.hpp"
#include "app/outputs.hpp"
#include "store/theory_map.hpp"
#include "view/theory_map_vtk.hpp"
#include "view/vtk.hpp"

namespace vibrotrough::app {
namespace {

struct TheoryMapArguments {
    TheoryOptions motion;
    RollingOption rolling;
    QuantityOptions counts;
    Text x, y, output;
    Outputs outputs;
};

char const* const axis_example = "throw_number=0.3:3.3:500";

std::string input_names() {
    std::string names;
    for (std::size_t i = 0; i < theory::input_count; ++i) {
        names += (i > 0 ? ", " : "") + std::string(theory::name_of(static_cast<theory::Input>(i)));
    }
    return names;
}

/// "throw_number=0.3:3.3:500"
theory::MapAxis read_axis(std::string const& option, std::string const& text) {
    auto const equals = text.find('='), first = text.find(':'), second = text.rfind(':');
    if (equals == std::string::npos || first == std::string::npos || first == second || first < equals) {
        throw core::InputError(fmt::format("{} {}: needs NAME=FROM:TO:COUNT; write for example {} {}", option,
                                           text, option, axis_example));
    }
    auto const name = text.substr(0, equals);
    auto const input = theory::input_named(name);
    if (!input) {
        throw core::InputError(
            fmt::format("{} {}: '{}' is not an input; write one of {}", option, text, name, input_names()));
    }
    theory::MapAxis axis{*input, 0, 0, 0};
    axis.from = read_number(option, text.substr(equals + 1, first - equals - 1), axis_example);
    axis.to = read_number(option, text.substr(first + 1, second - first - 1), axis_example);
    axis.count = read_count(option, text.substr(second + 1), axis_example, 1, 20000);
    return axis;
}

void refuse_given_axis(theory::Inputs const& fixed, theory::MapAxis const& axis) {
    if (!fixed.get(axis.input)) return;
    std::string const name(theory::name_of(axis.input));
    throw core::InputError(fmt::format("{} is both an axis and an option; leave the option out", name));
}

/// Names the files that were written, and says it when those for ParaView were not.
void print_written(std::filesystem::path const& output, std::filesystem::path const& image,
                   std::filesystem::path const& lines) {
    fmt::print("written: {}\n", output.string());
    if (view::has_vtk()) {
        fmt::print("         {}\n         {}\n", image.string(), lines.string());
    } else {
        tell(
            "warning: {} and {} for ParaView are not written, because this program was built without VTK; "
            "run "
            "this command with a program that was built with VTK (cmake -DVIBROTROUGH_VIEW=ON)\n",
            image.string(), lines.string());
    }
}

void run_theory_map(TheoryMapArguments const& options) {
    theory::MapAxis const x = read_axis("--x", required("--x", options.x, axis_example));
    theory::MapAxis const y = read_axis("--y", required("--y", options.y, "vibration_angle_deg=5:60:500"));
    std::filesystem::path const output = required("--output", options.output, "map.h5");
    if (output.extension() != ".h5") {
        throw core::InputError(
            fmt::format("--output {}: must end in .h5; write for example --output map.h5", output.string()));
    }
    int const jobs = static_cast<int>(options.counts.value("--jobs").value_or(0));
    theory::Inputs const fixed = options.motion.given();
    options.motion.tell_unusual();
    refuse_given_axis(fixed, x);
    refuse_given_axis(fixed, y);
    theory::Inputs complete = fixed;
    complete.set(x.input, x.from);
    complete.set(y.input, y.from);
    require_complete(complete);
    auto const law = options.rolling.law();
    int const starts = count_starts(options.counts, law.has_value());
    auto const stem = output.parent_path() / output.stem();
    std::filesystem::path const image = stem.string() + ".vti", lines = stem.string() + "_modes.vtp";
    options.outputs.check("--output", output, "vibrotrough theory map");
    if (view::has_vtk())
        for (auto const& file : {image, lines})
            options.outputs.check("--output", file, view::theory_map_mark);
    theory::Map map;
    // Compressing the image takes as long as finding the lines.
    auto const write_image = [&](theory::Map const& points) {
        if (view::has_vtk()) view::write_theory_image(image, points);
    };
    try {
        // The image of a rolling layer is written when what was not tested has been removed from it.
        map = law ? theory::solve_map(fixed, x, y, {.jobs = jobs, .rolling = law})
                  : theory::solve_map(fixed, x, y,
                                      {.jobs = jobs, .starts = starts, .with_points = write_image});
    } catch (std::invalid_argument const& error) {
        throw core::InputError(
            fmt::format("the map leaves the range of the theory: {}; write other axes", error.what()));
    }
    if (law) {
        if (!options.rolling.accepts_untested())
            tell_withheld(theory::withhold_untested(fixed, map), map.points.size());
        write_image(map);
    }
    store::write_theory_map(output, map, fixed);
    if (view::has_vtk()) view::write_theory_boundaries(lines, map);
    fmt::print("{} points, {} modes, {} pieces of lines between modes\n", map.points.size(),
               theory::count_modes(map), map.boundaries.size());
    fmt::print("{:.3f} microseconds of CPU per solution\n", 1e6 * map.cpu_seconds_per_solution);
    print_written(output, image, lines);
}

}  // namespace

void add_theory_map(CLI::App& theory, int& exit_code) {
    CLI::App* const command = theory.add_subcommand(
        "map",
        "Solve a grid over any two inputs, with the exact lines between modes, as HDF5 and for ParaView");
    auto const options = std::make_shared<TheoryMapArguments>();
    command->add_option("--x", options->x,
                        "First axis, NAME=FROM:TO:COUNT, where NAME is one of: " + input_names());
    command->add_option("--y", options->y, "Second axis, written in the same way");
    command->add_option("--output", options->output,
                        "HDF5 file to write; the .vti and .vtp files for ParaView get the same name");
    options->outputs.add_to(*command);
    options->motion.add_to(*command);
    options->rolling.add_to(*command);
    options->counts.add_to(*command, {{"--jobs"}, {"--starts"}});
    command->footer(
        view::vtk_help() +
        std::string(
            R"(Writes the velocity efficiency and the mode at each point of the grid, and the lines between modes. The
inputs that are not axes are given as options. With --starts it also writes how many motions there are at each
point, the fraction of starts that lead to that of the standard start, and the lowest and highest efficiency.

)") + mode_letters +
        R"(

Example:
  vibrotrough theory map --x throw_number=0.3:3.3:500 --y vibration_angle_deg=5:60:500 \
      --friction 0.35 --tan-inclination -0.1 --output map.h5
  python3 -m vibrotrough.figures.theory_map map.h5)");
    command->callback([options, &exit_code] {
        run_theory_map(*options);
        exit_code = all_well;
    });
}

}  // namespace vibrotrough::app
