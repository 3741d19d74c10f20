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

/// Schedulers that users know, for which there is no executor.
bool is_other_scheduler(std::string_view name) {
    constexpr std::array<std::string_view, 7> others{"pbs",      "torque", "lsf",     "sge",
                                                     "htcondor", "flux",   "parallel"};
    return std::ranges::find(others, name) != others.end();
}

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

void set_executor(RunSettings& s, GivenValue const& v) {
    if (is_other_scheduler(v.word())) {
        v.fail(fmt::format("'{}' is not an executor", v.word()),
               "write \"local\", and let 'vibrotrough prepare' write a list of tasks for this scheduler "
               "(src/campaign/README.md)");
    }
    auto const known = choices(v.key());
    if (std::ranges::find(known, v.word()) == known.end()) v.refuse(v.word());
    s.executor = v.word();
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
    Key{"run.executor", KeyKind::choice, "", 0, 0, "local or slurm", "", optional, "\"slurm\"",
        "what runs the packings: this machine, or job arrays of Slurm", in_run<set_executor>},
    Key{"run.retries", KeyKind::integer, "", 0, 100, "0 to 100", "", 0.0, "2",
        "how often a packing is run again after an outcome for which the table of outcomes allows it",
        run_field<&RunSettings::retries>},
    Key{"run.ranks", KeyKind::integer, "", 1, 1024, "1 to 1024", "", optional, "2",
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
    Key{"run.slurm.concurrent_tasks", KeyKind::integer, "", 1, 1e5, "1 to 100000", "", optional, "100",
        "largest number of packings of one array that run at the same time",
        run_field<&RunSettings::slurm, &BatchSettings::concurrent_tasks>},
    Key{"run.slurm.minutes_per_task", KeyKind::integer, "", 1, 1e5, "1 to 100000", "", optional, "30",
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
    Key{"run.slurm.cores_per_task", KeyKind::integer, "", 1, 1024, "1 to 1024", "", optional, "64",
        "cores of a task, which it keeps busy with as many packings as have room at once; those of one "
        "engine "
        "if not given",
        run_field<&RunSettings::slurm, &BatchSettings::cores_per_task>},
};

/// Reads the section [run].
class RunSection {
  public:
    explicit RunSection(std::string const& file) : file_(file) {}

    RunSettings read(toml::table const& section) {
        for (auto const& [name, node] : section) {
            std::string const subsection = fmt::format("run.{}.", name.str());
            bool const has_keys = std::ranges::any_of(
                keys_of_run, [&](Key const& key) { return key.path.starts_with(subsection); });
            if (has_keys && node.is_table()) {
                for (auto const& [key, value] : *node.as_table()) read_entry(subsection, key, value);
            } else {
                read_entry("run.", name, node);
            }
        }
        return settings_;
    }

  private:
    [[noreturn]] void fail(toml::source_region const& source, std::string_view key, std::string_view wrong,
                           std::string_view instead) const {
        throw_at({file_, position_of(source)}, key, wrong, instead);
    }

    void read_entry(std::string_view section, toml::key const& name, toml::node const& node) {
        std::string const path = fmt::format("{}{}", section, name.str());
        auto const found = std::ranges::find(keys_of_run, path, &Key::path);
        if (found == keys_of_run.end()) {
            std::vector<std::string_view> names;
            for (Key const& key : keys_of_run) {
                std::string_view const rest = key.path.substr(std::min(section.size(), key.path.size()));
                if (key.path.starts_with(section) && rest.find('.') == rest.npos) names.push_back(rest);
            }
            fail(name.source(), path, "unknown key",
                 fmt::format("the keys of this section are {}", fmt::join(names, ", ")));
        }
        found->access.set_run(settings_,
                              {*found, content_of(*found, node), {file_, position_of(node.source())}, {}});
    }

    /// Words need not be those of the key's range: KeyAccess::set_run checks them.
    Content content_of(Key const& key, toml::node const& node) const {
        if (key.kind != KeyKind::name && key.kind != KeyKind::choice) return read_content(key, node, file_);
        if (!node.is_string())
            fail(node.source(), key.path, "is not a text",
                 fmt::format("{}; allowed: {}", write_instead(key), key.range));
        return node.value<std::string>().value_or("");
    }

    std::string const& file_;
    RunSettings settings_;
};

}  // namespace

std::span<Key const> run_keys() {
    return keys_of_run;
}

RunSettings read_run_section(toml::table const& section, std::string const& file) {
    return RunSection(file).read(section);
}

}  // namespace vibrotrough::scenario
