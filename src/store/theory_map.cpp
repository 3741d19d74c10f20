#include "store/theory_map.hpp"

#include "core/version.hpp"
#include "store/hdf5_file.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace vibrotrough::store {
namespace {

constexpr int schema_version = 2;

/// Numbers for the modes that occur, in order of appearance; 0 stands for "none".
class ModeIndex {
  public:
    int operator()(theory::ModeCode code) {
        auto const [place, fresh] = index_.try_emplace(code, static_cast<int>(names_.size()));
        if (fresh) names_.push_back(theory::to_string(code));
        return place->second;
    }
    std::vector<std::string> const& names() const { return names_; }

  private:
    std::map<theory::ModeCode, int> index_{{0, 0}};
    std::vector<std::string> names_{"none"};
};

void write_header(Hdf5Writer& file, std::string const& format) {
    file.attribute("format", format);
    file.attribute("schema_version", schema_version);
    file.attribute("program_version", std::string(core::program_version()));
    file.attribute("git_commit", std::string(core::program_commit()));
}

void write_axis(Hdf5Writer& file, std::string const& name, theory::MapAxis const& axis) {
    std::vector<double> values;
    for (int i = 0; i < axis.count; ++i) values.push_back(axis.value(i));
    file.attribute(name + "_name", std::string(theory::name_of(axis.input)));
    file.dataset(name, values, units_of(axis.input), "Values of the input named by @" + name + "_name");
}

void write_boundaries(Hdf5Writer& file, theory::Map const& map, ModeIndex& modes) {
    std::vector<double> x0, y0, x1, y1;
    std::vector<int> a, b;
    for (theory::BoundaryPiece const& piece : map.boundaries) {
        x0.push_back(piece.x0);
        y0.push_back(piece.y0);
        x1.push_back(piece.x1);
        y1.push_back(piece.y1);
        a.push_back(modes(piece.mode_a));
        b.push_back(modes(piece.mode_b));
    }
    std::string const x_units = units_of(map.x.input), y_units = units_of(map.y.input);
    auto const write = [&](char const* name, Values const& values, std::string const& units,
                           char const* meaning) {
        file.dataset(std::string("boundaries/") + name, values, units, meaning);
    };
    write("x0", x0, x_units, "Begin of a piece of the line between two modes, x");
    write("y0", y0, y_units, "Begin of a piece of the line between two modes, y");
    write("x1", x1, x_units, "End of a piece of the line between two modes, x");
    write("y1", y1, y_units, "End of a piece of the line between two modes, y");
    write("mode_a", a, "1", "Mode on one side, row of modes");
    write("mode_b", b, "1", "Mode on the other side, row of modes");
}

/// What a survey of starts says of each point.
template <class Write>
void write_motions(theory::Map const& map, Write const& write) {
    std::vector<int> count;
    std::vector<double> fraction, lowest, highest;
    for (auto const& all : map.motions) {
        auto const efficiency = [](auto const& one) { return one.motion.velocity_efficiency; };
        auto const [low, high] = std::ranges::minmax_element(all, {}, efficiency);
        count.push_back(static_cast<int>(all.size()));
        fraction.push_back(all.empty() ? std::nan("") : all.front().share);
        lowest.push_back(all.empty() ? std::nan("") : efficiency(*low));
        highest.push_back(all.empty() ? std::nan("") : efficiency(*high));
    }
    write("motions", count,
          "Number of motions to which different starts lead; 0 where starts cannot be followed");
    write("fraction", fraction, "Fraction of the starts that lead to the motion of the standard start");
    write("lowest_efficiency", lowest, "Lowest velocity efficiency of these motions");
    write("highest_efficiency", highest, "Highest velocity efficiency of these motions");
}

}  // namespace

std::string units_of(theory::Input input) {
    std::string_view const name = theory::name_of(input);
    if (name.ends_with("_deg")) return "degree";
    if (name.ends_with("_hz")) return "Hz";
    if (name.ends_with("_mm")) return "mm";
    return name.ends_with("_m") ? "m" : "1";
}

namespace {

void fill_map(Hdf5Writer& file, theory::Map const& map, theory::Inputs const& fixed) {
    write_header(file, "vibrotrough theory map");
    write_axis(file, "x", map.x);
    write_axis(file, "y", map.y);
    for (std::size_t i = 0; i < theory::input_count; ++i) {
        auto const input = static_cast<theory::Input>(i);
        if (auto const value = fixed.get(input)) {
            file.dataset("fixed/" + std::string(theory::name_of(input)), std::vector<double>{*value},
                         units_of(input), "Input that is the same for all points");
        }
    }
    ModeIndex modes;
    std::vector<double> efficiency, half_width;
    std::vector<int> mode, period, outcome;
    for (auto* const column : {&efficiency, &half_width}) column->reserve(map.points.size());
    for (auto* const column : {&mode, &period, &outcome}) column->reserve(map.points.size());
    for (theory::Efficiency const& point : map.points) {
        efficiency.push_back(point.velocity_efficiency);
        half_width.push_back(point.half_width);
        mode.push_back(modes(point.mode));
        period.push_back(point.period_cycles);
        outcome.push_back(static_cast<int>(point.outcome));
    }
    auto const rows = static_cast<std::size_t>(map.y.count), columns = static_cast<std::size_t>(map.x.count);
    auto const write = [&](char const* name, Values const& values, char const* meaning) {
        file.grid(name, values, rows, columns, "1", meaning);
    };
    write("velocity_efficiency", efficiency, "Velocity efficiency eta; infinite where the mass runs away");
    write("half_width", half_width, "Half-width of eta at 95 % confidence where there is no period, else 0");
    write("mode", mode, "Mode, row of modes");
    write("period_cycles", period, "Cycles after which the motion repeats; 0 when it does not");
    write("outcome", outcome, "0 periodic, 1 runs away, 2 indifferent, 3 no period found");
    if (!map.motions.empty()) write_motions(map, write);
    write_boundaries(file, map, modes);
    file.dataset("modes", modes.names(), "1", "Phases of each mode in order");
    file.dataset("cpu_time_per_solution", std::vector<double>{map.cpu_seconds_per_solution}, "s",
                 "CPU time of all threads over the number of points");
}

}  // namespace

void write_theory_map(std::filesystem::path const& path, theory::Map const& map,
                      theory::Inputs const& fixed) {
    write_hdf5(path, [&](Hdf5Writer& file) { fill_map(file, map, fixed); });
}

void write_theory_table(std::filesystem::path const& path, std::vector<TheoryColumn> const& columns) {
    write_hdf5(path, [&](Hdf5Writer& file) {
        write_header(file, "vibrotrough theory table");
        for (TheoryColumn const& one : columns) {
            Values const values = one.texts.empty() ? Values(one.numbers) : Values(one.texts);
            file.dataset(one.name, values, one.units, one.description);
        }
    });
}

}  // namespace vibrotrough::store
