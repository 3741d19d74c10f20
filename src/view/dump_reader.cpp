#include "view/dump_reader.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

namespace vibrotrough::view {
namespace {

namespace fs = std::filesystem;

/// Thrown when the text ends before an item is complete, as in a file that is still being written.
struct TextEnds {};

[[noreturn]] void refuse_at(fs::path const& path, long line, std::string const& what) {
    throw core::InputError(
        fmt::format("{}:{}: {} (the file is damaged); run the case again", path.string(), line, what));
}

/// Reads the numbers and lines written by the engine without copying them.
class TextCursor {
  public:
    TextCursor(std::string_view text, fs::path const& path)
        : at_(text.data()), end_(text.data() + text.size()), path_(path) {}

    bool at_end() const { return at_ == end_; }

    /// The rest of the line without its end.
    std::string_view line() {
        char const* const stop = std::find(at_, end_, '\n');
        if (stop == end_) throw TextEnds{};
        std::string_view const found(at_, static_cast<std::size_t>(stop - at_));
        at_ = stop + 1;
        ++line_;
        return found;
    }

    /// Passes over a line that begins so. @returns the rest of it
    std::string_view expect(std::string_view start) {
        auto const rest = static_cast<std::size_t>(end_ - at_);
        std::string_view const seen(at_, std::min(rest, start.size()));
        if (seen != start.substr(0, seen.size())) refuse(fmt::format("should be '{}'", start));
        return line().substr(start.size());
    }

    double number() {
        skip_spaces();
        double value = 0;
        auto const [after, failure] = std::from_chars(at_, end_, value);
        if (after == end_) throw TextEnds{};
        if (failure != std::errc{} || (*after != ' ' && *after != '\n') || !std::isfinite(value))
            refuse("is not a finite number");
        at_ = after;
        return value;
    }

    void end_line() {
        skip_spaces();
        if (at_end()) throw TextEnds{};
        if (*at_ != '\n') refuse("does not belong on this line");
        ++at_;
        ++line_;
    }

    [[noreturn]] void refuse(std::string_view what) const {
        std::ptrdiff_t constexpr shown = 40;
        char const* const stop = std::find(at_, at_ + std::min(shown, end_ - at_), '\n');
        std::string_view const text(at_, static_cast<std::size_t>(stop - at_));
        refuse_at(path_, line_, fmt::format("'{}' {}", text, what));
    }

  private:
    void skip_spaces() {
        while (at_ != end_ && *at_ == ' ') ++at_;
    }

    char const* at_;
    char const* end_;
    fs::path const& path_;
    long line_ = 1;
};

constexpr long line_of_columns = 9;

EngineDump read(TextCursor& cursor, fs::path const& path, std::size_t text_size, std::string_view item) {
    EngineDump dump;
    dump.path = path;
    cursor.expect("ITEM: TIMESTEP");
    dump.step = static_cast<long>(cursor.number());
    cursor.end_line();
    cursor.expect("ITEM: NUMBER OF ");
    double const rows = cursor.number();
    if (rows < 0) cursor.refuse("comes after a number that is below 0");
    cursor.end_line();
    cursor.expect("ITEM: BOX BOUNDS");
    for (std::size_t i = 0; i < dump.box.size(); ++i) {
        dump.box.at(i) = cursor.number();
        if (i % 2 == 1) cursor.end_line();
    }
    std::string_view names = cursor.expect(fmt::format("ITEM: {} ", item));
    while (!names.empty()) {
        std::string_view const name = names.substr(0, names.find(' '));
        if (!name.empty()) dump.columns.emplace_back(name);
        names.remove_prefix(std::min(name.size() + 1, names.size()));
    }
    if (dump.columns.empty()) refuse_at(path, line_of_columns, "there are no columns");
    double const count = rows * static_cast<double>(dump.columns.size());
    // A value takes at least two characters: no memory for more rows than the file can contain.
    if (count > static_cast<double>(text_size) / 2) throw TextEnds{};
    dump.values.reserve(static_cast<std::size_t>(count));
    for (double row = 0; row < rows; ++row) {
        for (std::size_t i = 0; i < dump.columns.size(); ++i) dump.values.push_back(cursor.number());
        cursor.end_line();
    }
    if (!cursor.at_end()) cursor.refuse("comes after the last row");
    return dump;
}

template <typename Number>
std::vector<Number> column_of(EngineDump const& dump, std::string_view name) {
    std::vector<double> const values = dump.column(name);
    std::vector<Number> numbers(values.size());
    std::ranges::transform(values, numbers.begin(), [](double value) { return static_cast<Number>(value); });
    return numbers;
}

/// x y z of each row.
std::vector<float> vectors_of(EngineDump const& dump, std::array<std::string_view, 3> const& names) {
    std::vector<float> vectors(3 * dump.rows());
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::vector<double> const values = dump.column(names.at(axis));
        for (std::size_t i = 0; i < values.size(); ++i) vectors[3 * i + axis] = static_cast<float>(values[i]);
    }
    return vectors;
}

}  // namespace

bool EngineDump::has(std::string_view name) const {
    return std::ranges::find(columns, name) != columns.end();
}

std::vector<double> EngineDump::column(std::string_view name) const {
    if (std::ranges::count(columns, name) != 1)
        refuse_at(path, line_of_columns, fmt::format("the columns are not with exactly one '{}'", name));
    auto const number = static_cast<std::size_t>(std::ranges::find(columns, name) - columns.begin());
    std::vector<double> found(rows());
    for (std::size_t row = 0; row < found.size(); ++row) found[row] = values[row * columns.size() + number];
    return found;
}

std::optional<EngineDump> read_dump(fs::path const& path, std::string_view item) {
    std::string const text = core::read_file(path);
    TextCursor cursor(text, path);
    try {
        return read(cursor, path, text.size(), item);
    } catch (TextEnds const&) {
        return {};
    }
}

std::optional<GrainFrame> read_grains(fs::path const& path) {
    auto const dump = read_dump(path, "ATOMS");
    if (!dump) return {};
    GrainFrame frame;
    frame.step = dump->step;
    frame.box = dump->box;
    frame.id = column_of<int>(*dump, "id");
    frame.position = vectors_of(*dump, {"x", "y", "z"});
    frame.velocity = vectors_of(*dump, {"vx", "vy", "vz"});
    frame.radius = column_of<float>(*dump, "radius");
    if (dump->has("type")) frame.type = column_of<int>(*dump, "type");
    if (dump->has("omegay")) frame.spin = vectors_of(*dump, {"omegax", "omegay", "omegaz"});
    return frame;
}

}  // namespace vibrotrough::view
