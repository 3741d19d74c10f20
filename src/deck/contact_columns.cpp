#include "deck/contact_columns.hpp"

#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::deck {
namespace {

/// The columns of one of these computes, in the engine's order: two places (6 columns), numbers (3), normal
/// force (3), tangential force (3), torque (3), overlap.
class ContactColumns {
  public:
    ContactColumns(std::string name, bool frames, bool torque, bool overlap)
        : name_(std::move(name)), frames_(frames), torque_(torque), overlap_(overlap) {}

    /// What the compute is asked for.
    std::string words() const {
        std::string words = frames_ ? "pos id force_normal force_tangential" : "";
        if (torque_) words += words.empty() ? "torque" : " torque";
        if (overlap_) words += words.empty() ? "delta" : " delta";
        return words;
    }
    /// The second of the torque's three columns, about y.
    int torque() const { return before_torque() + 2; }
    /// The column of the overlap.
    int overlap() const { return before_torque() + (torque_ ? 3 : 0) + 1; }
    /// What the frames write: all but the torque.
    std::string of_frames() const { return columns(1, 15); }

  private:
    int before_torque() const { return frames_ ? 15 : 0; }
    /// "c_NAME[from] ... c_NAME[to] c_NAME[overlap]"
    std::string columns(int from, int to) const {
        std::vector<std::string> columns;
        for (int column = from; column <= to; ++column)
            columns.push_back(fmt::format("c_{}[{}]", name_, column));
        columns.push_back(fmt::format("c_{}[{}]", name_, overlap()));
        return fmt::format("{}", fmt::join(columns, " "));
    }

    std::string name_;
    bool frames_, torque_, overlap_;
};

}  // namespace

void describe_contact_columns(core::TemplateData& data, bool frames, scenario::MeasurementPlan const& plan) {
    ContactColumns const of_grains("overlaps", frames, false, true),
        of_floor("floor_contacts", frames, plan.rolling, frames);
    data.set("contacts", frames);
    data.set("overlap_words", of_grains.words());
    data.set("floor_contact_words", of_floor.words());
    data.set("overlap_column", std::to_string(of_grains.overlap()));
    data.set("floor_torque_column", std::to_string(of_floor.torque()));
    data.set("contact_columns", frames ? of_grains.of_frames() : std::string());
    data.set("trough_contact_columns", frames ? of_floor.of_frames() : std::string());
}

}  // namespace vibrotrough::deck
