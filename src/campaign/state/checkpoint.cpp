#include "campaign/state/checkpoint.hpp"

#include "campaign/state/notes.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "measure/cycle_series.hpp"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::campaign {
namespace {

namespace fs = std::filesystem;
using core::note::Json;

/// The tables of a run whose rows begin with their step.
constexpr char const* tables[] = {"cycles.csv", "phases.csv", "dump/frames.csv"};

/// The number with which a line begins, if nothing or a comma follows.
std::optional<long> leading_number(std::string_view line) {
    long number = 0;
    auto const [end, failure] = std::from_chars(line.data(), line.data() + line.size(), number);
    if (failure != std::errc() || (end != line.data() + line.size() && *end != ',')) return {};
    return number;
}

/// The whole lines of a text, without their ends.
std::vector<std::string_view> whole_lines(std::string_view text) {
    std::vector<std::string_view> lines;
    for (std::size_t end = 0; (end = text.find('\n')) != std::string_view::npos; text.remove_prefix(end + 1))
        lines.push_back(text.substr(0, end));
    return lines;
}

std::string rows_up_to(std::string const& text, long step) {
    std::string kept;
    for (std::string_view const line : whole_lines(text))
        if (leading_number(line).value_or(step) <= step) kept.append(line) += '\n';
    return kept;
}

bool has_row(std::string const& text, long step) {
    return std::ranges::any_of(whole_lines(text), [&](auto line) { return leading_number(line) == step; });
}

std::optional<long> number_between(std::string_view name, std::string_view start, std::string_view end) {
    if (!name.starts_with(start) || !name.ends_with(end) || name.size() < start.size() + end.size())
        return {};
    return leading_number(name.substr(start.size(), name.size() - start.size() - end.size()));
}

/// checkpoint.<cycle>.restart
std::optional<long> checkpoint_cycle(std::string const& name) {
    return number_between(name, "checkpoint.", ".restart");
}

std::vector<fs::path> restart_files(fs::path const& folder) {
    std::vector<fs::path> files;
    std::error_code missing;
    for (auto const& entry : fs::directory_iterator(folder, missing)) {
        if (checkpoint_cycle(entry.path().filename().string())) files.push_back(entry.path());
    }
    return files;
}

/// The sealed checkpoint, if it was made with the deck `drive` and is still what was sealed.
std::optional<Checkpoint> find_checkpoint(fs::path const& folder, std::string const& drive,
                                          int steps_per_cycle) {
    try {
        if (!fs::is_regular_file(folder / checkpoint_seal)) return {};
        auto const [checkpoint, restart, deck] =
            parse_checkpoint(core::read_file(folder / checkpoint_seal, core::largest_note));
        bool const known = checkpoint_cycle(checkpoint.file) && deck == core::sha256_hex(drive) &&
                           restart == core::sha256_hex(core::read_file(folder / checkpoint.file));
        if (known && has_row(measure::cycles_text(folder / "cycles.csv").content,
                             static_cast<long>(checkpoint.cycle) * steps_per_cycle))
            return checkpoint;
    } catch (core::Error const&) {
        // Damaged: the run starts anew.
    }
    return {};
}

}  // namespace

std::optional<int> last_checkpoint(fs::path const& folder) {
    std::error_code missing;
    if (!fs::is_regular_file(folder / deck::checkpoint_list, missing)) return {};
    std::string const list = core::read_file(folder / deck::checkpoint_list, core::largest_note);
    auto const lines = whole_lines(list);
    if (lines.empty()) return {};
    auto const cycle = leading_number(lines.back());
    return cycle ? std::optional(static_cast<int>(*cycle)) : std::nullopt;
}

void seal_checkpoint(fs::path const& folder, deck::Deck const& deck, Checkpoint const& checkpoint) {
    Json const seal{{"cycle", checkpoint.cycle},
                    {"file", checkpoint.file},
                    {"restart_sha256", core::sha256_hex(core::read_file(folder / checkpoint.file))},
                    {"deck_sha256", core::sha256_hex(deck.files.at(deck::drive_file))},
                    {"started", checkpoint.started},
                    {"wall_time", checkpoint.wall_time},
                    {"core_time", checkpoint.core_time}};
    core::write_file_atomically(folder / checkpoint_seal, seal.dump(2) + "\n");
    for (fs::path const& file : restart_files(folder)) {
        // The engine may be writing the next one.
        if (*checkpoint_cycle(file.filename().string()) < checkpoint.cycle) fs::remove(file);
    }
}

std::optional<Checkpoint> read_checkpoint(fs::path const& folder, deck::Deck const& deck,
                                          int steps_per_cycle) {
    return find_checkpoint(folder, deck.files.at(deck::drive_file), steps_per_cycle);
}

std::optional<Checkpoint> read_own_checkpoint(fs::path const& folder, int steps_per_cycle) {
    try {
        if (!has_checkpoint(folder)) return {};
        std::string const drive =
            deck::for_one_rank(core::read_file(folder / deck::drive_file, core::largest_note));
        return find_checkpoint(folder, drive, steps_per_cycle);
    } catch (core::Error const&) {
        return {};
    }
}

bool has_checkpoint(fs::path const& folder) {
    std::error_code missing;
    return fs::is_regular_file(folder / checkpoint_seal, missing);
}

void cut_outputs(fs::path const& folder, Checkpoint const& checkpoint, int steps_per_cycle) {
    long const step = static_cast<long>(checkpoint.cycle) * steps_per_cycle;
    for (char const* table : tables) {
        if (fs::is_regular_file(folder / table))
            core::write_file_atomically(folder / table, rows_up_to(core::read_file(folder / table), step));
    }
    // A later checkpoint that nobody sealed belongs to cycles that were cut away. Were it still listed, it
    // would be sealed and this one removed before the engine has read it.
    core::write_file_atomically(folder / deck::checkpoint_list, fmt::format("{}\n", checkpoint.cycle));
    for (fs::path const& file : restart_files(folder)) {
        if (*checkpoint_cycle(file.filename().string()) > checkpoint.cycle) fs::remove(file);
    }
    if (!fs::is_directory(folder / "dump")) return;
    std::vector<fs::path> later;
    for (auto const& entry : fs::directory_iterator(folder / "dump")) {
        std::string const name = entry.path().filename().string();
        for (char const* const start : {"frames.", "contacts.", "trough_contacts."}) {
            auto const frame = number_between(name, start, ".dump");
            if (frame && *frame > step) later.push_back(entry.path());
        }
    }
    for (fs::path const& frame : later) fs::remove(frame);
}

void remove_checkpoints(fs::path const& folder) {
    for (fs::path const& file : restart_files(folder)) fs::remove(file);
    fs::remove(folder / checkpoint_seal);
    fs::remove(folder / deck::checkpoint_list);
}

}  // namespace vibrotrough::campaign
