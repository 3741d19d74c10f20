#include "view/contact_reader.hpp"

#include "core/error.hpp"
#include "view/dump_reader.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace vibrotrough::view {
namespace {

namespace fs = std::filesystem;

/// The columns of both dumps: two places, three numbers, normal force, tangential force, overlap.
constexpr std::size_t columns = 16;

void append(std::vector<float>& values, double const* three) {
    for (int axis = 0; axis < 3; ++axis) values.push_back(static_cast<float>(three[axis]));
}

void add(ContactFrame& frame, int first, int second, double const* start, std::array<double, 3> const& end,
         double const* row) {
    frame.first.push_back(first);
    frame.second.push_back(second);
    append(frame.start, start);
    append(frame.end, end.data());
    append(frame.normal_force, &row[9]);
    append(frame.tangential_force, &row[12]);
    frame.overlap.push_back(static_cast<float>(row[15]));
}

void add_pair(ContactFrame& frame, double const* row, std::array<double, 6> const& box) {
    std::array<double, 3> end{row[3], row[4], row[5]};
    // The engine writes the second grain where it is in the box. A box is at least four diameters long, so
    // that the nearest of its images is the one that is touched.
    for (std::size_t axis = 0; axis < 2; ++axis) {
        double const length = box[2 * axis + 1] - box[2 * axis];
        end[axis] -= length * std::round((end[axis] - row[axis]) / length);
    }
    add(frame, static_cast<int>(row[6]), static_cast<int>(row[7]), row, end, row);
}

/// Calls `take` with every row of a dump. @returns whether the file is complete
template <class Take>
bool read_rows(fs::path const& path, long step, Take const& take) {
    std::error_code missing;
    if (!fs::is_regular_file(path, missing)) return false;
    auto const dump = read_dump(path, "ENTRIES");
    if (!dump) return false;
    if (dump->step != step || dump->columns.size() != columns)
        throw core::InputError(
            fmt::format("{}: it should have {} columns and be of step {} (the file is damaged); run the case "
                        "again",
                        path.string(), columns, step));
    for (std::size_t row = 0; row < dump->rows(); ++row) take(&dump->values[columns * row]);
    return true;
}

}  // namespace

std::optional<ContactFrame> read_contacts(fs::path const& folder, long step,
                                          std::array<double, 6> const& box) {
    ContactFrame frame;
    frame.step = step;
    bool const is_whole =
        read_rows(folder / fmt::format("contacts.{}.dump", step), step,
                  [&](double const* row) { add_pair(frame, row, box); }) &&
        read_rows(folder / fmt::format("trough_contacts.{}.dump", step), step, [&](double const* row) {
            add(frame, static_cast<int>(row[8]), 0, &row[3], {row[0], row[1], row[2]}, row);
        });
    return is_whole ? std::optional(std::move(frame)) : std::nullopt;
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
