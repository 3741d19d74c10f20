#include "measure/wear.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace vibrotrough::measure {
namespace {

constexpr std::string_view blanks = " \t\r\n";

/// The words of a text one after another.
class Words {
  public:
    explicit Words(std::string_view text) : rest_(text) {}

    /// The next word; empty at the end.
    std::string_view next() {
        rest_.remove_prefix(std::min(rest_.find_first_not_of(blanks), rest_.size()));
        std::string_view const word = rest_.substr(0, rest_.find_first_of(blanks));
        rest_.remove_prefix(word.size());
        return word;
    }

  private:
    std::string_view rest_;
};

[[noreturn]] void refuse(core::TextFile const& file) {
    throw core::InputError(fmt::format("{} is damaged; run its case again", file.path.string()));
}

/// The number that is the whole word.
template <typename Number>
Number number_of(std::string_view word, core::TextFile const& file) {
    Number number{};
    auto const [end, failure] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (failure != std::errc() || end != word.data() + word.size()) refuse(file);
    return number;
}

/// The numbers of each array by its name, with "POINTS" for the corners of the triangles.
using Arrays = std::map<std::string_view, std::vector<double>>;

/// None when the text ends within an array.
std::optional<Arrays> read_arrays(core::TextFile const& file) {
    constexpr std::size_t most = 100'000'000;
    Arrays arrays;
    Words words(file.content);
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
        bool const is_points = word == "POINTS";
        if (!is_points && word != "meshid" && word != "area" && word != "wear") continue;
        if (!is_points) words.next();  // the number of components, 1
        std::string_view const length = words.next(), type = words.next();
        if (type.empty()) return {};
        auto const count = number_of<std::size_t>(length, file);
        if (count > most) refuse(file);
        std::vector<double>& values = arrays[word];
        for (std::size_t i = 0; i < (is_points ? 3 : 1) * count; ++i) {
            std::string_view const value = words.next();
            if (value.empty()) return {};
            values.push_back(number_of<double>(value, file));
        }
    }
    return arrays;
}

}  // namespace

std::string wear_file(long step) {
    return fmt::format("wear.{}.vtk", step);
}

std::optional<WearSnapshot> parse_wear(core::TextFile const& file) {
    if (!file.content.ends_with('\n')) return {};  // perhaps within a number
    auto const arrays = read_arrays(file);
    if (!arrays || arrays->size() < 4) return {};
    std::vector<double> const &corners = arrays->at("POINTS"), &numbers = arrays->at("meshid"),
                              &areas = arrays->at("area"), &wear = arrays->at("wear");
    std::size_t const count = wear.size();
    if (count == 0 || corners.size() != 9 * count || numbers.size() != count || areas.size() != count)
        refuse(file);
    // With several processes the engine writes the triangles in another order.
    std::vector<double> const none(count);
    WearSnapshot snapshot{none, none, none, none, none};
    for (std::size_t i = 0; i < count; ++i) {
        double const number = numbers[i];
        if (!(number >= 0 && number < static_cast<double>(count)) || !(areas[i] > 0) ||
            !std::isfinite(wear[i]))
            refuse(file);
        auto const place = static_cast<std::size_t>(number);
        if (snapshot.area[place] > 0) refuse(file);
        double const* const corner = &corners[9 * i];
        snapshot.x[place] = (corner[0] + corner[3] + corner[6]) / 3;
        snapshot.y[place] = (corner[1] + corner[4] + corner[7]) / 3;
        snapshot.z[place] = (corner[2] + corner[5] + corner[8]) / 3;
        snapshot.area[place] = areas[i];
        snapshot.wear[place] = wear[i];
    }
    return snapshot;
}

Wear wear_of(std::vector<WearSnapshot> snapshots) {
    Wear wear{};
    for (WearSnapshot& one : snapshots) {
        if (wear.area.empty()) {
            wear.x = std::move(one.x);
            wear.y = std::move(one.y);
            wear.z = std::move(one.z);
            wear.area = std::move(one.area);
        }
        if (one.wear.size() != wear.area.size())
            throw core::InputError(
                fmt::format("the wear of {} triangles of the trough is known at first and of {} later; run "
                            "the case again",
                            wear.area.size(), one.wear.size()));
        wear.history.push_back(std::move(one.wear));
    }
    return wear;
}

void add_rates(Wear& wear, int from, int to, double time, double conveyed) {
    std::vector<double> const &first = wear.history.at(static_cast<std::size_t>(from)),
                              &last = wear.history.at(static_cast<std::size_t>(to));
    wear.triangle_rates.resize(wear.area.size());
    double energy = 0, area = 0;
    for (std::size_t i = 0; i < wear.area.size(); ++i) {
        wear.triangle_rates[i] = (last[i] - first[i]) / time;
        energy += (last[i] - first[i]) * wear.area[i];
        area += wear.area[i];
    }
    wear.rate = energy / (area * time);
    wear.per_conveyed = conveyed > 0 ? std::optional(energy / conveyed) : std::nullopt;
}

}  // namespace vibrotrough::measure
