#include "compare/columns.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

namespace vibrotrough::compare {
namespace {

using Cells = std::vector<std::string>;

struct Column {
    char const* name;
    char const* unit;
    int importance;  ///< the least important column is dropped first when the table is too wide
    bool flush_left;
};

/// In the order of `cells`. Nine is never dropped.
constexpr Column columns[] = {{"case", "", 9, true},
                              {"Gamma", "", 8, false},
                              {"beta", "deg", 5, false},
                              {"alpha", "deg", 3, false},
                              {"mu", "", 4, false},
                              {"f", "Hz", 1, false},
                              {"eta DEM", "", 9, false},
                              {"eta theory", "at mu", 7, false},
                              {"eta point", "its force", 3, false},
                              {"mu layer", "", 4, false},
                              {"eta theory", "at mu layer", 6, false},
                              {"difference", "", 9, false},
                              {"mode", "theory", 5, false},
                              {"mode", "layer", 5, false},
                              {"speed", "m/s", 4, false},
                              {"cycles", "cut+kept", 2, false},
                              {"outcome", "", 6, true}};
constexpr std::size_t column_count = std::size(columns);
constexpr std::size_t difference_at = 11, outcome_at = 16;
constexpr int never_dropped = 9;
constexpr std::size_t gap = 2;

std::string shown(std::optional<double> const& value, char const* format) {
    return value ? fmt::format(fmt::runtime(format), *value) : "-";
}

Cells cells(Row const& row) {
    return {row.id,
            fmt::format("{:.3f}", row.throw_number),
            fmt::format("{:.2f}", row.vibration_angle_deg),
            fmt::format("{:.2f}", row.inclination_deg),
            fmt::format("{:.3g}", row.friction),
            fmt::format("{:.2f}", row.frequency_hz),
            shown(row.efficiency_dem, "{:.3f}") + " +- " + shown(row.efficiency_dem_half_width, "{:.3f}"),
            shown(row.efficiency_theory, "{:.3f}"),
            shown(row.efficiency_normal_force, "{:.3f}"),
            shown(row.friction_layer, "{:.3f}"),
            shown(row.efficiency_theory_layer, "{:.3f}"),
            shown(difference(row), "{:+.3f}"),
            row.mode_theory.empty() ? "-" : row.mode_theory,
            row.mode_layer.value_or("-"),
            shown(row.speed_dem_m_per_s, "{:.3f}"),
            row.cycles_measured ? fmt::format("{}+{}", *row.cycles_discarded, *row.cycles_measured) : "-",
            row.outcome};
}

/// Colours that the colour-blind tell apart: yellow where the layer is faster than the theory, cyan where it
/// is slower, bold from 0.1 on; none within the confidence interval.
std::string difference_colour(Row const& row) {
    auto const value = difference(row);
    if (!value || std::abs(*value) <= row.efficiency_dem_half_width.value_or(0.0)) return {};
    return fmt::format("\x1b[{}{}m", std::abs(*value) >= 0.1 ? "1;" : "", *value > 0 ? 33 : 36);
}

std::string outcome_colour(Row const& row) {
    bool const waits = row.outcome == "open" || row.outcome == "running" || row.outcome == "interrupted";
    return row.outcome == "finished" || waits ? "" : "\x1b[31m";
}

constexpr std::size_t headings = 2;

/// Columns with the same value in all of several rows.
std::vector<bool> constant(std::vector<Cells> const& lines) {
    std::vector<bool> same(column_count, lines.size() > headings + 1);
    for (std::size_t i = 0; i < column_count; ++i) {
        for (std::size_t n = headings; n < lines.size(); ++n)
            same[i] = same[i] && lines[n][i] == lines[headings][i];
    }
    return same;
}

/// What only some campaigns know: the layer's friction and mode. Not shown when it is known of no case.
bool is_optional(std::size_t column) {
    std::string const unit = columns[column].unit;
    return unit == "at mu layer" || unit == "layer" || unit == "its force" ||
           std::string(columns[column].name) == "mu layer";
}

bool is_unknown(std::vector<Cells> const& lines, std::size_t column) {
    return std::all_of(lines.begin() + headings, lines.end(),
                       [&](Cells const& line) { return line[column] == "-"; });
}

/// Which columns are shown in `width` characters: the least important are dropped, and first of all those
/// that are the same in all rows.
std::vector<bool> chosen(std::vector<Cells> const& lines, std::vector<bool> const& same,
                         std::vector<std::size_t> const& widths, std::size_t width) {
    std::vector<int> importance(column_count);
    for (std::size_t i = 0; i < column_count; ++i) {
        importance[i] = columns[i].importance - (same[i] && columns[i].importance < never_dropped ? 10 : 0);
    }
    std::vector<bool> keep(column_count, true);
    for (std::size_t i = 0; i < column_count; ++i) keep[i] = !(is_optional(i) && is_unknown(lines, i));
    auto const needed = [&] {
        std::size_t sum = 0;
        for (std::size_t i = 0; i < column_count; ++i) sum += keep[i] ? widths[i] + gap : 0;
        return sum - gap;
    };
    while (width > 0 && needed() > width) {
        std::size_t least = 0;
        for (std::size_t i = 0; i < column_count; ++i) {
            if (keep[i] && (!keep[least] || importance[i] < importance[least])) least = i;
        }
        if (importance[least] >= never_dropped) break;
        keep[least] = false;
    }
    return keep;
}

/// Says what was dropped, and the value of what is the same in all rows.
std::string dropped_note(std::vector<bool> const& keep, std::vector<bool> const& same, Cells const& first) {
    std::string values, names;
    for (std::size_t i = 0; i < column_count; ++i) {
        std::string const name = columns[i].name, unit = columns[i].unit;
        if (keep[i] || (is_optional(i) && first[i] == "-")) continue;
        if (same[i]) {
            bool const quantity = unit == "deg" || unit == "Hz" || unit == "m/s";
            values += fmt::format("{}{} {}{}", values.empty() ? "" : ", ", name, first[i],
                                  quantity ? " " + unit : "");
        } else {
            names += (names.empty() ? "" : ", ") + name;
        }
    }
    std::string note;
    if (!values.empty()) note += fmt::format("the same in all: {}\n", values);
    if (!names.empty()) note += fmt::format("no room for {}; a wider terminal or --csv shows all\n", names);
    return note;
}

std::string painted(std::string const& text, std::string const& colour) {
    std::size_t const first = text.find_first_not_of(' ');
    if (colour.empty() || first == text.npos) return text;
    std::size_t const last = text.find_last_not_of(' ');
    return text.substr(0, first) + colour + text.substr(first, last - first + 1) + "\x1b[0m" +
           text.substr(last + 1);
}

}  // namespace

std::string to_table(std::vector<Row> const& rows, TableStyle const& style) {
    std::vector<Cells> lines(headings);
    for (Column const& column : columns) {
        lines[0].emplace_back(column.name);
        lines[1].emplace_back(column.unit);
    }
    for (Row const& row : rows) lines.push_back(cells(row));
    std::vector<std::size_t> widths(column_count, 0);
    for (Cells const& line : lines) {
        for (std::size_t i = 0; i < column_count; ++i) widths[i] = std::max(widths[i], line[i].size());
    }
    std::vector<bool> const same = constant(lines), keep = chosen(lines, same, widths, style.width);
    std::string text;
    for (std::size_t n = 0; n < lines.size(); ++n) {
        std::string line;
        for (std::size_t i = 0; i < column_count; ++i) {
            if (!keep[i]) continue;
            std::string const cell = columns[i].flush_left ? fmt::format("{:<{}}", lines[n][i], widths[i])
                                                           : fmt::format("{:>{}}", lines[n][i], widths[i]);
            std::string colour;
            if (style.colour && n >= headings && i == difference_at)
                colour = difference_colour(rows[n - headings]);
            if (style.colour && n >= headings && i == outcome_at) colour = outcome_colour(rows[n - headings]);
            line += painted(cell, colour) + std::string(gap, ' ');
        }
        text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    }
    return text + (rows.empty() ? "" : dropped_note(keep, same, lines[headings]));
}

}  // namespace vibrotrough::compare
