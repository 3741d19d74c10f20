#include "scenario/reader/run_section.hpp"

#include "core/text.hpp"
#include "scenario/reader/value_reader.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

namespace vibrotrough::scenario {
namespace {

using enum KeyNeed;

constexpr std::array keys_of_run{
    Key{"run.executor", KeyKind::choice, "", 0, 0, "local, slurm or pbs", "", optional, "\"slurm\"",
        "what runs the packings: this machine, or job arrays of Slurm or of PBS"},
    Key{"run.retries", KeyKind::integer, "", 0, 100, "0 to 100", "", 0.0, "2",
        "how often a packing is run again after an outcome for which the table of outcomes allows it"},
    Key{"run.ranks", KeyKind::integer, "", 1, 1024, "1 to 1024", "", optional, "2",
        "MPI ranks of each engine; chosen from the number of grains if not given"},
    Key{"run.time_limit", KeyKind::quantity, "s", 1, 3e7, "1 s to 347 days", "", optional, "\"12 hours\"",
        "largest wall-clock time of a packing, after which its outcome is time-limit; no limit if not given"},
    Key{"run.slurm.partition", KeyKind::name, "", 0, 0, "a name of letters, digits, '.', '_' or '-'", "",
        optional, "\"compute\"", "partition; like all keys of this section, Slurm's default if not given"},
    Key{"run.slurm.account", KeyKind::name, "", 0, 0, "a name of letters, digits, '.', '_' or '-'", "",
        optional, "\"granular\"", "account to which the computing time is charged"},
    Key{"run.slurm.time", KeyKind::quantity, "s", 60, 3e7, "1 minute to 347 days", "", optional,
        "\"12 hours\"", "wall-clock time requested for a packing, rounded up to whole minutes"},
    Key{"run.slurm.memory", KeyKind::name, "", 0, 0, "1 MB to 1000000 GB", "", optional, "\"2 GB\"",
        "memory requested for a packing; 1 GB is 1024 MB"},
    Key{"run.slurm.concurrent_tasks", KeyKind::integer, "", 1, 1e5, "1 to 100000", "", optional, "100",
        "largest number of packings of one array that run at the same time"},
    Key{"run.slurm.minutes_per_task", KeyKind::integer, "", 1, 1e5, "1 to 100000", "", optional, "30",
        "several packings are simulated one after the other in one task, so that it takes about this many "
        "minutes, for "
        "sites that refuse short tasks; one packing per task if not given"},
    Key{"run.slurm.extra", KeyKind::texts, "", 0, 0, "1 to 30 options that ask for resources", "", optional,
        "[\"--qos=short\", \"--constraint=avx2\"]", "further options of sbatch"},
    Key{"run.slurm.setup", KeyKind::texts, "", 0, 0, "1 to 30 lines", "", optional,
        "[\"module load openmpi\"]",
        "lines of the shell (bash) that each task runs before the engine; 'run' shows them and refuses "
        "unless "
        "--allow-setup is given, since they can do anything"},
    Key{"run.slurm.cores_per_task", KeyKind::integer, "", 1, 1024, "1 to 1024", "", optional, "64",
        "cores of a task, which it keeps busy with as many packings as have room at once; those of one "
        "engine if "
        "not given"},
    Key{"run.pbs.queue", KeyKind::name, "", 0, 0, "a name of letters, digits, '.', '_' or '-'", "", optional,
        "\"workq\"", "queue; like all keys of this section, PBS's default if not given"},
    Key{"run.pbs.account", KeyKind::name, "", 0, 0, "a name of letters, digits, '.', '_' or '-'", "",
        optional, "\"granular\"", "account to which the computing time is charged"},
    Key{"run.pbs.time", KeyKind::quantity, "s", 60, 3e7, "1 minute to 347 days", "", optional, "\"12 hours\"",
        "as run.slurm.time"},
    Key{"run.pbs.memory", KeyKind::name, "", 0, 0, "1 MB to 1000000 GB", "", optional, "\"2 GB\"",
        "as run.slurm.memory"},
    Key{"run.pbs.concurrent_tasks", KeyKind::integer, "", 1, 1e5, "1 to 100000", "", optional, "100",
        "as run.slurm.concurrent_tasks"},
    Key{"run.pbs.minutes_per_task", KeyKind::integer, "", 1, 1e5, "1 to 100000", "", optional, "30",
        "as run.slurm.minutes_per_task"},
    Key{"run.pbs.extra", KeyKind::texts, "", 0, 0, "1 to 30 options that ask for resources", "", optional,
        "[\"-lplace=excl\", \"-Pgranular\"]", "further options of qsub, each with its value in one word"},
    Key{"run.pbs.setup", KeyKind::texts, "", 0, 0, "1 to 30 lines", "", optional, "[\"module load openmpi\"]",
        "as run.slurm.setup"},
    Key{"run.pbs.cores_per_task", KeyKind::integer, "", 1, 1024, "1 to 1024", "", optional, "64",
        "as run.slurm.cores_per_task"},
};

/// Schedulers that users know, for which there is no executor.
bool is_other_scheduler(std::string_view name) {
    constexpr std::array<std::string_view, 6> others{"torque", "lsf", "sge", "htcondor", "flux", "parallel"};
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
            fail(name.source(), core::printable(path, 60), "unknown key",
                 fmt::format("the keys of this section are {}", fmt::join(names, ", ")));
        }
        if (found->kind == KeyKind::texts) {
            read_texts(*found, node);
        } else if (found->kind == KeyKind::name || found->kind == KeyKind::choice) {
            read_text(*found, node);
        } else {
            read_number(*found, node);
        }
    }

