#include "scenario/reader/file_reader.hpp"

#include "core/error.hpp"
#include "core/nearest.hpp"
#include "core/quantity.hpp"
#include "scenario/reader/cannot.hpp"
#include "scenario/reader/design_reader.hpp"
#include "scenario/reader/run_section.hpp"
#include "scenario/reader/swept_keys.hpp"
#include "scenario/reader/value_reader.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <toml++/toml.h>

namespace vibrotrough::scenario {
namespace {

/// The entries of a table in the order of the file. toml++ sorts them by name, but users expect cases and
/// errors in the order in which they wrote them.
std::vector<std::pair<toml::key const*, toml::node const*>> in_file_order(toml::table const& table) {
    std::vector<std::pair<toml::key const*, toml::node const*>> entries;
    for (auto const& [key, node] : table) entries.emplace_back(&key, &node);
    std::ranges::sort(entries, {}, [](auto const& entry) {
        Position const where = position_of(entry.first->source());
        return std::pair(where.line, where.column);
    });
    return entries;
}

constexpr std::string_view key_advice = "see 'vibrotrough keys' for all keys";

/// Reads a campaign file.
class CampaignFileReader {
  public:
    CampaignFileReader(std::string_view text, std::string const& file) : file_(file) {
        try {
            root_ = toml::parse(text, file_);
        } catch (toml::parse_error const& error) {
            fail(position_of(error.source()), "TOML", error.description().substr(0, 300),
                 "write key = value lines under [section] headings, and quantities in quotes");
        }
    }

    CampaignText read() {
        for (auto const& [name, node] : in_file_order(root_))
            attempt([&, &name = name, &node = node] { read_section(*name, *node); });
        attempt([&] { check_design(result_, file_); });
        if (problems_.empty()) check_all_present();
        if (!problems_.empty()) throw core::InputError(all_problems());
        return std::move(result_);
    }

  private:
    [[noreturn]] void fail(Position where, std::string_view key, std::string_view wrong,
                           std::string_view instead) const {
        throw_at({file_, where}, key, wrong, instead);
    }

    /// Does `step`, and keeps what it finds wrong until the whole file is read, so that a person sees all
    /// mistakes at once.
    template <typename Step>
    void attempt(Step const& step) {
        try {
            step();
        } catch (core::InputError const& error) {
            problems_.emplace_back(error.what());
        }
    }

    /// A line for each problem, ten at most.
    std::vector<std::string> all_problems() const {
        constexpr std::size_t most = 10;
        std::vector<std::string> lines = problems_;
        if (lines.size() > most) {
            lines.resize(most);
            lines.push_back(
                fmt::format("{}: {} more mistakes follow; mend these first", file_, problems_.size() - most));
        }
        return lines;
    }

    static bool is_section(std::string_view name) {
        return std::ranges::any_of(all_keys(), [&](Key const& key) { return section_of(key) == name; });
    }

    static std::vector<std::string_view> sections_of_keys() {
        std::vector<std::string_view> names;
        for (Key const& key : all_keys()) {
            std::string_view const name = key.path.substr(0, key.path.find('.'));
            if (names.empty() || names.back() != name) names.push_back(name);
        }
        return names;
    }

    static std::string_view nearest_section(std::string_view name) {
        auto const names = sections_of_keys();
        return core::nearest_word(name, names);
    }

