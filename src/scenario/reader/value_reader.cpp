#include "scenario/reader/value_reader.hpp"

#include "core/csv.hpp"
#include "core/error.hpp"
#include "core/quantity.hpp"
#include "core/typed_unit.hpp"
#include "scenario/model/run_settings.hpp"
#include "scenario/reader/cannot.hpp"
#include "theory/unusual.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <regex>

#include <fmt/format.h>

namespace vibrotrough::scenario {
namespace {

/// With the page that has the whole list.
std::string scope_advice(Cannot const& cannot) {
    return fmt::format("{} (src/manual/scope.md says what can be simulated)", cannot.instead);
}

/// Reads the value of one key.
class ValueReader {
  public:
    ValueReader(Key const& key, std::string const& file) : key_(key), file_(file) {}

    std::string word(toml::node const& node) const {
        std::string const word = node.value<std::string>().value_or("");
        auto const known = choices(key_);
        if (node.is_string() && std::ranges::find(known, word) != known.end()) return word;
        bool const is_file = key_.kind == KeyKind::file || key_.kind == KeyKind::files;
        if (is_file && node.is_string() && is_file_name(word)) return word;
        if (Cannot const* cannot = cannot_simulate(word)) fail(node, cannot->wrong, scope_advice(*cannot));
        bool const are_files = key_.kind == KeyKind::file && node.is_array();
        fail(node,
             are_files ? "is one file, and a list is given"
                       : fmt::format("{} is not an allowed value", written(node)),
             fmt::format("{}; allowed: {}", write_meant(word), range_of(key_)));
    }

    std::string name(toml::node const& node) const {
        if (!node.is_string()) fail(node, "is not a text", write_instead(key_));
        return **node.as_string();
    }

    std::vector<std::string> words(toml::node const& node) const {
        toml::array const* const list = node.as_array();
        std::vector<std::string> words;
        if (list != nullptr) {
            for (toml::node const& value : *list) words.push_back(value.value<std::string>().value_or(""));
        }
        if (words.empty() || words.size() > 30)
            fail(node, "is not a list of 1 to 30 texts", write_instead(key_));
        return words;
    }

    std::vector<std::string> file_names(toml::node const& node) const {
        std::vector<std::string> names = words(node);
        for (toml::node const& value : *node.as_array()) word(value);
        return names;
    }

    double number(toml::node const& node) const {
        double const value = any_number(node);
        if (!(value >= key_.least && value <= key_.most)) fail_range(node);
        return value;
    }

    std::vector<double> numbers(toml::node const& node) const {
        constexpr std::size_t most = 100;
        toml::array const* const list = node.as_array();
        if (list == nullptr || list->empty() || list->size() > most)
            fail(node, fmt::format("is not a list of 1 to {} values", most), write_instead(key_));
        std::vector<double> values;
        for (toml::node const& value : *list) {
            values.push_back(any_number(value));
            if (!(values.back() > 0 && values.back() >= key_.least && values.back() <= key_.most))
                fail_range(value);
        }
        return values;
    }

    /// The numbers of packings in order, or the word "all".
    Content packings(toml::node const& node) const {
        if (node.is_string()) {
            if (node.value<std::string>() == "all") return std::string("all");
            fail(node, fmt::format("{} is neither a list nor the word 'all'", written(node)),
                 write_instead(key_));
        }
        std::vector<double> list = numbers(node);
        for (toml::node const& value : *node.as_array()) {
            if (!value.is_integer())
                fail(value, fmt::format("{} is not a whole number", written(value)), write_instead(key_));
        }
        std::ranges::sort(list);
        if (std::ranges::adjacent_find(list) != list.end())
            fail(node, "has a packing twice", write_instead(key_));
        return list;
    }

    /// 1 for true, 0 for false.
    double truth(toml::node const& node) const {
        std::optional<bool> const given = node.is_boolean() ? node.value<bool>() : std::nullopt;
        if (!given)
            fail(node, fmt::format("{} is neither true nor false", written(node)), write_instead(key_));
        return *given ? 1 : 0;
    }

