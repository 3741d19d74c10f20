#include "compare/exports.hpp"

#include "core/csv.hpp"
#include "core/text.hpp"

#include <array>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::compare {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(std::optional<Value> const& value) {
    if (!value) return nullptr;
    return std::visit([](auto const& known) { return Json(known); }, *value);
}

std::string csv_field(std::optional<Value> const& value) {
    if (!value) return {};
    if (auto const* const text = std::get_if<std::string>(&*value)) {
        return core::csv_cell(core::harmless(*text));
    }
    return json_of(value).dump();
}

std::string_view name_of(ColumnType type) {
    constexpr std::array<std::string_view, 3> names{"number", "integer", "text"};
    return names.at(static_cast<std::size_t>(type));
}

/// The views that show a column. --filter and --sort take all columns.
std::string places_of(Column const& column) {
    std::string places;
    auto const add = [&places](bool there, std::string_view place) {
        if (there) places += (places.empty() ? "" : ", ") + std::string(place);
    };
    add(column.in_data, "data");
    add(column.terminal.has_value(), "terminal");
    add(column.report.has_value(), "report");
    return places;
}

}  // namespace

Json to_object(Row const& row, std::span<Column const> columns) {
    Json object = Json::object();
    for (Column const& column : columns)
        object.push_back({std::string(column.name), json_of(column.of(row))});
    return object;
}

Json swept_object(Row const& row, std::span<Column const> columns) {
    Json object = Json::object();
    for (Column const& column : columns) {
        if (column.swept >= 0) object.push_back({std::string(column.name), json_of(column.of(row))});
    }
    return object;
}

void write_json(std::vector<Row> const& rows, std::span<Column const> columns, TextSink const& sink) {
    // As the library writes a list of objects with an indent of 2, whose values are numbers and texts.
    std::vector<std::pair<std::string, Column const*>> shown;
    for (Column const& column : columns) {
        if (!column.in_data) continue;
        std::string const name = Json(column.name).dump();
        shown.emplace_back(fmt::format("{}\n    {}: ", shown.empty() ? "" : ",", name), &column);
    }
    char const* separator = "[\n  {";
    std::string text;
    for (Row const& row : rows) {
        text = separator;
        for (auto const& [before, column] : shown)
            text.append(before).append(
                json_of(column->of(row)).dump(-1, ' ', false, Json::error_handler_t::replace));
        sink(text += "\n  }");
        separator = ",\n  {";
    }
    sink(rows.empty() ? "[]\n" : "\n]\n");
}

std::string to_json(std::vector<Row> const& rows, std::span<Column const> columns) {
    std::string text;
    write_json(rows, columns, [&](std::string_view piece) { text += piece; });
    return text;
}

void write_csv(std::vector<Row> const& rows, std::span<Column const> columns, TextSink const& sink) {
    std::string text;
    auto const write_line = [&](auto const& field_of) {
        char const* separator = "";
        text.clear();
        for (Column const& column : columns) {
            if (!column.in_data) continue;
            text += separator + field_of(column);
            separator = ",";
        }
        text += "\n";
        sink(text);
    };
    write_line([](Column const& column) { return std::string(column.name); });
    for (Row const& row : rows) write_line([&](Column const& column) { return csv_field(column.of(row)); });
}

std::string to_csv(std::vector<Row> const& rows, std::span<Column const> columns) {
    std::string text;
    write_csv(rows, columns, [&](std::string_view piece) { text += piece; });
    return text;
}

Json column_descriptions(std::span<Column const> columns) {
    Json list = Json::array();
    for (Column const& column : columns) {
        Json one{{"name", column.name},       {"unit", column.unit}, {"type", name_of(column.type())},
                 {"meaning", column.meaning}, {"key", column.key},   {"report", nullptr}};
        if (column.report) {
            one["report"] = {{"heading", column.report->heading},
                             {"format", column.format},
                             {"factor", column.factor},
                             {"shown_unit", column.shown_unit.empty() ? column.unit : column.shown_unit},
                             {"once_when_same", column.report->once_when_same}};
        }
        list.push_back(std::move(one));
    }
    return list;
}

std::string column_reference(std::span<Column const> columns) {
    std::string text = "| column | unit | type | shown in | meaning |\n|---|---|---|---|---|\n";
    for (Column const& column : columns) {
        text += fmt::format("| `{}` | {} | {} | {} | {} |\n", column.name, column.unit,
                            name_of(column.type()), places_of(column), column.meaning);
    }
    return text;
}

}  // namespace vibrotrough::compare
