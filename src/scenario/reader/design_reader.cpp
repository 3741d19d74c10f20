#include "scenario/reader/design_reader.hpp"

#include "core/atomic_file.hpp"
#include "core/csv.hpp"
#include "core/error.hpp"
#include "scenario/reader/sample_cube.hpp"
#include "scenario/reader/value_reader.hpp"

#include <algorithm>
#include <array>
#include <filesystem>

#include <fmt/format.h>

namespace vibrotrough::scenario {
namespace {

constexpr std::size_t most_points = 100'000;

/// Reads the sections that vary keys by lists of points, and the exclusions.
class DesignReader {
  public:
    DesignReader(std::string const& file, CampaignText& campaign) : file_(file), campaign_(campaign) {}

    void read(std::string_view name, toml::node const& node) {
        if (name == "points" || name == "exclude") {
            read_tables(name, node);
            return;
        }
        if (!node.is_table())
            fail(node.source(), name, "is a section, not a key",
                 fmt::format("write [{}] on a line of its own", name));
        if (name == "zip") read_zip(*node.as_table());
        if (name == "points_from") read_csv(*node.as_table());
        if (name == "sample") read_sample(*node.as_table());
        if (name == "domain") read_domain(*node.as_table());
    }

  private:
    [[noreturn]] void fail(toml::source_region const& source, std::string_view key, std::string_view wrong,
                           std::string_view instead) const {
        throw_at({file_, position_of(source)}, key, wrong, instead);
    }

    Key const& varied_key(std::string_view path, toml::source_region const& source) const {
        return scenario::varied_key(path, {file_, position_of(source)});
    }

    void add(PointList list) {
        if (list.points.empty())
            throw_at({file_, list.where}, "design", "has no points", "list at least one");
        campaign_.lists.push_back(std::move(list));
    }

    void read_tables(std::string_view name, toml::node const& node) {
        toml::array const* const tables = node.as_array();
        if (tables == nullptr || tables->empty() || !tables->is_homogeneous<toml::table>()) {
            fail(node.source(), name, "is a list of sections", fmt::format("write [[{}]] above each", name));
        }
        PointList list;
        list.where = position_of(node.source());
        for (toml::node const& table : *tables) {
            name == "points" ? read_point(*table.as_table(), list) : read_exclusion(*table.as_table());
        }
        if (name == "points") add(std::move(list));
    }

    void read_point(toml::table const& table, PointList& list) {
        std::vector<std::string> keys;
        std::vector<Value> point;
        for (auto const& [name, node] : table) {
            Key const& key = varied_key(name.str(), name.source());
            keys.emplace_back(name.str());
            point.push_back({read_content(key, node, file_), position_of(name.source())});
        }
        if (list.points.empty()) list.keys = keys;
        if (keys != list.keys || keys.empty()) {
            fail(table.source(), "points", "has different keys than the point before",
                 "give every point the same keys, in quotes: \"trough.throw_number\" = 2.0");
        }
        list.points.push_back(std::move(point));
    }

    void read_exclusion(toml::table const& table) {
        Exclusion exclusion;
        for (auto const& [name, node] : table) {
            Key const& key = varied_key(name.str(), name.source());
            Condition condition{std::string(name.str()), {}, {}, {}, position_of(name.source())};
            toml::table const* const bounds = node.as_table();
            if (bounds == nullptr) {
                condition.equals = read_content(key, node, file_);
            } else {
                for (auto const& [bound, value] : *bounds) {
                    if (bound.str() != "above" && bound.str() != "below")
                        fail(bound.source(), name.str(), fmt::format("'{}' is not a bound", bound.str()),
                             "write { above = a }, { below = b } or a value");
                    if (has_words(key))
                        fail(value.source(), name.str(), "its values have no order",
                             "write one of its values");
                    (bound.str() == "above" ? condition.above : condition.below) =
                        std::get<double>(read_content(key, value, file_));
                }
            }
            exclusion.push_back(std::move(condition));
        }
        if (exclusion.empty())
            fail(table.source(), "exclude", "would leave out every case",
                 "write a condition such as \"trough.throw_number\" = { above = 3 }");
        campaign_.exclusions.push_back(std::move(exclusion));
    }