    void read_text(Key const& key, toml::node const& node) {
        std::string_view const name = last_name(key.path);
        std::string const given = node.value<std::string>().value_or("");
        auto const refuse = [&] {
            fail(node.source(), key.path,
                 node.is_string() ? fmt::format("'{}' is not allowed", core::printable(given, 60))
                                  : "is not a text",
                 fmt::format("{}; allowed: {}", write_instead(key), key.range));
        };
        if (name == "executor") {
            if (is_other_scheduler(given)) {
                fail(
                    node.source(), key.path, fmt::format("'{}' is not an executor", given),
                    "write \"local\", and let 'vibrotrough prepare' write a list of tasks for this scheduler "
                    "(src/campaign/README.md)");
            }
            auto const known = choices(key);
            if (std::ranges::find(known, given) == known.end()) refuse();
            settings_.executor = given;
        } else if (name == "memory") {
            batch_of(key).memory = parse_memory(given);
            if (!batch_of(key).memory) refuse();
        } else {
            auto const plain = PlainName::from(given);
            if (!plain) refuse();
            (name == "account" ? batch_of(key).account : batch_of(key).partition) = plain;
        }
    }

    void read_texts(Key const& key, toml::node const& node) {
        auto const refuse = [&](std::string const& text, std::string_view instead) {
            fail(node.source(), key.path, fmt::format("'{}' is not allowed", core::printable(text, 60)),
                 fmt::format("{}; {}", write_instead(key), instead));
        };
        Content const content = read_content(key, node, file_);
        for (std::string const& text : std::get<std::vector<std::string>>(content)) {
            if (last_name(key.path) == "setup") {
                bool const is_line = !text.empty() && text.size() <= 500 && core::harmless(text) == text;
                if (!is_line) refuse(text, "a line has 1 to 500 printable characters");
                batch_of(key).setup.push_back(text);
            } else {
                bool const is_slurm = key.path.starts_with("run.slurm.");
                auto const option = is_slurm ? SlurmOption::from(text) : PbsOption::from(text);
                if (!option)
                    refuse(text, fmt::format("allowed are {} with a value that has no space, quote or slash",
                                             is_slurm ? SlurmOption::names() : PbsOption::names()));
                batch_of(key).extra.push_back(*option);
            }
        }
    }

    void read_number(Key const& key, toml::node const& node) {
        double const value = std::get<double>(read_content(key, node, file_));
        int const whole = static_cast<int>(std::lround(value));
        if (key.path == "run.retries") settings_.retries = whole;
        if (key.path == "run.ranks") settings_.ranks = whole;
        if (key.path == "run.time_limit") settings_.time_limit = value;
        std::string_view const name = last_name(key.path);
        if (name == "time") batch_of(key).minutes = static_cast<int>(std::ceil(value / 60));
        if (name == "concurrent_tasks") batch_of(key).concurrent_tasks = whole;
        if (name == "cores_per_task") batch_of(key).cores_per_task = whole;
        if (name == "minutes_per_task") batch_of(key).minutes_per_task = whole;
    }

    /// What a key of a scheduler's section is about.
    BatchSettings& batch_of(Key const& key) {
        return key.path.starts_with("run.slurm.") ? settings_.slurm : settings_.pbs;
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
