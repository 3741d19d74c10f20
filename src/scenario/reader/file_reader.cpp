#include "scenario/reader/file_reader.hpp"

#include "core/error.hpp"
#include "core/quantity.hpp"
#include "core/text.hpp"
#include "scenario/reader/design_reader.hpp"
#include "scenario/reader/run_section.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <toml++/toml.h>

namespace vibrotrough::scenario {
namespace {

Position position(toml::source_region const& source) {
    return {std::max(1u, source.begin.line), std::max(1u, source.begin.column)};
}

Position position(toml::node const& node) {
    return position(node.source());
}

std::string_view name_of(std::string_view path) {
    return path.substr(path.find('.') + 1);
}

std::string write_instead(Key const& key) {
    return fmt::format("write {} = {}", name_of(key.path), key.example);
}

/// A plain name: it cannot lead out of its folder, nor mean anything to the engine or a shell.
bool is_file_name(std::string_view name) {
    bool const plain = std::ranges::all_of(name, [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
               c == '_' || c == '-';
    });
    return plain && name.size() > 4 && name.size() <= 100 && name.ends_with(".csv") && name.front() != '.' &&
           name.front() != '-';
}

/// toml++ gives a table's entries by name; people expect them, and their errors, in the order of the file.
std::vector<std::pair<toml::key const*, toml::node const*>> in_file_order(toml::table const& table) {
    std::vector<std::pair<toml::key const*, toml::node const*>> entries;
    for (auto const& [key, node] : table) entries.emplace_back(&key, &node);
    std::ranges::sort(entries, {}, [](auto const& entry) {
        Position const where = position(entry.first->source());
        return std::pair(where.line, where.column);
    });
    return entries;
}

/// toml++ bounds the depth of brackets, but not that of dotted keys, whose million tables would overflow the
/// stack. A stretch without other punctuation holds at most so many dots.
bool is_nested_too_deeply(std::string_view text) {
    constexpr int most_dots = 5000;
    int dots = 0;
    for (char const c : text) {
        if (std::string_view("=,[]{}").find(c) != std::string_view::npos) dots = 0;
        if (c == '.' && ++dots > most_dots) return true;
    }
    return false;
}

class Reader {
  public:
    Reader(std::string_view text, std::string const& file) : file_(file) {
        if (is_nested_too_deeply(text)) {
            throw_at({file_, {}}, "TOML", "keys are nested too deeply",
                     "write key = value lines under [section] headings");
        }
        try {
            root_ = toml::parse(text, file);
        } catch (toml::parse_error const& error) {
            throw_at({file_, position(error.source())}, "TOML", core::printable(error.description(), 300),
                     "write key = value lines under [section] headings");
        }
    }

    CampaignText read() {
        for (auto const& [name, node] : in_file_order(root_)) read_section(*name, *node);
        check_design(result_, file_);
        for (Key const& key : all_keys()) check_present(key);
        return std::move(result_);
    }

  private:
    [[noreturn]] void fail(Position where, std::string_view key, std::string_view wrong,
                           std::string_view instead) const {
        throw_at({file_, where}, key, wrong, instead);
    }

    static bool is_section(std::string_view name) {
        return std::ranges::any_of(
            all_keys(), [&](Key const& key) { return key.path.substr(0, key.path.find('.')) == name; });
    }

