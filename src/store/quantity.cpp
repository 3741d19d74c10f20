#include "store/quantity.hpp"

#include "measure/mass_flow.hpp"

#include <algorithm>
#include <stdexcept>

namespace vibrotrough::store {
namespace {

using Packings = std::vector<PackingRecord> const&;

/// The values of the packings that have one.
template <typename Value>
auto known_values(Packings packings, Field<PackingRecord, Value> const& field) {
    using Number = std::conditional_t<std::is_same_v<Value, int>, int, double>;
    std::vector<Number> known;
    for (PackingRecord const& packing : packings) {
        std::optional<Number> const value = field(packing);
        if (value) known.push_back(*value);
    }
    return known;
}

template <typename Number>
std::optional<Number> combined(std::vector<Number> const& values, OverPackings how) {
    Number sum{};
    for (Number const value : values) sum += value;
    if (how == OverPackings::sum) return sum;
    if (values.empty()) return {};
    return how == OverPackings::largest ? *std::ranges::max_element(values)
                                        : sum / static_cast<Number>(values.size());
}

template <typename Value>
CaseNumber combined(CaseRecord const& record, Field<PackingRecord, Value> const& field, OverPackings how) {
    if constexpr (std::is_same_v<Value, int>) {
        return combined(known_values(record.packings, field), how).value_or(0);
    } else if constexpr (std::is_convertible_v<Value, std::optional<double>>) {
        return combined(known_values(record.packings, field), how);
    } else {
        throw std::logic_error("texts of packings cannot be combined");
    }
}

}  // namespace

CaseNumber Quantity::of_case(CaseRecord const& record) const {
    return std::visit(
        [&]<typename Way>(Way const& way) -> CaseNumber {
            if constexpr (std::is_invocable_v<Way, CaseRecord const&>)
                return way(record);
            else
                return combined(record, way, over_packings);
        },
        of);
}

CaseNumber Quantity::type_of_case() const {
    if (of.index() == 0 || std::holds_alternative<Field<PackingRecord, int>>(of)) return 0;
    if (of.index() == 2) return std::string();
    return std::optional<double>();
}

std::string Quantity::meaning_of_case() const {
    std::string text(meaning);
    if (over_packings == OverPackings::mean) text += "; mean over the packings";
    if (over_packings == OverPackings::largest) text += "; the largest of any packing";
    if (over_packings == OverPackings::sum) text += "; sum over the packings";
    return text;
}

std::optional<double> mean_over_packings(CaseRecord const& record, MeasuredNumber const& number) {
    return combined(known_values(record.packings, number), OverPackings::mean);
}

std::optional<double> half_width_over_packings(CaseRecord const& record, MeasuredNumber const& number) {
    return measure::student_half_width(known_values(record.packings, number),
                                       record.scenario.measure.confidence);
}

void add_measured(std::vector<Quantity>& rows, MeasuredNumber const& number, MeasuredNames const& names,
                  std::string_view units, std::string_view meaning, View const& view) {
    View narrow{.unit = view.unit, .factor = view.factor, .format = view.format};
    if (view.terminal)
        narrow.terminal =
            TerminalView{.heading = "+-", .priority = view.terminal->priority, .only_when_known = true};
    if (view.report) narrow.report = ReportView{"\u00b1"};
    rows.push_back({names.name, units, meaning, number, OverPackings::mean, {view}, true});
    rows.push_back(
        {names.half_width,
         units,
         "Half-width of the interval of the number before it, Student's t over the packings",
         Quantity::Real([number](CaseRecord const& one) { return half_width_over_packings(one, number); }),
         OverPackings::nothing,
         {narrow},
         true});
}

}  // namespace vibrotrough::store
