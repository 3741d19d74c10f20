#include "core/outcome.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include <fmt/format.h>

namespace vibrotrough::core {
namespace {

using enum Outcome;
using enum Retry;

constexpr std::array table{
    OutcomeEntry{finished, "finished",
                 "The case is steady, and the interval of its velocity efficiency, which comes from all "
                 "packings, is at most as wide as `half_width` asks.",
                 useless, ""},
    OutcomeEntry{not_precise, "not-precise",
                 "The case is steady, but its interval is still wider than asked after `max_packings`, or "
                 "more packings would have exceeded `max_core_time`. The mean is reported with its interval.",
                 useless, "raise measure.max_packings, measure.max_core_time or measure.half_width"},
    OutcomeEntry{not_steady, "not-steady",
                 "The packings still drift in the same direction after `max_cycles`. No mean is reported "
                 "unless the case is steady (NaN in the HDF5 files).",
                 useless, "raise measure.max_cycles"},
    OutcomeEntry{bistable_or_slow, "bistable-or-slow",
                 "After `max_cycles`, packings that started below the expected speed still differ from "
                 "those that started above it: the layer has two ways to move, or forgets its start very "
                 "slowly. Both branches are reported with their intervals, but no mean.",
                 useless, "raise measure.max_cycles"},
    OutcomeEntry{lost_grains, "lost-grains",
                 "Grains left the simulation box, or the grains of an open trough do not add up.", useless,
                 "choose a smaller throw number or stiffer grains"},
    OutcomeEntry{mesh_left_domain, "mesh-left-domain", "The trough mesh extends outside the simulation box.",
                 useless, "this is a bug in the deck; please report it"},
    OutcomeEntry{insertion_incomplete, "insertion-incomplete",
                 "Not all grains found room when they were poured.", useless,
                 "choose fewer grains or a larger box"},
    OutcomeEntry{
        not_settled, "not-settled", "The packing did not come to rest on the standing trough.", useless,
        "choose a smaller inclination, more friction or less cohesion; cohesive grains of unequal sizes "
        "may settle without rolling friction"},
    OutcomeEntry{
        overfull, "overfull",
        "An open trough is fed more than it conveys: the layer has grown up to the feed, so that new "
        "grains found no more room.",
        useless, "feed less, or convey faster"},
    OutcomeEntry{diverged, "diverged",
                 "A number is NaN or infinite, or the layer is faster than 100 times the trough.", useless,
                 "choose stiffer or larger grains, or a slower trough"},
    OutcomeEntry{wrong_weight, "wrong-weight",
                 "The force on the trough does not balance the weight of the layer.", useless,
                 "this is a bug in the deck or in the engine; please report it"},
    OutcomeEntry{engine_error, "engine-error", "The engine stopped with an error message, which is given.",
                 useless, "see the message"},
    OutcomeEntry{engine_crashed, "engine-crashed", "The engine was killed by a signal.", sensible, ""},
    OutcomeEntry{
        outputs_incomplete, "outputs-incomplete",
        "The engine ended normally, but files that it should have written are missing or incomplete.",
        sensible, ""},
    OutcomeEntry{out_of_memory, "out-of-memory",
                 "The engine or the cluster's scheduler reports that memory ran out.", after_cure,
                 "ask for more memory in the section of the cluster, or use fewer --jobs"},
    OutcomeEntry{
        disk_full, "disk-full",
        "The disk of the campaign's folder is full, or a file reached the limit of its size (ulimit -f).",
        after_cure, "free space, or raise the limit"},
    OutcomeEntry{time_limit, "time-limit",
                 "The packing was not finished within run.time_limit or the time asked of the cluster.",
                 after_cure, "allow more time"},
    OutcomeEntry{
        interrupted, "interrupted",
        "The run was stopped from outside: Ctrl-C, a killed driver, a cancelled task, or a failed node.",
        sensible, ""},
};

constexpr bool is_in_order() {
    for (std::size_t i = 0; i < table.size(); ++i) {
        if (static_cast<std::size_t>(table[i].outcome) != i) return false;
    }
    return true;
}
static_assert(is_in_order(), "the table lists every outcome in the order of the enumeration");

OutcomeEntry const& entry_of(Outcome outcome) {
    return table.at(static_cast<std::size_t>(outcome));
}

}  // namespace

std::span<OutcomeEntry const> outcome_table() {
    return table;
}

std::string_view name_of(Outcome outcome) {
    return entry_of(outcome).name;
}

std::optional<Outcome> outcome_named(std::string_view name) {
    auto const found = std::ranges::find(table, name, &OutcomeEntry::name);
    return found == table.end() ? std::nullopt : std::optional(found->outcome);
}

bool has_result(Outcome outcome) {
    return has_mean(outcome) || outcome == not_steady || outcome == bistable_or_slow;
}

bool has_mean(Outcome outcome) {
    return outcome == finished || outcome == not_precise;
}

bool retry_makes_sense(Outcome outcome) {
    return entry_of(outcome).retry == sensible;
}

std::string retry_advice(Outcome outcome) {
    OutcomeEntry const& entry = entry_of(outcome);
    if (entry.retry == sensible) return "yes";
    if (entry.cure.empty()) return "";
    return fmt::format("{}: {}", entry.retry == after_cure ? "afterwards" : "no", entry.cure);
}

std::string outcome_reference() {
    std::string text = "| outcome | meaning | try again |\n|---|---|---|\n";
    for (OutcomeEntry const& entry : table) {
        text += fmt::format("| `{}` | {} | {} |\n", entry.name, entry.meaning, retry_advice(entry.outcome));
    }
    return text;
}

}  // namespace vibrotrough::core
