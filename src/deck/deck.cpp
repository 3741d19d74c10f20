#include "deck/deck.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "deck/deck_data.hpp"
#include "deck/open_trough.hpp"
#include "deck/render.hpp"
#include "deck/screen.hpp"
#include "deck/trough_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace vibrotrough::deck {
namespace {

constexpr std::string_view processors_line =
    "\nprocessors      * * 1                      # the floor is shared out, not the height";

/// Template tags on lines of their own leave blank lines. This keeps one of them between two parts and none
/// within a comment.
std::string tidy(std::string_view text) {
    std::string result;
    result.reserve(text.size() + 1);
    bool blank = false;
    while (!text.empty()) {
        std::size_t const end = std::min(text.find('\n'), text.size());
        std::string_view const line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        if (line.empty()) {
            blank = true;
            continue;
        }
        bool const goes_on = line.starts_with("#  ") || line == "#";
        if (blank && !goes_on) result += '\n';
        blank = false;
        result.append(line) += '\n';
    }
    return result;
}

std::map<std::string, std::string> meshes(prepare::PreparedCase const& prepared) {
    scenario::Scenario const& scenario = prepared.scenario;
    double const length = scenario.layer.length, width = scenario.layer.width,
                 edge = 3 * mean_diameter(scenario);
    prepare::Domain const& domain = prepared.domain;
    // A screen has no holes while the grains settle.
    std::string const floor = settling_floor(scenario) + ".stl";
    std::map<std::string, std::string> files;
    if (domain.has_mesh()) {
        auto const own = own_trough(prepared);
        for (std::size_t i = 0; i < own.size(); ++i)
            files[i == 0 ? floor : part_file(i - 1)] = scenario::stl_text("trough", own[i]);
    } else {
        files[floor] = flat_trough_stl(length, width, edge);
    }
    double const coarse = std::min(length, 4 * edge);
    if (scenario.trough.side_wall_friction) {
        files["left.stl"] = side_wall_stl(length, prepared.wall_height, 0, coarse);
        files["right.stl"] = side_wall_stl(length, prepared.wall_height, width, coarse);
    }
    if (domain.open) files["back.stl"] = cross_wall_stl(width, 0, prepared.wall_height, 0, coarse);
    return files;
}

}  // namespace

int PackingPlan::next_stop(int done) const {
    if (first_pause <= 0) return cycles;
    int stop = first_pause;
    while (stop <= done && stop < cycles) stop *= 2;
    return std::min(stop, cycles);
}

Deck make_deck(prepare::PreparedCase const& prepared, PackingPlan const& packing) {
    if (packing.number < 1 || packing.number > 1000) {
        throw std::invalid_argument(
            fmt::format("make_deck: packing {} is not from 1 to 1000", packing.number));
    }
    Deck deck;
    core::TemplateData data = describe(prepared, packing);
    describe_open(data, prepared, packing.number);
    describe_screen(data, prepared);
    scenario::DeckTemplates const* const replaced = prepared.scenario.engine.templates.get();
    deck.settle_files = meshes(prepared);
    if (is_fed_screen(prepared.scenario)) add_end_wall(deck.settle_files, prepared);
    // The spring of contact = "hooke" is as stiff as a Hertz contact at the fastest impact of the deck.
    data.set("characteristic_speed", fmt::format("{}", prepared.settle_speed));
    describe_settling_gravity(data, prepared.scenario);
    deck.settle_files[settle_file] = tidy(render_template(settle_file, data, replaced));
    describe_gravity(data, prepared.scenario);
    deck.files = deck.settle_files;
    data.set("characteristic_speed", fmt::format("{}", prepared.time.impact_speed));
    describe_moving_floor(data, prepared);
    if (has_holes(prepared.scenario)) deck.files["trough.stl"] = screen_mesh(prepared);
    deck.files[drive_file] = tidy(render_template(drive_file, data, replaced));
    deck.files[control_file] = control_until(packing.next_stop(0));
    return deck;
}

int packing_seed(int packing) {
    return seed_number(3 * (packing - 1));
}

std::string control_until(int cycles) {
    if (cycles == 0) return control_go_on;
    // The checkpoint is like those within the run (see input_templates/cycles.mustache).
    return fmt::format(
        "variable stop equal ${{done}}>={0}\n"
        "if \"${{done}} == {0}\" then \"run 0\" \"write_restart {1}\" \"print '{0}' append {2}\"\n",
        cycles, checkpoint_file(cycles), checkpoint_list);
}

std::string control_at_once() {
    return fmt::format(
        "variable stop equal 1\nrun 0\nwrite_restart checkpoint.${{done}}.restart\nprint \"${{done}}\" "
        "append {}\n",
        checkpoint_list);
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

std::string digest_of(std::map<std::string, std::string> const& files) {
    std::vector<std::string_view> pieces;
    for (auto const& [name, content] : files) pieces.insert(pieces.end(), {name, "\n", content});
    return core::sha256_hex(pieces);
}

std::map<std::string, std::string> read_files(std::filesystem::path const& folder,
                                              std::map<std::string, std::string> const& names) {
    std::map<std::string, std::string> files;
    for (auto const& [name, unused] : names) {
        std::error_code missing;
        if (!std::filesystem::is_regular_file(folder / name, missing)) continue;
        files[name] = for_one_rank(core::read_file(folder / name, core::largest_note));
    }
    return files;
}

void write_files(std::map<std::string, std::string> const& files, std::filesystem::path const& folder) {
    core::make_folder(folder);
    for (auto const& [name, content] : files) core::replace_file(folder / name, content);
}

void write_case(std::filesystem::path const& folder, std::map<std::string, std::string> const& files) {
    for (auto const& [name, content] : files) {
        std::filesystem::path const path = folder / name;
        if (!std::filesystem::exists(path) || core::read_file(path, core::largest_note) == content) continue;
        throw core::InputError(fmt::format(
            "{} is there already and holds something else; move it away, or choose another folder with "
            "--output",
            path.string()));
    }
    for (auto const& [name, content] : files) {
        core::make_folder((folder / name).parent_path());
        core::replace_file(folder / name, content);
    }
}

void make_frame_folder(Deck const& deck, std::filesystem::path const& folder) {
    if (deck.files.at(drive_file).find(" dump/") != std::string::npos) core::make_folder(folder / "dump");
}

void write_deck(Deck const& deck, std::filesystem::path const& folder, int ranks) {
    write_files(for_ranks(deck.files, ranks), folder);
    make_frame_folder(deck, folder);
}

}  // namespace vibrotrough::deck