    void read_section(toml::key const& name, toml::node const& node) {
        Position const where = position(name.source());
        auto const read = [this](Key const& key, toml::node const& value) {
            return read_content(key, value);
        };
        if (name.str() == "run" && node.is_table()) {
            result_.run = read_run_section(*node.as_table(), file_, read);
            return;
        }
        if (is_design_section(name.str())) {
            read_design_section(name.str(), node, file_, read, result_);
            return;
        }
        if (!is_section(name.str()) && name.str() != "sweep" && !node.is_table()) {
            fail(where, core::printable(name.str(), 60), "stands above the first [section]",
                 "move it below its section's heading");
        }
        if (!is_section(name.str()) && name.str() != "sweep") {
            fail(where, core::printable(name.str(), 60), "unknown section",
                 "the sections are campaign, trough, grains, layer, measure, output, solver, sweep, zip, "
                 "points, "
                 "points_from, sample, exclude and run");
        }
        if (!node.is_table()) {
            fail(where, name.str(), "is a section, not a key",
                 fmt::format("write [{}] on a line of its own", name.str()));
        }
        sections_[std::string(name.str())] = where;
        for (auto const& [key, value] : in_file_order(*node.as_table())) {
            if (name.str() == "sweep") {
                read_sweep_entry(*key, *value);
            } else {
                read_key(fmt::format("{}.{}", name.str(), key->str()), position(key->source()), *value);
            }
        }
    }

    Key const& known_key(std::string const& path, Position where) const {
        if (Key const* key = find_key(path)) return *key;
        std::string_view const nearest = nearest_key(path);
        fail(
            where, core::printable(path, 60), "unknown key",
            nearest.empty() ? "'vibrotrough keys' lists all keys" : fmt::format("did you mean {}?", nearest));
    }

    void read_key(std::string const& path, Position where, toml::node const& node) {
        Key const& key = known_key(path, where);
        if (!key.group.empty()) {
            for (auto const& [other, value] : result_.base) {
                if (find_key(other)->group != key.group) continue;
                fail(where, path,
                     fmt::format("{} is given as well, on line {}, and each sets the {}", other,
                                 value.where.line, key.group),
                     "keep one of the two");
            }
        }
        if (key.kind == KeyKind::name) {
            read_name(key, where, node);
        } else {
            result_.base[path] = {read_content(key, node), where};
        }
    }

    void read_name(Key const& key, Position where, toml::node const& node) {
        std::string const name = node.value<std::string>().value_or("");
        bool const plain = std::ranges::all_of(name, [](char c) {
            return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
                   c == '_' || c == '-';
        });
        if (!node.is_string() || name.empty() || name.size() > 100 || !plain || name.front() == '.' ||
            name.front() == '-') {
            fail(
                where, key.path,
                fmt::format("{} is no name", node.is_string() ? fmt::format("'{}'", core::printable(name, 60))
                                                              : "a value that is not a text"),
                fmt::format("{}: {}, beginning with a letter, a digit or '_'", write_instead(key),
                            key.range));
        }
        result_.name = name;
    }

    Content read_content(Key const& key, toml::node const& node) const {
        switch (key.kind) {
            case KeyKind::choice:
            case KeyKind::file:
                return read_word(key, node);
            case KeyKind::quantities:
            case KeyKind::numbers:
                return read_numbers(key, node);
            case KeyKind::harmonics:
                return read_words(key, node);
            default:
                return read_number(key, node);
        }
    }

    std::string read_word(Key const& key, toml::node const& node) const {
        std::string const word = node.value<std::string>().value_or("");
        auto const known = choices(key);
        if (node.is_string() && std::ranges::find(known, word) != known.end()) return word;
        if (key.kind == KeyKind::file && node.is_string() && is_file_name(word)) return word;
        fail(position(node), key.path, fmt::format("{} is not one of its values", written(node)),
             fmt::format("{}: {}", write_instead(key), key.range));
    }

    std::vector<double> read_numbers(Key const& key, toml::node const& node) const {
        constexpr std::size_t most = 100;
        toml::array const* const list = node.as_array();
        if (list == nullptr || list->empty() || list->size() > most) {
            fail(position(node), key.path, fmt::format("is not a list of 1 to {} values", most),
                 write_instead(key));
        }
        std::vector<double> values;
        for (toml::node const& value : *list) {
            values.push_back(key.kind == KeyKind::quantities ? read_quantity(key, value)
                                                             : read_plain(key, value));
            if (!(values.back() > 0 && values.back() >= key.least && values.back() <= key.most)) {
                fail(position(value), key.path, fmt::format("{} is out of range", written(value)),
                     fmt::format("{}, in the range {}", write_instead(key), key.range));
            }
        }
        return values;
    }

