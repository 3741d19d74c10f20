#include "deck/deck.hpp"

#include "core/atomic_file.hpp"
#include "deck/deck_data.hpp"
#include "deck/phases.hpp"
#include "deck/templates.hpp"
#include "deck/trough_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace vibrotrough::deck {
namespace {

namespace mustache = kainjow::mustache;

constexpr std::string_view processors_line =
    "\nprocessors      * * 1                      # the floor is shared out, not the height";

/// Tags on lines of their own leave blank lines: one between two parts is enough, none within a comment.
std::string tidy(std::string const& text) {
    std::string result;
    int blank = 0;
    for (std::size_t start = 0; start < text.size();) {
        std::size_t const end = std::min(text.find('\n', start), text.size());
        std::string const line = text.substr(start, end - start);
        start = end + 1;
        if (line.empty()) {
            ++blank;
            continue;
        }
        bool const goes_on = line.starts_with("#  ") || line == "#";
        if (blank > 0 && !goes_on) result += '\n';
        blank = 0;
        result += line + '\n';
    }
    return result;
}

/// The template with its parts, {{> name}}, in their places.
std::string with_parts(std::string const& name) {
    std::string text(input_templates.at(name));
    for (std::size_t start = 0; (start = text.find("{{> ", start)) != std::string::npos;) {
        std::size_t const end = text.find("}}", start);
        std::string const part = with_parts(text.substr(start + 4, end - start - 4));
        text.replace(start, end + 2 - start, part);
        start += part.size();
    }
    return text;
}

/// Parsed once: a campaign of ten thousand cases renders each of its decks to know its cases' ids.
mustache::mustache& parsed(std::string const& name) {
    thread_local std::map<std::string, mustache::mustache> decks;
    auto found = decks.find(name);
    if (found == decks.end()) found = decks.emplace(name, mustache::mustache(with_parts(name))).first;
    return found->second;
}

std::string render(char const* name, mustache::data const& data) {
    mustache::mustache& deck = parsed(name);
    std::string const result = deck.render(data);
    if (!deck.is_valid()) throw std::logic_error("input_templates: " + deck.error_message());
    return tidy(result);
}

std::map<std::string, std::string> meshes(prepare::PreparedCase const& prepared) {
    scenario::Scenario const& scenario = prepared.scenario;
    double const length = scenario.layer.length, width = scenario.layer.width,
                 edge = 3 * scenario.grains.diameter;
    std::map<std::string, std::string> files{{"trough.stl", flat_trough_stl(length, width, edge)}};
    if (scenario.trough.side_wall_friction) {
        double const coarse = std::min(length, 4 * edge);
        files["left.stl"] = side_wall_stl(length, prepared.wall_height, 0, coarse);
        files["right.stl"] = side_wall_stl(length, prepared.wall_height, width, coarse);
    }
    return files;
}

}  // namespace

Deck make_deck(prepare::PreparedCase const& prepared, int packing) {
    if (packing < 1 || packing > 1000)
        throw std::invalid_argument(fmt::format("no packing number {}", packing));
    Deck deck;
    mustache::data data = describe(prepared, packing);
    for (auto const& [name, value] : phase_sampling(prepared)) data.set(name, value);
    deck.settle_files = meshes(prepared);
    deck.settle_files[settle_file] = render(settle_file, data);
    deck.files = deck.settle_files;
    deck.files[drive_file] = render(drive_file, data);
    deck.files[control_file] = control_go_on;
    return deck;
}

int packing_seed(int packing) {
    return seed_number(3 * (packing - 1));
}

std::string checkpoint_file(int cycle) {
    return fmt::format("checkpoint.{}.restart", cycle);
}

std::map<std::string, std::string> for_ranks(std::map<std::string, std::string> files, int ranks) {
    if (ranks == 1) return files;
    constexpr std::string_view before = "\ncommunicate ";
    for (auto& [name, content] : files) {
        auto const at = content.find(before);
        if (at != std::string::npos) content.insert(at, processors_line);
    }
    return files;
}

std::string for_one_rank(std::string content) {
    auto const at = content.find(processors_line);
    if (at != std::string::npos) content.erase(at, processors_line.size());
    return content;
}

void write_files(std::map<std::string, std::string> const& files, std::filesystem::path const& folder) {
    core::make_folder(folder);
    for (auto const& [name, content] : files) core::replace_file(folder / name, content);
}

void write_deck(Deck const& deck, std::filesystem::path const& folder, int ranks) {
    write_files(for_ranks(deck.files, ranks), folder);
    // The engine makes no folders.
    if (deck.files.at(drive_file).find(" dump/") != std::string::npos) core::make_folder(folder / "dump");
}

}  // namespace vibrotrough::deck
