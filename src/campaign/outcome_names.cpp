#include "campaign/outcome_names.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace vibrotrough::campaign {
namespace {

using enum Retry;

constexpr std::array outcomes{
    OutcomeName{"finished",
                "every packing is steady and as precise as asked; the case's own interval, from all "
                "packings, can still be wider",
                useless, ""},
    OutcomeName{"not-precise",
                "steady, but after `max_cycles` at least one packing's interval is wider than asked, or "
                "rests on fewer than 20 cycles or 3 independent ones; the number is given with its interval",
                useless, "raise measure.max_cycles or half_width"},
    OutcomeName{"not-steady",
                "at least one packing never became steady; no number is given (NaN in the HDF5 files)",
                useless, "raise measure.max_cycles"},
    OutcomeName{"lost-grains", "grains left the box", useless, "a smaller throw number, or stiffer grains"},
    OutcomeName{"mesh-left-domain", "the trough's mesh reaches over the box", useless,
                "report it: a deck's mistake"},
    OutcomeName{"insertion-incomplete", "not all grains found room when they were poured", useless,
                "fewer grains, or a larger box"},
    OutcomeName{"not-settled", "the packing did not come to rest on the standing trough", useless,
                "a smaller inclination, or more friction"},
    OutcomeName{"diverged", "a number is NaN or infinite, or the layer is faster than 100 times the trough",
                useless, "stiffer or larger grains, a slower trough"},
    OutcomeName{"wrong-weight", "the trough did not carry what the layer weighs, by the balance of momentum",
                useless, "report it: a deck's or the engine's mistake"},
    OutcomeName{"engine-error", "the engine stopped with its own message, which is given", useless,
                "the message says"},
    OutcomeName{"engine-crashed", "a signal killed the engine", sensible, ""},
    OutcomeName{"outputs-incomplete",
                "the engine ended as if well, but what it should have written is not there", sensible, ""},
    OutcomeName{"out-of-memory", "the engine or Slurm says that memory ran out", after_mending,
                "more run.slurm.memory, or fewer --jobs"},
    OutcomeName{"disk-full", "the folder's disk takes no more", after_mending, "free space"},
    OutcomeName{"time-limit", "not finished within run.time_limit or run.slurm.time", after_mending,
                "more time"},
    OutcomeName{"interrupted", "stopped from outside: Ctrl-C, a killed driver, scancel, a node that failed",
                sensible, ""},
};

}  // namespace

std::span<OutcomeName const> outcome_names() {
    return outcomes;
}

OutcomeName const* find_outcome(std::string_view name) {
    auto const found = std::ranges::find(outcomes, name, &OutcomeName::name);
    return found == outcomes.end() ? nullptr : &*found;
}

bool retry_makes_sense(std::string_view name) {
    OutcomeName const* const outcome = find_outcome(name);
    return outcome != nullptr && outcome->retry == sensible;
}

std::string retry_advice(std::string_view name) {
    OutcomeName const* const outcome = find_outcome(name);
    if (outcome == nullptr) return "unknown";
    if (outcome->advice.empty() && outcome->retry == useless) return "";
    std::string again = "no";
    if (outcome->retry == sensible) again = "yes";
    if (outcome->retry == after_mending) again = "after mending";
    return outcome->advice.empty() ? again : fmt::format("{}: {}", again, outcome->advice);
}

std::string outcome_reference() {
    std::string text = "| outcome | meaning | try again |\n|---|---|---|\n";
    for (OutcomeName const& outcome : outcomes) {
        text +=
            fmt::format("| `{}` | {} | {} |\n", outcome.name, outcome.meaning, retry_advice(outcome.name));
    }
    return text;
}

}  // namespace vibrotrough::campaign