    std::vector<std::string> read_words(Key const& key, toml::node const& node) const {
        toml::array const* const list = node.as_array();
        std::vector<std::string> words;
        if (list != nullptr) {
            for (toml::node const& value : *list) words.push_back(value.value<std::string>().value_or(""));
        }
        if (words.empty() || words.size() > 30) {
            fail(position(node), key.path, "is not a list of 1 to 30 texts", write_instead(key));
        }
        return words;
    }

    double read_number(Key const& key, toml::node const& node) const {
        double const value = key.kind == KeyKind::quantity ? read_quantity(key, node) : read_plain(key, node);
        if (!(value >= key.least && value <= key.most)) {
            fail(position(node), key.path, fmt::format("{} is out of range", written(node)),
                 fmt::format("{}, in the range {}", write_instead(key), key.range));
        }
        return value;
    }

    double read_quantity(Key const& key, toml::node const& node) const {
        if (node.is_number()) {
            fail(position(node), key.path, fmt::format("the bare number {} has no unit", written(node)),
                 write_instead(key));
        }
        if (!node.is_string())
            fail(position(node), key.path, "is not a text with a number and a unit", write_instead(key));
        try {
            return core::parse_quantity(**node.as_string(), std::string(key.unit));
        } catch (core::QuantityError const& error) {
            fail(position(node), key.path, core::printable(error.what(), 300), write_instead(key));
        }
    }

    double read_plain(Key const& key, toml::node const& node) const {
        if (node.is_string()) {
            fail(position(node), key.path,
                 fmt::format("{} is a text where a plain number belongs", written(node)), write_instead(key));
        }
        if (key.kind == KeyKind::integer && !node.is_integer()) {
            fail(position(node), key.path, fmt::format("{} is not a whole number", written(node)),
                 write_instead(key));
        }
        if (!node.is_number()) fail(position(node), key.path, "is not a number", write_instead(key));
        return *node.value<double>();
    }

    static std::string written(toml::node const& node) {
        if (auto const* text = node.as_string()) return fmt::format("'{}'", core::printable(text->get(), 60));
        if (auto const* whole = node.as_integer()) return std::to_string(whole->get());
        if (auto const* number = node.as_floating_point()) return fmt::format("{}", number->get());
        return "this value";
    }

    /// A swept key may stand in quotes ("trough.friction" = ...) or, dotted, without (trough.friction = ...).
    void read_sweep_entry(toml::key const& name, toml::node const& node) {
        if (!is_section(name.str()) || !node.is_table()) {
            read_axis(std::string(name.str()), position(name.source()), node);
            return;
        }
        for (auto const& [key, value] : in_file_order(*node.as_table())) {
            read_axis(fmt::format("{}.{}", name.str(), key->str()), position(key->source()), *value);
        }
    }

    void read_axis(std::string const& path, Position where, toml::node const& node) {
        Key const& key = known_key(path, where);
        if (key.kind == KeyKind::name) fail(where, path, "a name cannot be swept", "sweep a physical input");
        if (key.kind == KeyKind::quantities || key.kind == KeyKind::numbers ||
            key.kind == KeyKind::harmonics) {
            fail(where, path, "a list cannot be swept", "sweep a key with one value");
        }
        for (Axis const& other : result_.sweep) {
            if (other.key == path) fail(where, path, "is swept twice", "keep one of the two");
            if (!key.group.empty() && find_key(other.key)->group == key.group) {
                fail(where, path,
                     fmt::format("{} is swept as well, and each sets the {}", other.key, key.group),
                     "keep one of the two");
            }
        }
        Axis axis{path, {}, where};
        if (auto const* list = node.as_array()) {
            for (toml::node const& value : *list) axis.values.push_back(read_content(key, value));
        } else if (auto const* range = node.as_table()) {
            for (double const value : read_range(key, *range, where)) axis.values.emplace_back(value);
        }
        check_axis(axis);
        result_.sweep.push_back(std::move(axis));
    }

