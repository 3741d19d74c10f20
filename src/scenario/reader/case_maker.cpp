#include "scenario/reader/case_maker.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "scenario/model/softness.hpp"
#include "scenario/reader/value_reader.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::scenario {

CaseMaker::CaseMaker(std::filesystem::path const& campaign_file)
    : file_(campaign_file.string()),
      text_(read_campaign_text(core::read_file(campaign_file), file_)),
      source_{campaign_file.parent_path(), {}},
      modulus_(modulus_of_domain(text_, file_, source_)) {
    auto const add = [&](std::string const& key) {
        if (std::ranges::find(varied_, key) == varied_.end()) varied_.push_back(key);
    };
    for (Axis const& axis : text_.sweep) add(axis.key);
    for (PointList const& list : text_.lists) std::ranges::for_each(list.keys, add);
}

Scenario CaseMaker::make(std::map<std::string, Content> const& values) const {
    CaseValues all = text_.base;
    for (auto const& [key, value] : values) set_value(all, key, {value, {}});
    Scenario made = make_scenario(all, file_, source_);
    give_modulus(made, modulus_);
    return made;
}

std::string CaseMaker::full_key(std::string const& name) const {
    std::vector<std::string> found;
    for (std::string const& key : varied_) {
        if (key == name) return key;
        if (last_name(key) == name) found.push_back(key);
    }
    if (found.size() == 1) return found.front();
    if (!found.empty()) {
        throw core::InputError(
            fmt::format("{} may be {}; write the whole key", name, fmt::join(found, " or ")));
    }
    throw core::InputError(
        fmt::format("{} is not varied in this campaign; its inputs are {}", name, fmt::join(varied_, ", ")));
}

std::optional<double> modulus_of_domain(CampaignText const& text, std::string const& file,
                                        FileSource const& source) {
    std::vector<Scenario> corners;
    std::size_t const count = text.domain.empty() ? 0 : std::size_t{1} << text.domain.size();
    for (std::size_t corner = 0; corner < count; ++corner) {
        CaseValues values = text.base;
        for (std::size_t k = 0; k < text.domain.size(); ++k)
            set_value(values, text.domain[k].key, {text.domain[k].at(corner >> k & 1 ? 1 : 0), {}});
        try {
            corners.push_back(make_scenario(values, file, source));
        } catch (core::InputError const&) {
            // Not every corner need be a case: exclusions and lists may keep the cases away from it.
        }
    }
    if (corners.empty() || corners.front().grains.youngs_modulus) return {};
    choose_modulus(corners);
    return corners.front().grains.youngs_modulus;
}

Content CaseMaker::read_value(std::string const& key, std::string const& text) const {
    return read_plain_content(*find_key(key), text);
}

}  // namespace vibrotrough::scenario