    /// A mass flow, or grains per time, which are kept as they are written: what they weigh is known when all
    /// keys are.
    Content flow(toml::node const& node) const {
        std::string const text = node.value<std::string>().value_or("");
        if (node.is_string() && grains_per_second(text)) return text;
        return number(node);
    }

    double any_number(toml::node const& node) const {
        return has_unit() ? quantity(node) : plain_number(node);
    }

  private:
    bool has_unit() const { return key_.kind == KeyKind::quantity || key_.kind == KeyKind::quantities; }

    [[noreturn]] void fail(toml::node const& node, std::string_view wrong, std::string_view instead) const {
        throw_at({file_, position_of(node.source())}, key_.path, wrong, instead);
    }

    [[noreturn]] void fail_range(toml::node const& node) const {
        std::string slip, range = range_of(key_);
        if (node.is_string() && has_unit()) {
            std::string const text = **node.as_string(), unit(key_.unit);
            slip = core::slip_of_unit(text, key_.least, key_.most, unit);
            range = core::range_in_unit_of(text, key_.least, key_.most, unit);
        } else if (node.is_number()) {
            slip = slip_of(*node.value<double>());
        }
        fail(node, fmt::format("{} is out of range{}", written(node), slip),
             fmt::format("{}, in the range {}", write_instead(key_), range));
    }

    /// Of a plain number, which slip would explain it.
    std::string slip_of(double value) const {
        std::string_view const name = last_name(key_.path);
        std::string slip;
        if (name.ends_with("friction")) slip = theory::slip_of_friction(value);
        if (name.starts_with("tan_")) slip = theory::slip_of_tangent(value);
        return slip.empty() ? "" : fmt::format(" ({})", slip);
    }

    /// The allowed word that is the same unit, "inch" for "in"; otherwise the example of the key.
    std::string write_meant(std::string const& word) const {
        for (std::string_view const unit : choices(key_))
            if (are_same_length(word, std::string(unit)))
                return fmt::format("write {} = \"{}\"", last_name(key_.path), unit);
        return write_instead(key_);
    }

    static bool are_same_length(std::string const& one, std::string const& other) {
        try {
            return core::parse_quantity("1 " + one, "m") == core::parse_quantity("1 " + other, "m");
        } catch (core::QuantityError const&) {
            return false;
        }
    }

    /// The file lies in the folder of the campaign file, and its name is harmless to engine and shell.
    bool is_file_name(std::string_view name) const {
        std::string_view const ending = key_.allowed.ending;
        return is_plain_text(name) && name.size() > ending.size() && name.size() <= 100 &&
               lower(name.substr(name.size() - ending.size())) == ending && name.front() != '.' &&
               name.front() != '-';
    }

    static std::string lower(std::string_view text) {
        std::string word(text);
        for (char& c : word) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 'a' - 'A') : c;
        return word;
    }

    /// The value as the user wrote it, for a message.
    static std::string written(toml::node const& node) {
        if (auto const* text = node.as_string()) return fmt::format("'{}'", text->get());
        if (auto const* whole = node.as_integer()) return std::to_string(whole->get());
        if (auto const* number = node.as_floating_point()) return fmt::format("{}", number->get());
        return "this value";
    }

    double quantity(toml::node const& node) const {
        if (node.is_number())
            fail(node, fmt::format("the number {} has no unit", written(node)), write_instead(key_));
        if (!node.is_string()) fail(node, "is not a text with a number and a unit", write_instead(key_));
        try {
            return core::parse_quantity(**node.as_string(), std::string(key_.unit));
        } catch (core::QuantityError const& error) {
            fail_as_told(node, error);
        }
    }

    /// What is wrong with a number, with its own advice where it has one.
    [[noreturn]] void fail_as_told(toml::node const& node, core::QuantityError const& error) const {
        fail(node, error.problem(), error.advice().empty() ? write_instead(key_) : error.advice());
    }