    void check_axis(Axis const& axis) const {
        if (axis.values.empty()) {
            fail(axis.where, axis.key, "has no values to sweep over",
                 "write a list [a, b] or { from = a, to = b, step = c }");
        }
        if (std::set<Content>(axis.values.begin(), axis.values.end()).size() != axis.values.size()) {
            fail(axis.where, axis.key, "a value stands in the list twice", "list each value once");
        }
    }

    std::vector<double> read_range(Key const& key, toml::table const& range, Position where) const {
        if (key.kind == KeyKind::choice || key.kind == KeyKind::file)
            fail(where, key.path, "words make no range", "write a list [a, b]");
        for (auto const& [name, node] : range) {
            if (name.str() != "from" && name.str() != "to" && name.str() != "step") {
                fail(position(name.source()), key.path,
                     fmt::format("'{}' is not part of a range", core::printable(name.str(), 60)),
                     "write { from = a, to = b, step = c }");
            }
        }
        auto const part = [&](char const* name) {
            toml::node const* const node = range.get(name);
            if (node == nullptr)
                fail(where, key.path, fmt::format("the range has no '{}'", name),
                     "write { from = a, to = b, step = c }");
            // The step is a difference: it has the key's unit, not its range.
            return key.kind == KeyKind::quantity ? read_quantity(key, *node) : read_plain(key, *node);
        };
        double const from = part("from"), to = part("to"), step = part("step");
        double const steps = (to - from) / step;
        if (!(step > 0) || !(steps >= 0) || steps > 1e5) {
            fail(where, key.path, "the range does not lead from 'from' to 'to' in at most 100000 steps",
                 "write { from = a, to = b, step = c } with a <= b and c > 0");
        }
        std::vector<double> values;
        for (int i = 0; i <= static_cast<int>(steps + 1e-9); ++i) {
            // 12 digits: 0.6 + 2 * 0.4 is meant to be 1.4.
            values.push_back(std::stod(fmt::format("{:.12g}", from + i * step)));
        }
        for (double const value : {values.front(), values.back()}) {
            if (value < key.least || value > key.most) {
                fail(where, key.path, fmt::format("{} is out of range", value),
                     fmt::format("stay within {}", key.range));
            }
        }
        return values;
    }

    bool given(std::string_view path) const {
        return (path == "campaign.name" && !result_.name.empty()) || result_.base.contains(path) ||
               std::ranges::any_of(result_.sweep, [&](Axis const& axis) { return axis.key == path; }) ||
               std::ranges::any_of(result_.lists, [&](PointList const& list) {
                   return std::ranges::find(list.keys, path) != list.keys.end();
               });
    }

    void check_present(Key const& key) const {
        if (is_optional(key) || given(key.path)) return;
        std::vector<std::string_view> names{name_of(key.path)};
        for (Key const& other : all_keys()) {
            if (key.group.empty() || other.group != key.group || other.path == key.path) continue;
            if (given(other.path)) return;
            names.push_back(name_of(other.path));
        }
        std::string const section(key.path.substr(0, key.path.find('.')));
        auto const found = sections_.find(section);
        Position const where = found == sections_.end() ? Position{} : found->second;
        std::string wrong =
            found == sections_.end() ? fmt::format("the section [{}] is missing", section) : "is missing";
        if (names.size() > 1) wrong += fmt::format(" (exactly one of {} is needed)", fmt::join(names, ", "));
        fail(where, key.path, wrong, fmt::format("{} under [{}]", write_instead(key), section));
    }

    std::string const& file_;
    toml::table root_;
    CampaignText result_;
    std::map<std::string, Position> sections_;
};

}  // namespace

CampaignText read_campaign_text(std::string_view text, std::string const& file) {
    return Reader(text, file).read();
}

}  // namespace vibrotrough::scenario
