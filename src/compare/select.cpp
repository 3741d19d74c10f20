#include "compare/select.hpp"

#include "compare/columns.hpp"
#include "core/error.hpp"
#include "core/text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include <fmt/format.h>

namespace vibrotrough::compare {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t longest_shown = 60;
constexpr std::string_view difference_column = "difference";

Json value_of(Row const& row, std::string const& column) {
    if (column == difference_column) {
        auto const value = difference(row);
        return value ? Json(*value) : Json(nullptr);
    }
    return to_object(row).at(column);
}

/// @throws InputError naming the option and all columns when there is no such one
std::string known_column(std::string_view option, std::string_view name) {
    std::string names;
    Json const columns = to_object(Row{});
    for (auto const& [column, value] : columns.items()) names += column + ", ";
    names += difference_column;
    if (columns.contains(name) || name == difference_column) return std::string(name);
    throw core::InputError(fmt::format("{}: there is no column '{}'; the columns are {}", option,
                                       core::printable(name, longest_shown), names));
}

std::string_view trimmed(std::string_view text) {
    auto const first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
    return first == std::string_view::npos ? std::string_view{} : text.substr(first, last - first + 1);
}

enum class Relation { less, less_or_equal, greater, greater_or_equal, equal, different };

struct Condition {
    std::string column;
    Relation relation;
    Json value;
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

Json number_in(std::string_view text, std::string_view condition) {
    double number = 0;
    auto const [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (failure != std::errc{} || end != text.data() + text.size() || !std::isfinite(number)) {
        throw core::InputError(
            fmt::format("--filter '{}': '{}' is no number; write e.g. --filter 'throw_number>1.5'",
                        core::printable(condition, longest_shown), core::printable(text, longest_shown)));
    }
    return number;
}

Condition parse(std::string_view text) {
    std::string_view constexpr signs = "<>=!";
    std::size_t const at = text.find_first_of(signs);
    std::size_t const value_at = at == text.npos ? at : text.find_first_not_of(signs, at);
    auto const relation = at == text.npos ? std::nullopt : relation_of(text.substr(at, value_at - at));
    if (!relation || value_at == text.npos) {
        throw core::InputError(
            fmt::format("--filter '{}' is no condition; write a column, one of > >= < <= = !=, and a "
                        "value, e.g. 'throw_number>1.5'",
                        core::printable(text, longest_shown)));
    }
    std::string_view const value = trimmed(text.substr(value_at));
    Condition condition{known_column("--filter", trimmed(text.substr(0, at))), *relation, nullptr};
    if (!is_text_column(condition.column)) {
        condition.value = number_in(value, text);
    } else if (*relation == Relation::equal || *relation == Relation::different) {
        condition.value = std::string(value);
    } else {
        throw core::InputError(fmt::format("--filter '{}': '{}' is a text; compare it with = or !=",
                                           core::printable(text, longest_shown), condition.column));
    }
    return condition;
}

bool holds(Condition const& condition, Row const& row) {
    Json const value = value_of(row, condition.column);
    if (value.is_null()) return false;
    switch (condition.relation) {
        case Relation::less:
            return value < condition.value;
        case Relation::less_or_equal:
            return value <= condition.value;
        case Relation::greater:
            return value > condition.value;
        case Relation::greater_or_equal:
            return value >= condition.value;
        case Relation::equal:
            return value == condition.value;
        case Relation::different:
            return value != condition.value;
    }
    return false;
}

}  // namespace

bool is_text_column(std::string_view column) {
    return column == "case" || column == "outcome" || column.starts_with("mode_");
}

std::vector<Row> filtered(std::vector<Row> const& rows, std::string_view condition) {
    Condition const wanted = parse(condition);
    std::vector<Row> kept;
    std::ranges::copy_if(rows, std::back_inserter(kept), [&](Row const& row) { return holds(wanted, row); });
    return kept;
}

std::vector<Row> sorted(std::vector<Row> rows, std::string_view key) {
    std::size_t const colon = key.find(':');
    std::string const column = known_column("--sort", key.substr(0, colon));
    std::string_view const order = colon == key.npos ? "asc" : key.substr(colon + 1);
    if (order != "asc" && order != "desc") {
        throw core::InputError(
            fmt::format("--sort '{}': the order '{}' is neither asc nor desc; write e.g. --sort {}:desc",
                        core::printable(key, longest_shown), core::printable(order, longest_shown), column));
    }
    std::ranges::stable_sort(rows, [&](Row const& a, Row const& b) {
        Json const left = value_of(a, column), right = value_of(b, column);
        if (left.is_null() || right.is_null()) return !left.is_null() && right.is_null();
        return order == "asc" ? left < right : right < left;
    });
    return rows;
}

}  // namespace vibrotrough::compare
