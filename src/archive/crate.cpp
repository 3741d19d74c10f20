#include "archive/crate.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::archive {
namespace {

using Json = nlohmann::ordered_json;

constexpr char const* metadata_file = "ro-crate-metadata.json";
constexpr char const* program_id = "#vibrotrough";
constexpr char const* engine_id = "#engine";

Json reference(std::string const& id) {
    return Json{{"@id", id}};
}

/// Media types (https://www.iana.org/assignments/media-types) by the end of the name.
std::string media_type(std::string_view name) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 11> types{
        {{".csv", "text/csv"},
         {".json", "application/json"},
         {".toml", "application/toml"},
         {".h5", "application/x-hdf5"},
         {".html", "text/html"},
         {".svg", "image/svg+xml"},
         {".png", "image/png"},
         {".pdf", "application/pdf"},
         {".txt", "text/plain"},
         {".stl", "model/stl"},
         {".liggghts", "text/plain"}}};
    for (auto const& [end, type] : types) {
        if (name.ends_with(end)) return std::string(type);
    }
    return "text/plain";
}

/// Percent-encodes what an identifier in JSON-LD, a URI path, may not hold (RFC 3986, 2.1).
std::string uri(std::string_view name) {
    std::string text;
    for (char const letter : name) {
        auto const byte = static_cast<unsigned char>(letter);
        bool const is_plain = (byte >= '0' && byte <= '9') || (byte >= 'A' && byte <= 'Z') ||
                              (byte >= 'a' && byte <= 'z') ||
                              std::string_view("-._~/").find(letter) != std::string_view::npos;
        text += is_plain ? std::string(1, letter) : fmt::format("%{:02X}", byte);
    }
    return text;
}

Json file_entity(ListedFile const& file) {
    return {{"@id", uri(file.name)},
            {"@type", "File"},
            {"name", file.name},
            {"contentSize", std::to_string(file.size)},
            {"encodingFormat", media_type(file.name)},
            {"sha256", file.sha256}};
}

/// Decks are many and alike: they are in SHA256SUMS but have no entity of their own.
bool is_described(ListedFile const& file) {
    return file.name.find("/packing-") == std::string::npos;
}

/// The graph as text. An entity is turned into text as soon as it is made, because there may be hundreds of
/// thousands.
class Graph {
  public:
    void add(Json const& entity) {
        text_ += text_.empty() ? "\n    " : ",\n    ";
        text_ += entity.dump(-1, ' ', false, Json::error_handler_t::replace);
    }
    std::string take() { return std::move(text_); }

  private:
    std::string text_;
};

Json root_entity(CrateFacts const& facts, Json parts) {
    Json root{{"@id", "./"},
              {"@type", "Dataset"},
              {"name", fmt::format("Conveying on a vibrating trough: campaign {}", facts.campaign)},
              {"description",
               "Simulations with LIGGGHTS (DEM) of a granular layer on a vibrating trough, compared with "
               "the point-mass theory of vibratory conveying: campaign file, decks, results, tables"},
              {"hasPart", std::move(parts)},
              {"mentions", Json::array({reference("#simulation")})}};
    if (!facts.ended.empty()) root["datePublished"] = facts.ended.substr(0, 10);
    if (!facts.license.empty()) root["license"] = reference(facts.license);
    Json authors = Json::array();
    for (std::string const& author : facts.authors) authors.push_back(reference("#" + uri(author)));
    if (!authors.empty()) root["author"] = std::move(authors);
    return root;
}

void add_context(Graph& graph, CrateFacts const& facts) {
    for (std::string const& author : facts.authors)
        graph.add(Json{{"@id", "#" + uri(author)}, {"@type", "Person"}, {"name", author}});
    if (!facts.license.empty()) {
        graph.add(Json{{"@id", facts.license},
                       {"@type", "CreativeWork"},
                       {"name", facts.license},
                       {"description", "The licence of this data set"}});
    }
    graph.add(Json{{"@id", program_id},
                   {"@type", "SoftwareApplication"},
                   {"name", "Vibrotrough"},
                   {"version", fmt::format("{} ({})", facts.program_version, facts.git_commit)}});
    graph.add(Json{{"@id", engine_id},
                   {"@type", "SoftwareApplication"},
                   {"name", "LIGGGHTS"},
                   {"version", facts.engine_version}});
    Json action{{"@id", "#simulation"},
                {"@type", "CreateAction"},
                {"name", "Simulation of the campaign"},
                {"instrument", Json::array({reference(program_id), reference(engine_id)})},
                {"object", reference("campaign.toml")}};
    if (!facts.begun.empty()) action["startTime"] = facts.begun;
    if (!facts.ended.empty()) action["endTime"] = facts.ended;
    action["result"] = reference("tables/compare.csv");
    graph.add(action);
}

}  // namespace

std::string crate_metadata(CrateFacts const& facts) {
    std::map<std::string, Json> parts_of_case;
    Json parts = Json::array();
    Graph graph;
    graph.add(Json{{"@id", metadata_file},
                   {"@type", "CreativeWork"},
                   {"conformsTo", reference("https://w3id.org/ro/crate/1.1")},
                   {"about", reference("./")}});
    for (ListedFile const& file : facts.files) {
        if (!is_described(file)) continue;
        bool const is_of_case = file.name.starts_with("cases/");
        std::string const folder = file.name.substr(0, file.name.rfind('/') + 1);
        Json& list = is_of_case ? parts_of_case.try_emplace(folder, Json::array()).first->second : parts;
        list.push_back(reference(uri(file.name)));
        graph.add(file_entity(file));
    }
    for (ListedCase const& one : facts.cases) {
        std::string const folder = "cases/" + one.id + "/";
        if (!parts_of_case.contains(folder)) continue;  // it was not begun
        Json entity{{"@id", folder},
                    {"@type", "Dataset"},
                    {"name", fmt::format("Case {}", one.id)},
                    {"description", one.description}};
        entity["hasPart"] = std::move(parts_of_case[folder]);
        parts.push_back(reference(folder));
        graph.add(entity);
    }
    parts.push_back(reference("SHA256SUMS"));
    graph.add(Json{{"@id", "SHA256SUMS"},
                   {"@type", "File"},
                   {"name", "SHA256SUMS"},
                   {"description", "SHA-256 of all other files, to be checked with sha256sum -c SHA256SUMS"},
                   {"encodingFormat", "text/plain"}});
    graph.add(root_entity(facts, std::move(parts)));
    add_context(graph, facts);
    return fmt::format(
        "{{\n  \"@context\": [\n    \"https://w3id.org/ro/crate/1.1/context\",\n    "
        "{{\"sha256\": \"https://schema.org/sha256\"}}\n  ],\n  \"@graph\": [{}\n  ]\n}}\n",
        graph.take());
}

}  // namespace vibrotrough::archive