    void read_zip(toml::table const& table) {
        PointList list;
        list.where = position_of(table.source());
        for (auto const& [name, node] : table) {
            Key const& key = varied_key(name.str(), name.source());
            toml::array const* const values = node.as_array();
            if (values == nullptr || values->size() > most_points)
                fail(node.source(), name.str(), "is not a list of at most 100000 values", "write [a, b, c]");
            if (list.keys.empty()) list.points.resize(values->size());
            if (values->size() != list.points.size())
                fail(node.source(), name.str(),
                     fmt::format("has {} values, but {} has {}", values->size(), list.keys.front(),
                                 list.points.size()),
                     "give zipped lists the same length, because they are varied together");
            list.keys.emplace_back(name.str());
            for (std::size_t i = 0; i < values->size(); ++i)
                list.points[i].push_back(
                    {read_content(key, *values->get(i), file_), position_of(name.source())});
        }
        add(std::move(list));
    }

    /// A whole number of a section. @param example  what to write instead
    int whole(toml::table const& table, std::string_view section, char const* name, int least, int most,
              int example) const {
        toml::node const* const node = table.get(name);
        std::int64_t const value = node != nullptr ? node->value_exact<std::int64_t>().value_or(-1) : -1;
        if (value < least || value > most)
            fail(node ? node->source() : table.source(), fmt::format("{}.{}", section, name),
                 node ? "is not a whole number in its range" : "is missing",
                 fmt::format("write {} = {}, in the range {} to {}", name, example, least, most));
        return static_cast<int>(value);
    }

    /// All keys of a section but `others`, each with its range.
    std::vector<DomainAxis> read_ranges(toml::table const& table, std::string_view section,
                                        std::initializer_list<std::string_view> others) const {
        std::vector<DomainAxis> ranges;
        for (auto const& [name, node] : table) {
            if (std::ranges::find(others, name.str()) != others.end()) continue;
            Key const& key = varied_key(name.str(), name.source());
            auto const [low, high] = read_range(key, name, node);
            ranges.push_back({std::string(name.str()), low, high});
        }
        if (ranges.empty() || ranges.size() > 40)
            fail(table.source(), section, "needs ranges for 1 to 40 keys",
                 "write \"trough.throw_number\" = { from = 1, to = 3 }");
        return ranges;
    }

    void add_sample(SampleMethod method, int count, int seed, std::vector<DomainAxis> const& ranges,
                    toml::table const& table) {
        PointList list;
        list.where = position_of(table.source());
        for (DomainAxis const& range : ranges) list.keys.push_back(range.key);
        for (auto const& row :
             sample_cube(method, count, static_cast<int>(ranges.size()), static_cast<unsigned>(seed))) {
            std::vector<Value> point;
            for (std::size_t k = 0; k < row.size(); ++k) point.push_back({ranges[k].at(row[k]), list.where});
            list.points.push_back(std::move(point));
        }
        add(std::move(list));
    }

