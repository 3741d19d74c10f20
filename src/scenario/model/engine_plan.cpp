#include "scenario/model/engine_plan.hpp"

#include "scenario/model/run_settings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::scenario {

std::string_view name_of(ContactModel model) {
    return contact_words.at(static_cast<std::size_t>(model));
}

bool is_template_name(std::string_view name) {
    constexpr std::string_view ending = ".mustache";
    return is_plain_text(name) && name.size() > ending.size() && name.size() <= 100 &&
           name.ends_with(ending) && name.front() != '.' && name.front() != '-';
}

std::string not_covered(EnginePlan const& plan) {
    std::vector<std::string> parts;
    if (plan.contact != ContactModel::hertz)
        parts.push_back(fmt::format("contact {}", name_of(plan.contact)));
    if (plan.tangential_damping) parts.emplace_back("tangential damping");
    if (plan.cohesion > 0) parts.emplace_back("cohesion sjkr");
    if (plan.templates) {
        for (NamedFile const& file : plan.templates->files) parts.push_back("template " + file.name);
    }
    return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace vibrotrough::scenario
