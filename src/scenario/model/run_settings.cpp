#include "scenario/model/run_settings.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::scenario {
namespace {

bool is_letter_or_digit(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

/// Names of options that ask for resources, for mail, or for a warning before the end, and do nothing else.
/// --clusters is not among them: squeue and sacct would have to be told where the job went.
constexpr std::array<std::string_view, 20> options_of_sbatch{
    "comment",    "constraint", "cores-per-socket", "exclude",       "exclusive", "gpus",
    "gres",       "hint",       "licenses",         "requeue",       "signal",    "mail-type",
    "mail-user",  "nice",       "nodelist",         "oversubscribe", "qos",       "reservation",
    "spread-job", "tmp"};

bool is_option_value(std::string_view text) {
    constexpr std::string_view others = "._,:@%+&|()[]*=-";
    return std::ranges::all_of(
        text, [&](char c) { return is_letter_or_digit(c) || others.find(c) != others.npos; });
}

}  // namespace

bool is_plain_text(std::string_view text) {
    return std::ranges::all_of(
        text, [](char c) { return is_letter_or_digit(c) || c == '.' || c == '_' || c == '-'; });
}

std::optional<PlainName> PlainName::from(std::string_view text) {
    if (text.empty() || text.size() > 64 || !is_plain_text(text) || !is_letter_or_digit(text.front()))
        return {};
    return PlainName(text);
}

std::optional<BatchOption> SlurmOption::from(std::string_view text) {
    if (text.size() > 200 || !text.starts_with("--")) return {};
    auto const equals = text.find('=');
    std::string_view const name = text.substr(2, equals == text.npos ? text.npos : equals - 2);
    if (std::ranges::find(options_of_sbatch, name) == options_of_sbatch.end()) return {};
    if (equals != text.npos && !is_option_value(text.substr(equals + 1))) return {};
    return BatchOption(text);
}

std::string SlurmOption::names() {
    return fmt::format("--{}", fmt::join(options_of_sbatch, ", --"));
}

BatchSettings const& RunSettings::batch(std::string_view scheduler) const {
    static BatchSettings const nothing{};
    return scheduler == "slurm" ? slurm : nothing;
}

}  // namespace vibrotrough::scenario
