#include "view/contact_reader.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "view/text_cursor.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace vibrotrough::view {
namespace {

namespace fs = std::filesystem;

/// The columns of both dumps: two places, three numbers, normal force, tangential force, overlap.
constexpr std::size_t columns = 16;
using Row = std::array<double, columns>;

void expect(TextCursor& cursor, std::string_view item) {
    TextCursor const before = cursor;
    if (!cursor.line().starts_with(item)) before.refuse(fmt::format("should be '{}'", item));
}

/// Calls `take` with every row of a dump. @throws TextEnds
template <class Take>
void read_rows(TextCursor& cursor, std::size_t text_size, long step, Take const& take) {
    expect(cursor, "ITEM: TIMESTEP");
    TextCursor const at_step = cursor;
    if (cursor.number<long>() != step) at_step.refuse("contradicts the name of the file");
    cursor.end_line();
    expect(cursor, "ITEM: NUMBER OF ENTRIES");
    auto const rows = cursor.number<std::size_t>();
    cursor.end_line();
    expect(cursor, "ITEM: BOX BOUNDS");
    for (int axis = 0; axis < 3; ++axis) cursor.line();
    TextCursor const before = cursor;
    std::string_view const header = cursor.line();
    auto const words = static_cast<std::size_t>(std::ranges::count(header, '['));
    if (!header.starts_with("ITEM: ENTRIES ") || words != columns)
        before.refuse(fmt::format("should be 'ITEM: ENTRIES' and the names of {} columns", columns));
    if (rows > text_size / (2 * columns)) throw TextEnds{};
    Row row{};
    for (std::size_t i = 0; i < rows; ++i) {
        for (double& value : row) value = cursor.number<double>();
        cursor.end_line();
        take(row);
    }
    if (!cursor.at_end()) cursor.refuse("comes after the last contact");
}

void append(std::vector<float>& values, double const* three) {
    for (int axis = 0; axis < 3; ++axis) values.push_back(static_cast<float>(three[axis]));
}

void add(ContactFrame& frame, int first, int second, double const* start, std::array<double, 3> const& end,
         Row const& row) {
    frame.first.push_back(first);
    frame.second.push_back(second);
    append(frame.start, start);
    append(frame.end, end.data());
    append(frame.normal_force, &row[9]);
    append(frame.tangential_force, &row[12]);
    frame.overlap.push_back(static_cast<float>(row[15]));
}

void add_pair(ContactFrame& frame, Row const& row, std::array<double, 6> const& box) {
    std::array<double, 3> end{row[3], row[4], row[5]};
    // The engine writes the second grain where it is in the box. A box is at least four diameters long, so
    // that the nearest of its images is the one that is touched.
    for (std::size_t axis = 0; axis < 2; ++axis) {
        double const length = box[2 * axis + 1] - box[2 * axis];
        end[axis] -= length * std::round((end[axis] - row[axis]) / length);
    }
    add(frame, static_cast<int>(row[6]), static_cast<int>(row[7]), row.data(), end, row);
}

template <class Take>
DumpState read_file(fs::path const& path, long step, Take const& take) {
    std::error_code missing;
    if (!fs::is_regular_file(path, missing)) return DumpState::unfinished;
    std::string const text = core::read_file(path);
    TextCursor cursor(text, path);
    try {
        read_rows(cursor, text.size(), step, take);
        return DumpState::complete;
    } catch (TextEnds const&) {
        return DumpState::unfinished;
    }
}

}  // namespace

DumpState read_contacts(fs::path const& folder, long step, std::array<double, 6> const& box,
                        ContactFrame& frame) {
    frame = {};
    frame.step = step;
    DumpState const pairs = read_file(folder / fmt::format("contacts.{}.dump", step), step,
                                      [&](Row const& row) { add_pair(frame, row, box); });
    if (pairs == DumpState::unfinished) return pairs;
    return read_file(folder / fmt::format("trough_contacts.{}.dump", step), step, [&](Row const& row) {
        add(frame, static_cast<int>(row[8]), 0, &row[3], {row[0], row[1], row[2]}, row);
    });
}

bool has_contacts(fs::path const& folder) {
    std::error_code missing;
    for (fs::directory_entry const& file : fs::directory_iterator(folder, missing)) {
        std::string const name = file.path().filename().string();
        if (name.starts_with("contacts.") && name.ends_with(".dump")) return true;
    }
    return false;
}

}  // namespace vibrotrough::view
