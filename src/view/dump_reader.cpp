#include "view/dump_reader.hpp"

#include "core/atomic_file.hpp"
#include "view/text_cursor.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace vibrotrough::view {
namespace {

/// The meaning of a column of the dump.
enum class Column { id, x, y, z, vx, vy, vz, radius, omegax, omegay, omegaz, type, other };
constexpr std::array<std::string_view, 12> column_names{"id", "x",      "y",      "z",      "vx",     "vy",
                                                        "vz", "radius", "omegax", "omegay", "omegaz", "type"};
constexpr std::size_t needed_columns = 8;  // older versions wrote no spin
constexpr std::size_t type_column = 11;

std::vector<Column> columns(std::string_view names, TextCursor const& cursor) {
    std::vector<Column> found;
    std::array<int, column_names.size()> seen{};
    while (!names.empty()) {
        std::string_view const name = names.substr(0, names.find(' '));
        names.remove_prefix(std::min(name.size() + 1, names.size()));
        if (name.empty()) continue;
        std::size_t which = 0;
        while (which < column_names.size() && column_names[which] != name) ++which;
        found.push_back(static_cast<Column>(which));
        if (which < column_names.size()) ++seen[which];
    }
    for (std::size_t which = 0; which < column_names.size(); ++which) {
        bool const spin = which >= needed_columns;
        int const wanted = which == type_column ? seen[which] : spin ? seen[needed_columns] : 1;
        if (seen[which] != wanted || seen[which] > 1)
            cursor.refuse(fmt::format("comes after a list of columns that does not contain exactly one '{}'",
                                      column_names[which]));
    }
    return found;
}

void expect(TextCursor& cursor, std::string_view item) {
    TextCursor const before = cursor;
    if (!cursor.line().starts_with(item)) before.refuse(fmt::format("should be '{}'", item));
}

void read_grain(TextCursor& cursor, std::vector<Column> const& order, std::size_t grain, GrainFrame& frame) {
    for (Column const column : order) {
        switch (column) {
            case Column::id:
                frame.id[grain] = cursor.number<int>();
                break;
            case Column::x:
            case Column::y:
            case Column::z: {
                auto const axis = static_cast<std::size_t>(column) - static_cast<std::size_t>(Column::x);
                frame.position[3 * grain + axis] = cursor.number<float>();
                break;
            }
            case Column::vx:
            case Column::vy:
            case Column::vz: {
                auto const axis = static_cast<std::size_t>(column) - static_cast<std::size_t>(Column::vx);
                frame.velocity[3 * grain + axis] = cursor.number<float>();
                break;
            }
            case Column::radius:
                frame.radius[grain] = cursor.number<float>();
                break;
            case Column::omegax:
            case Column::omegay:
            case Column::omegaz: {
                auto const axis = static_cast<std::size_t>(column) - static_cast<std::size_t>(Column::omegax);
                // A spin may be smaller than any float.
                frame.spin[3 * grain + axis] = static_cast<float>(cursor.number<double>());
                break;
            }
            case Column::type:
                frame.type[grain] = cursor.number<int>();
                break;
            case Column::other:
                cursor.number<double>();
                break;
        }
    }
    cursor.end_line();
}

void read_frame(TextCursor& cursor, std::size_t text_size, GrainFrame& frame) {
    expect(cursor, "ITEM: TIMESTEP");
    frame.step = cursor.number<long>();
    cursor.end_line();
    expect(cursor, "ITEM: NUMBER OF ATOMS");
    auto const grains = cursor.number<std::size_t>();
    cursor.end_line();
    expect(cursor, "ITEM: BOX BOUNDS");
    for (std::size_t axis = 0; axis < 3; ++axis) {
        frame.box[2 * axis] = cursor.number<double>();
        frame.box[2 * axis + 1] = cursor.number<double>();
        cursor.end_line();
    }
    TextCursor const before = cursor;
    std::string_view constexpr item = "ITEM: ATOMS ";
    std::string_view const header = cursor.line();
    if (!header.starts_with(item)) before.refuse("should be 'ITEM: ATOMS' and the names of the columns");
    std::vector<Column> const order = columns(header.substr(item.size()), before);
    // A value takes at least two characters: do not allocate memory for more grains than the file can
    // contain.
    if (grains > text_size / (2 * order.size())) throw TextEnds{};

    frame.id.resize(grains);
    frame.position.resize(3 * grains);
    frame.velocity.resize(3 * grains);
    frame.radius.resize(grains);
    bool const spins = std::ranges::find(order, Column::omegay) != order.end();
    frame.spin.resize(spins ? 3 * grains : 0);
    bool const types = std::ranges::find(order, Column::type) != order.end();
    frame.type.resize(types ? grains : 0);
    for (std::size_t grain = 0; grain < grains; ++grain) read_grain(cursor, order, grain, frame);
    if (!cursor.at_end()) cursor.refuse("comes after the last grain");
}

}  // namespace

DumpState DumpReader::read(std::filesystem::path const& path, GrainFrame& frame) {
    core::read_file_into(path, text_);  // uses the memory of the frame before
    TextCursor cursor(text_, path);
    try {
        read_frame(cursor, text_.size(), frame);
        return DumpState::complete;
    } catch (TextEnds const&) {
        return DumpState::unfinished;
    }
}

}  // namespace vibrotrough::view
