#include "scenario/reader/key_schema.hpp"

#include "scenario/reader/keys.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::scenario {
namespace {

using Json = nlohmann::ordered_json;

/// What may be written to the right of the equals sign. Units and the words of files are not checked: the
/// program says more about them than an editor can.
Json value_schema(Key const& key) {
    auto const list_of = [](char const* type) {
        return Json{{"type", "array"}, {"items", {{"type", type}}}};
    };
    switch (key.kind) {
        case KeyKind::number:
            return {{"type", "number"}, {"minimum", key.least}, {"maximum", key.most}};
        case KeyKind::integer:
            return {{"type", "integer"}, {"minimum", key.least}, {"maximum", key.most}};
        case KeyKind::choice:
            return {{"enum", choices(key)}};
        case KeyKind::truth:
            return {{"type", "boolean"}};
        case KeyKind::numbers:
            return list_of("number");
        case KeyKind::quantities:
        case KeyKind::texts:
            return list_of("string");
        case KeyKind::files:
            return {{"anyOf", {Json{{"type", "string"}}, list_of("string")}}};
        case KeyKind::packings:
            return {{"anyOf", {list_of("integer"), {{"const", "all"}}}}};
        case KeyKind::name:
        case KeyKind::quantity:
        case KeyKind::file:
            break;
    }
    return {{"type", "string"}};
}

Json explained(Key const& key, Json schema) {
    schema["description"] = fmt::format("{}; {}", key.meaning, range_of(key));
    schema["examples"] = Json::array({Json::parse(key.example)});
    return schema;
}

Json table_of(Json properties) {
    return {{"type", "object"}, {"properties", std::move(properties)}};
}

/// Adds a key of an entry of a list to the schema of all its entries.
void add_to_list(Json& root, std::string_view list, Key const& key) {
    Json& section = root["properties"][std::string(list)];
    if (section.is_null()) section = {{"type", "array"}, {"items", table_of(Json::object())}};
    section["items"]["additionalProperties"] = false;
    section["items"]["properties"][std::string(last_name(key.path))] = explained(key, value_schema(key));
}

/// Adds a key to the schema of its section, which may be part of another section.
void add(Json& root, Key const& key) {
    Json* section = &root;
    std::string_view rest = key.path;
    std::string_view const first = rest.substr(0, rest.find('.'));
    if (is_list_section(first)) return add_to_list(root, first, key);
    for (auto dot = rest.find('.'); dot != rest.npos; dot = rest.find('.')) {
        Json& inner = (*section)["properties"][std::string(rest.substr(0, dot))];
        if (inner.is_null()) inner = table_of(Json::object());
        inner["additionalProperties"] = false;
        section = &inner;
        rest.remove_prefix(dot + 1);
    }
    (*section)["properties"][std::string(rest)] = explained(key, value_schema(key));
}

}  // namespace

std::string key_schema() {
    Json root{{"$schema", "http://json-schema.org/draft-07/schema#"},
              {"title", "Campaign file of Vibrotrough"},
              {"type", "object"},
              {"properties", Json::object()},
              {"additionalProperties", false}};
    Json varied = Json::object();
    for (Key const& key : all_keys()) {
        add(root, key);
        if (can_vary(key)) varied[std::string(key.path)] = explained(key, Json::object());
    }
    for (Key const& key : run_keys()) add(root, key);
    root["definitions"]["varied"] = table_of(std::move(varied));
    Json const varied_keys{{"$ref", "#/definitions/varied"}};
    for (char const* section : {"sweep", "zip", "sample", "domain"})
        root["properties"][section] = varied_keys;
    for (char const* section : {"points", "exclude"})
        root["properties"][section] = {{"type", "array"}, {"items", varied_keys}};
    root["properties"]["points_from"] = table_of({{"file", {{"type", "string"}}}});
    return root.dump(2) + "\n";
}

}  // namespace vibrotrough::scenario
