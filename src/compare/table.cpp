#include "compare/table.hpp"

#include "core/text.hpp"

#include <algorithm>
#include <functional>

#include <fmt/format.h>

namespace vibrotrough::compare {
namespace {

using Cells = std::vector<std::string>;
using Columns = std::vector<Column const*>;

constexpr std::size_t gap = 2;       ///< characters between columns
constexpr std::size_t headings = 2;  ///< lines

/// The columns of the terminal's table from left to right.
Columns terminal_columns(std::span<Column const> columns) {
    Columns shown;
    for (Column const& column : columns) {
        if (column.terminal) shown.push_back(&column);
    }
    return shown;
}

std::string cell(Column const& column, Row const& row) {
    return column.cell != nullptr ? column.cell(row) : column.shown(row);
}

/// Columns with the same value in all of several rows.
std::vector<bool> constant(std::vector<Cells> const& lines, std::size_t count) {
    std::vector<bool> same(count, lines.size() > headings + 1);
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t n = headings; n < lines.size(); ++n)
            same[i] = same[i] && lines[n][i] == lines[headings][i];
    }
    return same;
}

bool is_unknown(std::vector<Cells> const& lines, std::size_t column) {
    return std::all_of(lines.begin() + headings, lines.end(),
                       [&](Cells const& line) { return line[column] == "-"; });
}

/// Shows again what fits into the place of a wide column that was dropped, the most important first.
void put_back(std::vector<bool>& keep, Columns const& columns, std::vector<Cells> const& lines,
              std::vector<int> const& priority, std::function<bool()> const& fits) {
    std::vector<std::size_t> dropped;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        if (!keep[i] && !(columns[i]->terminal->only_when_known && is_unknown(lines, i)))
            dropped.push_back(i);
    }
    std::ranges::stable_sort(dropped, std::greater{}, [&](std::size_t i) { return priority[i]; });
    for (std::size_t const i : dropped) {
        keep[i] = true;
        keep[i] = fits();
    }
}

/// Which columns are shown in `width` characters: the least important are dropped, and first of all those
/// that are the same in all rows.
std::vector<bool> chosen(Columns const& columns, std::vector<Cells> const& lines,
                         std::vector<bool> const& same, std::vector<std::size_t> const& widths,
                         std::size_t width) {
    std::vector<int> priority;
    std::vector<bool> keep;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        TerminalView const& view = *columns[i]->terminal;
        priority.push_back(view.priority - (same[i] && view.priority < always_shown ? 10 : 0));
        keep.push_back(!(view.only_when_known && is_unknown(lines, i)));
    }
    auto const needed = [&] {
        std::size_t sum = 0;
        for (std::size_t i = 0; i < columns.size(); ++i) sum += keep[i] ? widths[i] + gap : 0;
        return sum - gap;
    };
    while (width > 0 && !columns.empty() && needed() > width) {
        std::size_t least = 0;
        for (std::size_t i = 0; i < columns.size(); ++i) {
            if (keep[i] && (!keep[least] || priority[i] < priority[least])) least = i;
        }
        if (priority[least] >= always_shown) break;
        keep[least] = false;
    }
    put_back(keep, columns, lines, priority, [&] { return width == 0 || needed() <= width; });
    return keep;
}

/// The line below the table: the columns that were left out, with their value when it is the same in all
/// rows.
std::string dropped_note(Columns const& columns, std::vector<bool> const& keep, std::vector<bool> const& same,
                         Cells const& first) {
    std::string values, names;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        TerminalView const& view = *columns[i]->terminal;
        if (keep[i] || (view.only_when_known && first[i] == "-")) continue;
        if (same[i]) {
            values += fmt::format("{}{} {}", values.empty() ? "" : ", ", view.heading, first[i]);
            if (columns[i]->unit != "1") values += fmt::format(" {}", view.subheading);
        } else {
            if (view.heading == "+-") continue;  // of the column before it
            std::string_view const space = names.empty() ? "" : ", ";
            names += view.subheading.empty() ? fmt::format("{}{}", space, view.heading)
                                             : fmt::format("{}{} ({})", space, view.heading, view.subheading);
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

/// Headings and cells of all columns, kept or not.
std::vector<Cells> lines_of(std::vector<Row> const& rows, Columns const& columns) {
    std::vector<Cells> lines(headings + rows.size());
    for (Column const* const column : columns) {
        lines[0].emplace_back(column->terminal->heading);
        lines[1].emplace_back(column->terminal->subheading);
        for (std::size_t n = 0; n < rows.size(); ++n)
            lines[headings + n].push_back(core::harmless(cell(*column, rows[n])));
    }
    return lines;
}

}  // namespace

std::string to_table(std::vector<Row> const& rows, TableStyle const& style, std::span<Column const> columns) {
    Columns const shown = terminal_columns(columns);
    std::vector<Cells> const lines = lines_of(rows, shown);
    std::vector<std::size_t> widths(shown.size(), 0);
    for (Cells const& line : lines) {
        for (std::size_t i = 0; i < shown.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
    }
    std::vector<bool> const same = constant(lines, shown.size());
    std::vector<bool> const keep = chosen(shown, lines, same, widths, style.width);
    std::string text;
    for (std::size_t n = 0; n < lines.size(); ++n) {
        std::string line;
        for (std::size_t i = 0; i < shown.size(); ++i) {
            if (!keep[i]) continue;
            TerminalView const& view = *shown[i]->terminal;
            std::string const padded = view.flush_left ? fmt::format("{:<{}}", lines[n][i], widths[i])
                                                       : fmt::format("{:>{}}", lines[n][i], widths[i]);
            bool const coloured = style.colour && n >= headings && shown[i]->colour != nullptr;
            line +=
                painted(padded, coloured ? shown[i]->colour(rows[n - headings]) : "") + std::string(gap, ' ');
        }
        text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    }
    return text + (rows.empty() ? "" : dropped_note(shown, keep, same, lines[headings]));
}

}  // namespace vibrotrough::compare
