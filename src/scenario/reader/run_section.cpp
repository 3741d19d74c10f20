#include "scenario/reader/run_section.hpp"

#include "core/text.hpp"
#include "scenario/reader/key_fields.hpp"
#include "scenario/reader/value_reader.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

namespace vibrotrough::scenario {
namespace {

using enum KeyNeed;

/// An amount of memory such as "2 GB" in MiB; nullopt when the text is not such an amount.
std::optional<std::int64_t> parse_memory(std::string_view text) {
    double amount = 0;
    auto const [rest, failure] = std::from_chars(text.data(), text.data() + text.size(), amount);
    std::string_view unit(rest, static_cast<std::size_t>(text.data() + text.size() - rest));
    if (failure != std::errc()) return {};
    if (!unit.empty() && unit.front() == ' ') unit.remove_prefix(1);
    if (unit == "GB" || unit == "GiB") {
        amount *= 1024;
    } else if (unit != "MB" && unit != "MiB") {
        return {};
    }
    if (!(amount >= 1 && amount <= 1024e6)) return {};
    return std::llround(amount);
}

// The keys of a scheduler's section; `section` is the member of RunSettings that holds its settings.

template <auto section, auto member>
void set_name(RunSettings& s, GivenValue const& v) {
    auto& name = (s.*section).*member;
    name = PlainName::from(v.word());
    if (!name) v.refuse(v.word());
}

/// Schedulers count whole minutes.
template <auto section>
void set_minutes(RunSettings& s, GivenValue const& v) {
    (s.*section).minutes = static_cast<int>(std::ceil(v.number() / 60));
}

template <auto section>
void set_memory(RunSettings& s, GivenValue const& v) {
    (s.*section).memory = parse_memory(v.word());
    if (!(s.*section).memory) v.refuse(v.word());
}

template <auto section, class Option>
void set_extra_options(RunSettings& s, GivenValue const& v) {
    for (std::string const& text : v.words()) {
        auto const option = Option::from(text);
        if (!option)
            v.refuse(text, fmt::format("allowed are {} with a value that has no space, quote or slash",
                                       Option::names()));
        (s.*section).extra.push_back(*option);
    }
}

template <auto section>
void set_setup(RunSettings& s, GivenValue const& v) {
    for (std::string const& text : v.words()) {
        bool const is_line = !text.empty() && text.size() <= 500 && core::harmless(text) == text &&
                             text.find('\n') == text.npos;
        if (!is_line) v.refuse(text, "a line has 1 to 500 printable characters");
        (s.*section).setup.push_back(text);
    }
}

template <auto set>
constexpr KeyAccess in_run{.set_run = set};

constexpr std::array keys_of_run{
    Key{"run.executor", KeyKind::choice, "", 0, 0, one_of("local", "slurm"), "", optional, "\"slurm\"",
        "what runs the packings: this machine, or job arrays of Slurm; for another scheduler 'vibrotrough "
        "prepare' writes a list of tasks",
        run_field<&RunSettings::executor>},
    Key{"run.retries", KeyKind::integer, "", 0, 100, "", "", 0.0, "2",
        "how often a packing is run again after an outcome for which the table of outcomes allows it",
        run_field<&RunSettings::retries>},
    Key{"run.ranks", KeyKind::integer, "", 1, 1024, "", "", optional, "2",
        "MPI ranks of each engine; chosen from the number of grains if not given",
        run_field<&RunSettings::ranks>},
    Key{"run.time_limit", KeyKind::quantity, "s", 1, 3e7, "1 s to 347 days", "", optional, "\"12 hours\"",
        "largest wall-clock time of a packing, after which its outcome is time-limit; no limit if not given",
        run_field<&RunSettings::time_limit>},
    Key{"run.slurm.partition", KeyKind::name, "", 0, 0, "a name of letters, digits, '.', '_' or '-'", "",
        optional, "\"compute\"", "partition; like all keys of this section, Slurm's default if not given",
        in_run<set_name<&RunSettings::slurm, &BatchSettings::partition>>},
    Key{"run.slurm.account", KeyKind::name, "", 0, 0, "a name of letters, digits, '.', '_' or '-'", "",
        optional, "\"granular\"", "account to which the computing time is charged",
        in_run<set_name<&RunSettings::slurm, &BatchSettings::account>>},
    Key{"run.slurm.time", KeyKind::quantity, "s", 60, 3e7, "1 minute to 347 days", "", optional,
        "\"12 hours\"", "wall-clock time requested for a packing, rounded up to whole minutes",
        in_run<set_minutes<&RunSettings::slurm>>},
    Key{"run.slurm.memory", KeyKind::name, "", 0, 0, "1 MB to 1000000 GB", "", optional, "\"2 GB\"",
        "memory requested for a packing; 1 GB is 1024 MB", in_run<set_memory<&RunSettings::slurm>>},
    Key{"run.slurm.concurrent_tasks", KeyKind::integer, "", 1, 1e5, "", "", optional, "100",
        "largest number of packings of one array that run at the same time",
        run_field<&RunSettings::slurm, &BatchSettings::concurrent_tasks>},
    Key{"run.slurm.minutes_per_task", KeyKind::integer, "", 1, 1e5, "", "", optional, "30",
        "several packings are simulated one after the other in one task, so that it takes about this many "
        "minutes, for sites that refuse short tasks; one packing per task if not given",
        run_field<&RunSettings::slurm, &BatchSettings::minutes_per_task>},
    Key{"run.slurm.extra", KeyKind::texts, "", 0, 0, "1 to 30 options that ask for resources", "", optional,
        "[\"--qos=short\", \"--constraint=avx2\"]", "further options of sbatch",
        in_run<set_extra_options<&RunSettings::slurm, SlurmOption>>},
    Key{"run.slurm.setup", KeyKind::texts, "", 0, 0, "1 to 30 lines", "", optional,
        "[\"module load openmpi\"]",
        "lines of the shell (bash) that each task runs before the engine; 'run' shows them and refuses "
        "unless --allow-setup is given, since they can do anything",
        in_run<set_setup<&RunSettings::slurm>>},
    Key{"run.slurm.cores_per_task", KeyKind::integer, "", 1, 1024, "", "", optional, "64",
        "cores of a task, which it keeps busy with as many packings as have room at once; those of one "
        "engine "
        "if not given",
        run_field<&RunSettings::slurm, &BatchSettings::cores_per_task>},
};

void read_entry(std::string const& path, toml::key const& name, toml::node const& node,
                std::string const& file, RunSettings& settings) {
    auto const found = std::ranges::find(keys_of_run, path, &Key::path);
    if (found == keys_of_run.end())
        throw_at({file, position_of(name.source())}, path, "unknown key",
                 "see 'vibrotrough keys' for all keys");
    found->access.set_run(settings,
                          {*found, read_content(*found, node, file), {file, position_of(node.source())}, {}});
}

}  // namespace

std::span<Key const> run_keys() {
    return keys_of_run;
}

RunSettings read_run_section(toml::table const& section, std::string const& file) {
    RunSettings settings;
    for (auto const& [name, node] : section) {
        std::string const path = fmt::format("run.{}", name.str());
        bool const is_subsection = std::ranges::any_of(
            keys_of_run, [&](Key const& key) { return key.path.starts_with(path + "."); });
        if (!is_subsection || !node.is_table()) {
            read_entry(path, name, node, file, settings);
            continue;
        }
        for (auto const& [key, value] : *node.as_table())
            read_entry(fmt::format("{}.{}", path, key.str()), key, value, file, settings);
    }
    return settings;
}

}  // namespace vibrotrough::scenario
