#include "compare/select.hpp"

#include "core/error.hpp"
#include "core/nearest.hpp"
#include "store/reference.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <compare>
#include <functional>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::compare {
namespace {

/// Orders two values of one column, or a value of a column of numbers and another number.
std::partial_ordering order(Value const& left, Value const& right) {
    auto const number = [](Value const& value) {
        auto const* const integer = std::get_if<int>(&value);
        return integer != nullptr ? *integer : std::get<double>(value);
    };
    if (std::holds_alternative<std::string>(left))
        return std::get<std::string>(left) <=> std::get<std::string>(right);
    return number(left) <=> number(right);
}

std::string_view trimmed(std::string_view text) {
    auto const first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
    return first == std::string_view::npos ? std::string_view{} : text.substr(first, last - first + 1);
}

enum class Relation { less, less_or_equal, greater, greater_or_equal, equal, different };

struct Condition {
    Column const& column;
    Relation relation;
    Value value;
};

std::optional<Relation> relation_of(std::string_view symbol) {
    constexpr std::array<std::pair<std::string_view, Relation>, 7> symbols{
        {{"<", Relation::less},
         {"<=", Relation::less_or_equal},
         {">", Relation::greater},
         {">=", Relation::greater_or_equal},
         {"=", Relation::equal},
         {"==", Relation::equal},
         {"!=", Relation::different}}};
    for (auto const& [text, relation] : symbols) {
        if (text == symbol) return relation;
    }
    return {};
}

double number_in(std::string_view text, std::string_view condition) {
    double number = 0;
    auto const [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (failure != std::errc{} || end != text.data() + text.size() || !std::isfinite(number)) {
        throw core::InputError(
            fmt::format("--filter '{}': '{}' is not a number; write for example --filter 'throw_number>1.5'",
                        condition, text));
    }
    return number;
}

/// The key of a column without its section.
std::string_view short_key(Column const& column) {
    return std::string_view(column.key).substr(column.key.find('.') + 1);
}

/// Whether the tables print a column below this heading.
bool is_headed(Column const& column, std::string_view heading) {
    auto const& terminal = column.terminal;
    return (terminal && (terminal->heading == heading ||
                         fmt::format("{} {}", terminal->heading, terminal->subheading) == heading)) ||
           (column.report && column.report->heading == heading);
}

Condition parse(std::string_view text, std::span<Column const> columns) {
    std::string_view constexpr signs = "<>=!";
    std::size_t const at = text.find_first_of(signs);
    std::size_t const value_at = at == text.npos ? at : text.find_first_not_of(signs, at);
    auto const relation = at == text.npos ? std::nullopt : relation_of(text.substr(at, value_at - at));
    if (!relation || value_at == text.npos) {
        throw core::InputError(
            fmt::format("--filter '{}' is not a condition; write a column, one of > >= < <= = !=, and a "
                        "value, for example 'throw_number>1.5'",
                        text));
    }
    std::string_view const value = trimmed(text.substr(value_at));
    std::string_view const name = trimmed(text.substr(0, at));
    Column const& column = column_named(columns, "--filter", name);
    // A heading stands above numbers in the unit that the table shows.
    bool const is_by_heading = column.name != name && short_key(column) != name && is_headed(column, name);
    if (column.type() != ColumnType::text)
        return {column, *relation, number_in(value, text) / (is_by_heading ? column.factor : 1)};
    if (*relation == Relation::equal || *relation == Relation::different)
        return {column, *relation, std::string(value)};
    throw core::InputError(
        fmt::format("--filter '{}': '{}' is a text; compare it with = or !=", text, column.name));
}

bool holds(Condition const& condition, Row const& row) {
    auto const value = condition.column.of(row);
    if (!value) return false;
    std::partial_ordering const found = order(*value, condition.value);
    switch (condition.relation) {
        case Relation::less:
            return found < 0;
        case Relation::less_or_equal:
            return found <= 0;
        case Relation::greater:
            return found > 0;
        case Relation::greater_or_equal:
            return found >= 0;
        case Relation::equal:
            return found == 0;
        case Relation::different:
            return found != 0;
    }
    return false;
}

/// What to write instead of a name that no column has, or the heading of several ones.
std::string advice_of(std::span<Column const> columns, std::string_view name) {
    std::vector<std::string_view> names{"speed"}, headed;  // an older name, and a common word
    for (Column const& column : columns) {
        if (is_headed(column, name)) headed.push_back(column.name);
        std::string const unit = column.unit == "1" ? "" : unit_suffix(column.unit);
        std::string_view const column_name = column.name;
        names.push_back(column_name);
        if (column_name.ends_with(unit))
            names.push_back(column_name.substr(0, column_name.size() - unit.size()));
    }
    if (headed.size() > 1) return fmt::format("it is a heading of {}", fmt::join(headed, " and "));
    if (auto const nearest = core::nearest_word(name, names); !nearest.empty())
        return fmt::format("did you mean {}?", nearest);
    return "'vibrotrough quantities' describes all";
}

}  // namespace

Column const& column_named(std::span<Column const> columns, std::string_view option, std::string_view name) {
    std::string_view const current = store::current_name(name);
    auto const is_named = [&](Column const& one) { return one.name == current; };
    auto const has_key = [&](Column const& one) { return !name.empty() && one.key == name; };
    auto const is_named_without_unit = [&](Column const& one) {
        return one.unit != "1" && one.name == fmt::format("{}{}", current, unit_suffix(one.unit));
    };
    for (auto const& fits :
         {std::function<bool(Column const&)>(is_named), {has_key}, {is_named_without_unit}}) {
        auto const found = std::ranges::find_if(columns, fits);
        if (found != columns.end()) return *found;
    }
    auto const is_short = [&](Column const& column) {
        return column.swept >= 0 && short_key(column) == name;
    };
    auto const is_headed_so = [&](Column const& column) { return is_headed(column, name); };
    for (auto const& fits : {std::function<bool(Column const&)>(is_short), {is_headed_so}})
        if (std::ranges::count_if(columns, fits) == 1) return *std::ranges::find_if(columns, fits);
    throw core::InputError(
        fmt::format("{}: there is no column '{}'; {}", option, name, advice_of(columns, name)));
}

std::vector<Row> filtered(std::vector<Row> const& rows, std::string_view condition,
                          std::span<Column const> columns) {
    Condition const wanted = parse(condition, columns);
    std::vector<Row> kept;
    std::ranges::copy_if(rows, std::back_inserter(kept), [&](Row const& row) { return holds(wanted, row); });
    return kept;
}

std::vector<Row> sorted(std::vector<Row> rows, std::string_view key, std::span<Column const> columns) {
    std::size_t const colon = key.find(':');
    Column const& column = column_named(columns, "--sort", key.substr(0, colon));
    std::string_view const direction = colon == key.npos ? "asc" : key.substr(colon + 1);
    if (direction != "asc" && direction != "desc") {
        throw core::InputError(fmt::format(
            "--sort '{}': the order '{}' is neither asc nor desc; write for example --sort {}:desc", key,
            direction, column.name));
    }
    std::ranges::stable_sort(rows, [&](Row const& a, Row const& b) {
        auto const left = column.of(a), right = column.of(b);
        if (!left || !right) return left && !right;
        return direction == "asc" ? order(*left, *right) < 0 : order(*right, *left) < 0;
    });
    return rows;
}

}  // namespace vibrotrough::compare