    void read_sample(toml::table const& table) {
        auto const method = table["method"].value<std::string>().value_or("");
        if (method != "sobol" && method != "latin-hypercube")
            fail(table.source(), "sample.method", "is neither \"sobol\" nor \"latin-hypercube\"",
                 "write method = \"sobol\"");
        int const count = whole(table, "sample", "count", 1, most_points, 64);
        int const seed = table.contains("seed") ? whole(table, "sample", "seed", 0, 2'147'483'647, 64) : 1;
        add_sample(method == "sobol" ? SampleMethod::sobol : SampleMethod::latin_hypercube, count, seed,
                   read_ranges(table, "sample", {"method", "count", "seed"}), table);
    }

    /// The domain of a surface begins with points that fill it.
    void read_domain(toml::table const& table) {
        campaign_.domain = read_ranges(table, "domain", {"start", "seed"});
        int const usual = 2 * static_cast<int>(campaign_.domain.size()) + 2;
        int const count = table.contains("start") ? whole(table, "domain", "start", 4, 10'000, usual) : usual;
        int const seed = table.contains("seed") ? whole(table, "domain", "seed", 0, 2'147'483'647, 1) : 1;
        add_sample(SampleMethod::sobol, count, seed, campaign_.domain, table);
    }

    std::array<double, 2> read_range(Key const& key, toml::key const& name, toml::node const& node) const {
        toml::table const* const range = node.as_table();
        bool const whole_range =
            range != nullptr && range->size() == 2 && range->contains("from") && range->contains("to");
        if (!whole_range) fail(name.source(), name.str(), "is not a range", "write { from = a, to = b }");
        if (has_words(key)) fail(name.source(), name.str(), "its values have no order", "choose a number");
        std::array<double, 2> const ends{std::get<double>(read_content(key, *range->get("from"), file_)),
                                         std::get<double>(read_content(key, *range->get("to"), file_))};
        if (!(ends[0] < ends[1]))
            fail(name.source(), name.str(), "the range is empty", "write { from = a, to = b } with a < b");
        return ends;
    }

    void read_csv(toml::table const& table) {
        auto const name = table["file"].value<std::string>().value_or("");
        bool const plain = PlainName::from(name).has_value() && name.ends_with(".csv");
        if (!plain || table.size() != 1)
            fail(table.source(), "points_from.file",
                 fmt::format("'{}' is not the plain name of a CSV file", name),
                 "write file = \"points.csv\" for a file in the folder of the campaign file");
        std::filesystem::path const path = std::filesystem::path(file_).parent_path() / name;
        std::error_code failure;
        if (!std::filesystem::is_regular_file(path, failure) ||
            std::filesystem::file_size(path, failure) > (16u << 20))
            fail(table.source(), "points_from.file",
                 fmt::format("there is no file {} of at most 16 MiB", path.string()),
                 "put it in the folder of the campaign file");
        campaign_.files.push_back(path);
        PointList list;
        list.where = position_of(table.source());
        read_csv_rows(path.string(), core::read_file(path, core::largest_note), list);
        add(std::move(list));
    }

    void read_csv_rows(std::string const& file, std::string const& text, PointList& list) {
        core::CsvReader table(text, file, {.comments = true, .blanks = true, .most_rows = most_points});
        list.keys = table.columns();
        for (std::string const& name : list.keys) {
            Key const* const key = find_key(name);
            if (key == nullptr || !can_vary(*key))
                throw_at({file, {static_cast<unsigned>(table.header_line()), 1}}, name,
                         "is not a key that can be varied",
                         "write keys such as trough.throw_number in the first line");
        }
        while (table.next()) {
            Position const where{static_cast<unsigned>(table.line()), 1};
            std::vector<Value> point;
            for (std::size_t k = 0; k < list.keys.size(); ++k) {
                Key const& key = *find_key(list.keys[k]);
                std::string const cell = has_words(key)
                                             ? std::string(table.cells()[k])
                                             : core::with_decimal_point(table.cells()[k], table.separator());
                point.push_back({read_cell(file, where, key, cell), list.where});
            }
            list.points.push_back(std::move(point));
        }
    }

    /// The value in a cell, which holds what would be to the right of an equals sign, without quotes.
    static Content read_cell(std::string const& file, Position where, Key const& key,
                             std::string const& cell) {
        try {
            return read_plain_content(key, cell);
        } catch (core::InputError const& error) {
            throw core::InputError(fmt::format("{}:{}: {}", file, where.line, error.what()));
        }
    }

    std::string const& file_;
    CampaignText& campaign_;
};

}  // namespace

bool is_design_section(std::string_view name) {
    constexpr std::array<std::string_view, 6> names{"zip",    "points",  "points_from",
                                                    "sample", "exclude", "domain"};
    return std::ranges::find(names, name) != names.end();
}

void read_design_section(std::string_view name, toml::node const& node, std::string const& file,
                         CampaignText& campaign) {
    DesignReader(file, campaign).read(name, node);
}

void check_design(CampaignText const& campaign, std::string const& file) {
    std::vector<std::pair<std::string, Position>> seen;
    auto const add = [&](std::string const& key, Position place) {
        std::string_view const group = find_key(key)->group;
        for (auto const& [other, where] : seen) {
            if (key == other || (!group.empty() && group == find_key(other)->group))
                throw_at({file, place}, key, fmt::format("{} is also varied, on line {}", other, where.line),
                         "keep one of the two");
        }
        seen.emplace_back(key, place);
    };
    for (Axis const& axis : campaign.sweep) add(axis.key, axis.where);
    for (PointList const& list : campaign.lists)
        for (std::string const& key : list.keys) add(key, list.where);
}

}  // namespace vibrotrough::scenario
