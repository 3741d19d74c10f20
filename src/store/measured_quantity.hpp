#pragma once

#include "measure/stage_means.hpp"
#include "store/material_quantities.hpp"
#include "store/quantity.hpp"

#include <cmath>
#include <string_view>
#include <vector>

/// @file
/// Numbers that every packing measures, with their intervals over the packings.

namespace vibrotrough::store {

/// The way to a number of a packing that does not always exist.
using MeasuredNumber = Field<PackingRecord, std::optional<double>>;

/// Adds a number of the packings and the half-width of its interval, with one column each.
/// @tparam number  gives the way to it
/// @param view  of the number; that of the half-width has the same unit and the next places
template <MeasuredNumber (*number)()>
void add_measured(std::vector<Quantity>& rows, std::string_view name, std::string_view half_width_name,
                  std::string_view units, std::string_view meaning, View const& view) {
    View narrow{.place = view.place + 2,
                .unit = view.unit,
                .factor = view.factor,
                .format = view.format,
                .position = view.position + 1};
    if (view.terminal)
        narrow.terminal =
            TerminalView{.heading = "+-", .priority = view.terminal->priority, .only_when_known = true};
    if (view.report) narrow.report = ReportView{"\u00b1"};
    rows.push_back({name, units, meaning, number(), OverPackings::mean, {view}});
    rows.push_back({half_width_name,
                    units,
                    "Half-width of the interval of the number before it, Student's t over the packings",
                    +[](CaseRecord const& record) { return half_width_over_packings(record, number()); },
                    OverPackings::nothing,
                    {narrow}});
}

/// Mean and half-width over the packings of a number that each row of a table has.
class MeasuredColumn {
  public:
    /// A column without rows, whose intervals have this level.
    explicit MeasuredColumn(double confidence) : confidence_(confidence) {}

    /// The next row: the number of each packing.
    void add(measure::EnsembleNumber const& value) {
        means.push_back(value.mean());
        half_widths.push_back(value.half_width(confidence_));
    }
    /// Adds the means, and behind them the half-widths, to the columns of a table.
    void put_into(std::vector<CaseValues>& columns) const {
        columns.emplace_back(means);
        columns.emplace_back(half_widths);
    }

    std::vector<double> means = {};        ///< over the packings, row by row
    std::vector<double> half_widths = {};  ///< of their intervals; NaN with one packing

  private:
    double confidence_;
};

/// A column of a table of the packings.
using PackingColumn = std::vector<double> const& (*)(PackingRecord const&);

/// Mean and half-width of each row, over the packings that have a number there.
inline MeasuredColumn over_packings(CaseRecord const& record, PackingColumn column, std::size_t rows) {
    MeasuredColumn measured(record.scenario.measure.confidence);
    for (std::size_t row = 0; row < rows; ++row) {
        measure::EnsembleNumber number;
        for (PackingRecord const& packing : record.packings) {
            std::vector<double> const& values = column(packing);
            if (row < values.size() && !std::isnan(values[row])) number.values.push_back(values[row]);
        }
        measured.add(number);
    }
    return measured;
}

/// A column of the terminal's table that is left out when no case has a value.
constexpr TerminalView terminal_when_known(std::string_view heading, std::string_view unit) {
    return {.heading = heading, .subheading = unit, .priority = 4, .only_when_known = true};
}

}  // namespace vibrotrough::store