    void read_section(toml::key const& name, toml::node const& node) {
        Position const where = position_of(name.source());
        if (name.str() == "run" && node.is_table()) {
            result_.run = read_run_section(*node.as_table(), file_);
            return;
        }
        if (is_design_section(name.str())) {
            read_design_section(name.str(), node, file_, result_);
            return;
        }
        if (is_list_section(name.str())) {
            read_list(name.str(), where, node);
            return;
        }
        if (!is_section(name.str()) && name.str() != "sweep" && !node.is_table()) {
            fail(where, name.str(), "is written above the first [section]",
                 "move it below its section's heading");
        }
        if (!is_section(name.str()) && name.str() != "sweep") {
            if (Cannot const* cannot = cannot_simulate(name.str()))
                fail(where, name.str(), cannot->wrong,
                     fmt::format("{} (src/manual/scope.md says what can be simulated)", cannot->instead));
            std::string_view const near = nearest_section(name.str());
            if (!near.empty())
                fail(where, name.str(), "unknown section", fmt::format("did you mean [{}]?", near));
            fail(where, name.str(), "unknown section",
                 fmt::format("the sections are {}, sweep, zip, points, points_from, sample, domain, exclude "
                             "and run",
                             fmt::join(sections_of_keys(), ", ")));
        }
        if (!node.is_table()) {
            fail(where, name.str(), "is a section, not a key",
                 fmt::format("write [{}] on a line of its own", name.str()));
        }
        sections_[std::string(name.str())] = where;
        for (auto const& [key, value] : in_file_order(*node.as_table())) {
            std::string const path = fmt::format("{}.{}", name.str(), key->str());
            attempt([&, &key = key, &value = value] {
                if (name.str() == "sweep") {
                    read_sweep_entry(*key, *value);
                } else {
                    read_key(path, position_of(key->source()), *value);
                }
            });
        }
    }

    /// The entries of a list such as [[materials]]; the first one's keys are "materials.1.name" and so on.
    void read_list(std::string_view section, Position where, toml::node const& node) {
        std::size_t const most = most_entries(section);
        toml::array const* const list = node.as_array();
        if (list == nullptr || !std::ranges::all_of(*list, [](toml::node const& e) { return e.is_table(); }))
            fail(where, section, "is a list of tables",
                 fmt::format("write [[{}]] above each entry", section));
        if (list->size() > most)
            fail(where, section, fmt::format("has {} entries, more than {}", list->size(), most),
                 "leave out the others");
        for (std::size_t i = 0; i < list->size(); ++i) {
            if ((*list)[i].as_table()->empty())
                fail(position_of((*list)[i].source()), section, fmt::format("number {} is empty", i + 1),
                     "remove it");
            for (auto const& [key, value] : in_file_order(*(*list)[i].as_table())) {
                std::string const path = fmt::format("{}.{}.{}", section, i + 1, key->str());
                attempt(
                    [&, &key = key, &value = value] { read_key(path, position_of(key->source()), *value); });
            }
        }
    }

    void read_key(std::string const& path, Position where, toml::node const& node) {
        Key const& key = known_key(path, {file_, where}, key_advice);
        if (!key.group.empty()) {
            for (auto const& [other, value] : result_.base) {
                if (find_key(other)->group != key.group) continue;
                fail(where, path,
                     fmt::format("{} is also given, on line {}, and both set the {}", other, value.where.line,
                                 key.group),
                     "keep one of the two");
            }
        }
        if (key.kind == KeyKind::name) {
            read_name(key, where, node);
        } else {
            Content const content = read_content(key, node, file_);
            result_.base[key.path] = {content, where, unit_of(key, node)};
        }
    }

    static std::string unit_of(Key const& key, toml::node const& node) {
        auto const* const text = node.as_string();
        return key.kind == KeyKind::quantity && text != nullptr ? core::unit_of(text->get()) : "";
    }

    void read_name(Key const& key, Position where, toml::node const& node) {
        std::string const name = node.value<std::string>().value_or("");
        if (!node.is_string() || name.empty() || name.size() > 100 || !is_plain_text(name) ||
            name.front() == '.' || name.front() == '-') {
            fail(where, key.path,
                 fmt::format("{} is not a valid name",
                             node.is_string() ? fmt::format("'{}'", name) : "a value that is not a text"),
                 fmt::format("{}: {}, beginning with a letter, a digit or '_'", write_instead(key),
                             range_of(key)));
        }
        if (key.path == "campaign.name") result_.name = name;
        result_.base[key.path] = {name, where};
    }

    /// A swept key may be written in quotes ("trough.friction" = ...) or as a dotted key (trough.friction =
    /// ...).
    void read_sweep_entry(toml::key const& name, toml::node const& node, std::string const& above = "") {
        std::string const path = above + std::string(name.str());
        bool const is_part =
            std::ranges::any_of(all_keys(), [&](Key const& key) { return key.path.starts_with(path + "."); });
        if (!is_part || !node.is_table()) {
            read_axis(path, position_of(name.source()), node);
            return;
        }
        for (auto const& [key, value] : in_file_order(*node.as_table())) {
            attempt([&, &key = key, &value = value] { read_sweep_entry(*key, *value, path + "."); });
        }
    }