    double plain_number(toml::node const& node) const {
        if (node.is_string()) return number_in_text(node);
        if (key_.kind == KeyKind::integer && !node.is_integer())
            fail(node, fmt::format("{} is not a whole number", written(node)), write_instead(key_));
        if (!node.is_number()) fail(node, "is not a number", write_instead(key_));
        return *node.value<double>() +
               0.0;  // -0 becomes 0: it would be written as "-0" and read as another text
    }

    /// "30 %" is 0.3, as on the command line; any other text is a slip.
    double number_in_text(toml::node const& node) const {
        std::string const text = **node.as_string();
        std::optional<double> number;
        try {
            number = core::parse_number(text);
        } catch (core::QuantityError const& error) {
            if (!error.advice().empty()) fail_as_told(node, error);
        }
        if (number && text.find('%') != text.npos && key_.kind != KeyKind::integer) return *number;
        fail(node, fmt::format("{} is a text, but the key needs a plain number", written(node)),
             number ? fmt::format("write {} = {} without quotes", last_name(key_.path), *number)
                    : write_instead(key_));
    }

    Key const& key_;
    std::string const& file_;
};

}  // namespace

Position position_of(toml::source_region const& source) {
    return {std::max(1u, source.begin.line), std::max(1u, source.begin.column)};
}

Key const& known_key(std::string_view path, FilePosition place, std::string_view advice) {
    if (Key const* key = find_key(path)) return *key;
    if (Cannot const* cannot = cannot_simulate(path))
        throw_at(place, path, cannot->wrong, scope_advice(*cannot));
    std::string_view const nearest = nearest_key(path);
    throw_at(place, path, "unknown key",
             nearest.empty() ? std::string(advice) : fmt::format("did you mean {}?", nearest));
}

Key const& varied_key(std::string_view path, FilePosition place) {
    constexpr std::string_view advice = "vary a physical input";
    Key const& key = known_key(path, place, advice);
    if (!can_vary(key)) throw_at(place, path, "this key cannot be varied", advice);
    return key;
}

std::optional<double> grains_per_second(std::string const& text) {
    static std::regex const grains(R"(grains?(?= ?/| per ))");
    try {
        return core::parse_quantity(std::regex_replace(text, grains, "1"), "1/s");
    } catch (core::QuantityError const&) {
        return {};
    }
}

Content read_content(Key const& key, toml::node const& node, std::string const& file) {
    ValueReader const reader(key, file);
    switch (key.kind) {
        case KeyKind::choice:
        case KeyKind::file:
            return reader.word(node);
        case KeyKind::files:
            return node.is_array() ? Content(reader.file_names(node)) : Content(reader.word(node));
        case KeyKind::name:
            return reader.name(node);
        case KeyKind::quantities:
        case KeyKind::numbers:
            return reader.numbers(node);
        case KeyKind::texts:
            return reader.words(node);
        case KeyKind::truth:
            return reader.truth(node);
        case KeyKind::packings:
            return reader.packings(node);
        default:
            return key.unit == "kg/s" ? reader.flow(node) : reader.number(node);
    }
}

Content read_plain_content(Key const& key, std::string const& text) {
    // Infinities pass here: the check of the key's range refuses them with better advice.
    std::optional<double> const number = core::csv_number(text, ',', core::CsvNumbers::any);
    bool const is_whole = number && std::abs(*number) < 1e15 && *number == std::round(*number);
    if (key.kind == KeyKind::integer && is_whole)
        return read_content(key, toml::value<std::int64_t>(std::llround(*number)), "");
    if (number && !has_words(key)) return read_content(key, toml::value<double>(*number), "");
    return read_content(key, toml::value<std::string>(text), "");
}

double read_any_number(Key const& key, toml::node const& node, std::string const& file) {
    return ValueReader(key, file).any_number(node);
}

}  // namespace vibrotrough::scenario
