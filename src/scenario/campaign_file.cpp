#include "scenario/campaign_file.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "scenario/case_values.hpp"
#include "scenario/file_reader.hpp"

#include <fmt/format.h>

namespace vibrotrough {
namespace {

constexpr std::size_t most_cases = 100'000;

std::size_t count_cases(CampaignText const& text, std::string const& file) {
    std::size_t count = 1;
    for (Axis const& axis : text.sweep) {
        count *= axis.values.size();
        if (count > most_cases) {
            throw_at({file, axis.where}, "sweep",
                     fmt::format("the sweep makes more than {} cases", most_cases), "list fewer values");
        }
    }
    return count;
}

/// The values of case number `index`: the last axis runs fastest.
CaseValues pick(CampaignText const& text, std::size_t index) {
    CaseValues values = text.base;
    for (auto axis = text.sweep.rbegin(); axis != text.sweep.rend(); ++axis) {
        std::string_view const group = find_key(axis->key)->group;
        if (!group.empty()) {
            std::erase_if(values, [&](auto const& entry) { return find_key(entry.first)->group == group; });
        }
        values[axis->key] = {axis->values[index % axis->values.size()], axis->where};
        index /= axis->values.size();
    }
    return values;
}

}  // namespace

Campaign parse_campaign(std::string_view text, std::string const& name, FileSource const& source) {
    CampaignText const parsed = read_campaign_text(text, name);
    Campaign campaign{parsed.name, {}};
    std::size_t const count = count_cases(parsed, name);
    for (std::size_t index = 0; index < count; ++index) {
        campaign.cases.push_back(make_scenario(parsed.name, pick(parsed, index), name, source));
    }
    return campaign;
}

Campaign read_campaign(std::filesystem::path const& path) {
    constexpr std::uintmax_t largest = 4 << 20;
    std::error_code failure;
    if (std::filesystem::file_size(path, failure) > largest && !failure) {
        throw InputError(
            fmt::format("{}: the file is larger than 4 MiB, which no campaign needs; is it the right one?",
                        path.string()));
    }
    if (!std::filesystem::is_regular_file(path, failure)) {
        throw InputError(
            fmt::format("{}: there is no such file; give the path of a campaign file (TOML)", path.string()));
    }
    return parse_campaign(read_file(path), path.string(), {path.parent_path(), {}});
}

}  // namespace vibrotrough