    void read_axis(std::string const& path, Position where, toml::node const& node) {
        Key const& key = varied_key(path, {file_, where});
        Axis axis{path, {}, where};
        if (auto const* list = node.as_array()) {
            for (toml::node const& value : *list) {
                if (value.is_array()) fail(where, path, "a list cannot be swept", "sweep single values");
                axis.values.push_back(read_content(key, value, file_));
            }
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
            fail(axis.where, axis.key, "the list contains a value twice", "list each value once");
        }
    }

    std::vector<double> read_range(Key const& key, toml::table const& range, Position where) const {
        if (has_words(key)) fail(where, key.path, "is a word and cannot have a range", "write a list [a, b]");
        for (auto const& [name, node] : range) {
            if (name.str() != "from" && name.str() != "to" && name.str() != "step") {
                fail(position_of(name.source()), key.path,
                     fmt::format("'{}' is not part of a range", name.str()),
                     "write { from = a, to = b, step = c }");
            }
        }
        auto const part = [&](char const* name) {
            toml::node const* const node = range.get(name);
            if (node == nullptr)
                fail(where, key.path, fmt::format("the range has no '{}'", name),
                     "write { from = a, to = b, step = c }");
            // The step is a difference of two values: it has the unit of the key but may be outside its
            // range.
            return read_any_number(key, *node, file_);
        };
        double const from = part("from"), to = part("to"), step = part("step");
        double const steps = (to - from) / step;
        // An infinite step would give no number: 0 times infinity.
        if (!(step > 0) || !std::isfinite(step) || !(steps >= 0) || steps > 1e5) {
            fail(where, key.path, "'step' does not lead from 'from' to 'to' in at most 100000 steps",
                 "write { from = a, to = b, step = c } with a <= b and c > 0");
        }
        std::vector<double> values;
        for (int i = 0; i <= static_cast<int>(steps + 1e-9); ++i) {
            // Rounded to 12 digits, so that 0.6 + 2 * 0.4 gives 1.4 and not 1.4000000000000001.
            values.push_back(std::stod(fmt::format("{:.12g}", from + i * step)));
        }
        for (double const value : {values.front(), values.back()}) {
            if (!(value >= key.least && value <= key.most)) {
                fail(where, key.path, fmt::format("{} is out of range", written_value(key, value)),
                     fmt::format("stay within {}", range_of(key)));
            }
        }
        return values;
    }

    bool given(std::string_view path) const {
        return result_.base.contains(path) ||
               std::ranges::any_of(result_.sweep, [&](Axis const& axis) { return axis.key == path; }) ||
               std::ranges::any_of(result_.lists, [&](PointList const& list) {
                   return std::ranges::find(list.keys, path) != list.keys.end();
               });
    }

    /// Tells all keys that are missing, or the first section that is missing as a whole.
    void check_all_present() {
        std::set<std::string_view> told;  // groups, of which each key would say the same
        for (Key const& key : all_keys()) {
            if (!key.group.empty() && told.contains(key.group)) continue;
            std::size_t const before = problems_.size();
            attempt([&] { check_present(key); });
            if (problems_.size() == before) continue;
            told.insert(key.group);
            if (!sections_.contains(std::string(section_of(key)))) return;
        }
    }

    void check_present(Key const& key) const {
        if (is_optional(key) || given(key.path)) return;
        bool const is_in_record =
            key.group == "amplitude" || key.group == "vibration angle" || key.group == "speed of the drive";
        if (is_in_record && given("trough.waveform")) return;
        std::vector<std::string_view> names{last_name(key.path)};
        for (Key const& other : all_keys()) {
            if (key.group.empty() || other.group != key.group || other.path == key.path) continue;
            if (given(other.path)) return;
            names.push_back(section_of(other) == section_of(key) ? last_name(other.path) : other.path);
        }
        std::string const section(section_of(key));
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
    std::vector<std::string> problems_;
};

}  // namespace

CampaignText read_campaign_text(std::string_view text, std::string const& file) {
    return CampaignFileReader(text, file).read();
}

}  // namespace vibrotrough::scenario
