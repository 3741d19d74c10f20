#include "scenario/reader/campaign_file.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "scenario/model/softness.hpp"
#include "scenario/reader/case_maker.hpp"
#include "scenario/reader/case_values.hpp"
#include "scenario/reader/file_reader.hpp"

#include <fmt/format.h>

namespace vibrotrough::scenario {
namespace {

constexpr std::size_t most_cases = 100'000;
constexpr std::size_t cases_per_thread = 256;  // so many are worth a thread: one takes some 10 us

std::size_t count_cases(CampaignText const& text, std::string const& file) {
    std::size_t count = 1;
    auto const multiply = [&](std::size_t values, Position where) {
        count *= values;
        if (count > most_cases) {
            throw_at({file, where}, "sweep", fmt::format("the sweep makes more than {} cases", most_cases),
                     "list fewer values");
        }
    };
    for (Axis const& axis : text.sweep) multiply(axis.values.size(), axis.where);
    for (PointList const& list : text.lists) multiply(list.points.size(), list.where);
    return count;
}

/// The values of case number `index`. The last list varies fastest; after all lists comes the last axis.
CaseValues pick(CampaignText const& text, std::size_t index) {
    CaseValues values = text.base;
    for (auto list = text.lists.rbegin(); list != text.lists.rend(); ++list) {
        auto const& point = list->points[index % list->points.size()];
        for (std::size_t k = 0; k < point.size(); ++k) set_value(values, list->keys[k], point[k]);
        index /= list->points.size();
    }
    for (auto axis = text.sweep.rbegin(); axis != text.sweep.rend(); ++axis) {
        set_value(values, axis->key, {axis->values[index % axis->values.size()], axis->where});
        index /= axis->values.size();
    }
    return values;
}

/// The keys of the sweep and of the lists, in the order in which they are combined.
std::vector<Key const*> varied_keys(CampaignText const& text) {
    std::vector<Key const*> keys;
    for (Axis const& axis : text.sweep) keys.push_back(find_key(axis.key));
    for (PointList const& list : text.lists) {
        for (std::string const& key : list.keys) keys.push_back(find_key(key));
    }
    return keys;
}

}  // namespace

Campaign parse_campaign(std::string_view text, std::string const& name, FileSource const& source) {
    CampaignText const parsed = read_campaign_text(text, name);
    Campaign campaign{parsed.name, {}, parsed.run, parsed.files, 0};
    std::size_t const count = count_cases(parsed, name);
    campaign.cases.resize(count);
    std::vector<char> left_out(count);  // not bool: several threads write into it
    core::for_each_index(count, cases_per_thread, [&] {
        return [&](std::size_t index) {
            CaseValues const values = pick(parsed, index);
            campaign.cases[index] = make_scenario(values, name, source);
            left_out[index] = is_excluded(campaign.cases[index], values, parsed.exclusions) ? 1 : 0;
        };
    });
    std::size_t kept = 0;
    for (std::size_t index = 0; index < count; ++index) {
        if (left_out[index] == 0 && kept++ != index)
            campaign.cases[kept - 1] = std::move(campaign.cases[index]);
    }
    campaign.cases.resize(kept);
    campaign.excluded = count - kept;
    if (campaign.cases.empty()) {
        throw_at({name, parsed.exclusions.front().front().where}, "exclude", "all cases are left out",
                 "exclude fewer");
    }
    auto const modulus = modulus_of_domain(parsed, name, source);
    for (Scenario& one : campaign.cases) give_modulus(one, modulus);
    choose_modulus(campaign.cases);
    campaign.swept = swept_keys(varied_keys(parsed), campaign.cases);
    return campaign;
}

Campaign read_campaign(std::filesystem::path const& path) {
    constexpr std::uintmax_t largest = 4 << 20;
    std::error_code failure;
    if (std::filesystem::file_size(path, failure) > largest && !failure) {
        throw core::InputError(fmt::format(
            "{}: the file is larger than 4 MiB, too large for a campaign; check the path", path.string()));
    }
    if (!std::filesystem::is_regular_file(path, failure)) {
        throw core::InputError(
            fmt::format("{}: there is no such file; give the path of a campaign file (TOML)", path.string()));
    }
    return parse_campaign(core::read_given_file(path), path.string(), {path.parent_path(), {}});
}

}  // namespace vibrotrough::scenario
