#include "app/json_list.hpp"

#include "core/csv.hpp"

#include <string>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::app {
namespace {

/// As text of several lines that are indented by so many blanks, but for the first.
std::string indented(nlohmann::ordered_json const& value, std::size_t blanks) {
    std::string const text = value.dump(2, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
    std::string result;
    for (char const c : text) {
        result += c;
        if (c == '\n') result.append(blanks, ' ');
    }
    return result;
}

}  // namespace

nlohmann::ordered_json number_or_null(std::optional<double> const& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

void print_csv(std::vector<nlohmann::ordered_json> const& rows) {
    auto const cell = [](nlohmann::ordered_json const& value) -> std::string {
        if (value.is_null()) return "";
        if (value.is_boolean()) return value.get<bool>() ? "1" : "0";
        if (value.is_number()) return value.dump();
        if (value.is_string()) return core::csv_cell(value.get<std::string>());
        std::vector<std::string> words;
        for (auto const& one : value) words.push_back(one.get<std::string>());
        return core::csv_cell(fmt::format("{}", fmt::join(words, " ")));
    };
    std::vector<std::string> line;
    for (auto const& [name, value] : rows.front().items()) line.push_back(name);
    fmt::print("{}\n", fmt::join(line, ","));
    for (auto const& row : rows) {
        line.clear();
        for (auto const& [name, value] : row.items()) line.push_back(cell(value));
        fmt::print("{}\n", fmt::join(line, ","));
    }
}

void print_with_list(nlohmann::ordered_json const& head, std::size_t count,
                     std::function<nlohmann::ordered_json(std::size_t i)> const& element) {
    std::string_view const end = "]\n}";
    std::string const all = indented(head, 0);
    fmt::print("{}", all.substr(0, all.size() - end.size()));
    for (std::size_t i = 0; i < count; ++i)
        fmt::print("{}\n    {}", i == 0 ? "" : ",", indented(element(i), 4));
    fmt::print("{}{}\n", count == 0 ? "" : "\n  ", end);
}

}  // namespace vibrotrough::app
