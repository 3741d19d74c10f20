#include "deck/contact_columns.hpp"

#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::deck {
namespace {

/// The columns of one of these computes, in the engine's order: two places (6 columns), numbers (3), normal
/// force (3), tangential force (3), overlap.
class ContactColumns {
  public:
    ContactColumns(std::string name, bool frames) : name_(std::move(name)), frames_(frames) {}

    /// What the compute is asked for.
    std::string words() const { return frames_ ? "pos id force_normal force_tangential delta" : "delta"; }
    /// The column of the overlap.
    int overlap() const { return frames_ ? 16 : 1; }
    /// What the frames write: all of them.
    std::string of_frames() const {
        std::vector<std::string> columns;
        for (int column = 1; column <= overlap(); ++column)
            columns.push_back(fmt::format("c_{}[{}]", name_, column));
        return fmt::format("{}", fmt::join(columns, " "));
    }

  private:
    std::string name_;
    bool frames_;
};

}  // namespace

void describe_contact_columns(core::TemplateData& data, bool frames) {
    ContactColumns const of_grains("overlaps", frames), of_floor("floor_contacts", true);
    data.set("contacts", frames);
    data.set("overlap_words", of_grains.words());
    data.set("floor_contact_words", of_floor.words());
    data.set("overlap_column", std::to_string(of_grains.overlap()));
    data.set("contact_columns", frames ? of_grains.of_frames() : std::string());
    data.set("trough_contact_columns", frames ? of_floor.of_frames() : std::string());
}

}  // namespace vibrotrough::deck
