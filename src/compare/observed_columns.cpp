#include "compare/columns.hpp"
#include "store/reference.hpp"

#include <algorithm>
#include <memory>

#include <fmt/format.h>

namespace vibrotrough::compare {
namespace {

Column column_of(std::string const& name, store::Observable const& observable, std::string meaning,
                 int place) {
    return {.name = name + unit_suffix(observable.unit),
            .unit = observable.unit,
            .value = +[](Row const&) -> std::optional<double> { return {}; },
            .meaning = std::move(meaning),
            .format = "{:.4g}",
            .observed = place};
}

}  // namespace

void add_observed(std::vector<Column>& columns, std::span<store::Observable const> observables) {
    int place = 0;
    for (store::Observable const& one : observables) {
        if (one.is_number() && !is_name_of_program(one.name, one.unit)) {
            auto const words = std::make_shared<std::string const>(one.name + one.unit);
            std::string_view const heading = std::string_view(*words).substr(0, one.name.size());
            std::string_view const unit =
                one.unit == "1" ? "" : std::string_view(*words).substr(one.name.size());
            Column mean = column_of(one.name, one, one.meaning, place);
            mean.terminal =
                TerminalView{.heading = heading, .subheading = unit, .priority = 1, .only_when_known = true};
            mean.report = ReportView{.heading = heading};
            Column half_width = column_of(
                one.name + "_half_width", one,
                fmt::format("Half-width of the interval of {} at measure.confidence", one.name), place + 1);
            half_width.terminal =
                TerminalView{.heading = "+-", .subheading = unit, .priority = 0, .only_when_known = true};
            mean.words = half_width.words = words;
            auto const outcome = std::ranges::find(columns, "outcome", &Column::name);
            columns.insert(columns.insert(outcome, std::move(half_width)), std::move(mean));
        }
        place += 2;
    }
}

bool is_name_of_program(std::string_view name, std::string const& unit) {
    std::string const with_unit = std::string(name) + unit_suffix(unit);
    auto const is_taken = [&](std::string_view one) { return one == name || one == with_unit; };
    return std::ranges::any_of(all_columns(),
                               [&](Column const& one) { return is_taken(one.name) || is_taken(one.key); }) ||
           std::ranges::any_of(store::quantities(),
                               [&](store::Quantity const& one) { return is_taken(one.name); }) ||
           std::ranges::any_of(store::old_names(),
                               [&](store::OldName const& one) { return is_taken(one.old); });
}

}  // namespace vibrotrough::compare
