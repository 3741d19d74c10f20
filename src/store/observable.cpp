#include "store/observable.hpp"

#include "core/hash.hpp"
#include "core/quantity.hpp"
#include "store/hdf5_file.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>

namespace vibrotrough::store {
namespace {

constexpr std::size_t longest_name = 60;
constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz";

// In the order in which add_observables() writes them; the mean has the unit and the meaning of its
// observable.
constexpr std::array known_observables{
    ObservableEntry{"mean", "float64", "cases", "of the observable",
                    "Mean over the packings of a number; NaN in cases where it was not measured"},
    ObservableEntry{"half_width", "float64", "cases", "of the observable",
                    "Half-width of its interval at measure.confidence; NaN when it is unbounded"},
    ObservableEntry{"steadiness", "text", "cases", "1",
                    "steady, drifting (the cycles kept still change in one direction) or branching (packings "
                    "that started below and above differ), by the tests of the efficiency without tolerance"},
    ObservableEntry{"curve/case", "text", "points", "1", "Of a curve: the case, for each point"},
    ObservableEntry{"curve/at", "float64", "points", "of the axis", "Where the point is"},
    ObservableEntry{"curve/mean", "float64", "points", "of the observable", "As that of a number"},
    ObservableEntry{"curve/half_width", "float64", "points", "of the observable", "As that of a number"},
    ObservableEntry{"curve/steadiness", "text", "points", "1", "As that of a number"},
    ObservableEntry{"packings", "int32", "cases", "1", "Number of packings that it was measured in"},
    ObservableEntry{"cycles_discarded", "int32", "cases", "1",
                    "Cycles of each packing that are left out as start-up"},
    ObservableEntry{"cycles_measured", "int32", "cases", "1", "Cycles of each packing that are kept"},
    ObservableEntry{"file", "text", "1", "1", "Name of the file with the function"},
    ObservableEntry{"source", "text", "1", "1", "Text of that file"},
    ObservableEntry{"source_sha256", "text", "1", "1", "SHA-256 of that file"},
};

double or_nan(std::optional<double> const& value) {
    return value.value_or(std::numeric_limits<double>::quiet_NaN());
}

/// Writes the datasets of one observable below observables/NAME.
class Group {
  public:
    Group(Hdf5Writer& file, std::span<CaseRecord const> cases, Observable const& observable)
        : file_(file), cases_(cases), observable_(observable) {}

    void write() {
        observable_.is_number() ? write_numbers() : write_curve();
        count("packings", [](ObservedCase const& one) { return static_cast<int>(one.packings.size()); });
        count("cycles_discarded", [](ObservedCase const& one) { return one.discarded; });
        count("cycles_measured", [](ObservedCase const& one) { return one.measured; });
        text("file", observable_.file);
        text("source", observable_.source);
        text("source_sha256", observable_.sha256);
    }

  private:
    void put(std::string_view name, Values const& values, std::string_view unit, std::string_view meaning) {
        file_.dataset(fmt::format("observables/{}/{}", observable_.name, name), values, unit, meaning);
    }

    static std::string_view meaning_of(std::string_view name) {
        return std::ranges::find(known_observables, name, &ObservableEntry::name)->meaning;
    }

    void text(std::string_view name, std::string const& value) {
        put(name, std::vector<std::string>{value}, "1", meaning_of(name));
    }

    template <typename Function>
    void count(std::string_view name, Function const& value_of) {
        std::vector<int> values;
        for (CaseRecord const& record : cases_) {
            ObservedCase const* const one = observable_.of(record);
            values.push_back(one == nullptr ? 0 : value_of(*one));
        }
        put(name, values, "1", meaning_of(name));
    }

    void write_numbers() {
        std::vector<double> means, half_widths;
        std::vector<std::string> words;
        for (CaseRecord const& record : cases_) {
            ObservedCase const* const one = observable_.of(record);
            ObservedValue const value = one == nullptr ? ObservedValue{} : one->values.front();
            means.push_back(or_nan(value.mean));
            half_widths.push_back(or_nan(value.half_width));
            words.push_back(value.steadiness);
        }
        put("mean", means, observable_.unit, observable_.meaning);
        put("half_width", half_widths, observable_.unit, meaning_of("half_width"));
        put("steadiness", words, "1", meaning_of("steadiness"));
    }

    void write_curve() {
        std::vector<std::string> ids, words;
        std::vector<double> at, means, half_widths;
        for (CaseRecord const& record : cases_) {
            ObservedCase const* const one = observable_.of(record);
            if (one == nullptr) continue;
            for (std::size_t i = 0; i < one->at.size(); ++i) {
                ids.push_back(record.id);
                at.push_back(one->at[i]);
                means.push_back(or_nan(one->values[i].mean));
                half_widths.push_back(or_nan(one->values[i].half_width));
                words.push_back(one->values[i].steadiness);
            }
        }
        file_.table(fmt::format("observables/{}/curve", observable_.name),
                    {{"case", "1", meaning_of("curve/case"), ids},
                     {"at", observable_.over_unit, observable_.over, at},
                     {"mean", observable_.unit, observable_.meaning, means},
                     {"half_width", observable_.unit, meaning_of("curve/half_width"), half_widths},
                     {"steadiness", "1", meaning_of("curve/steadiness"), words}});
    }

    Hdf5Writer& file_;
    std::span<CaseRecord const> cases_;
    Observable const& observable_;
};

}  // namespace

ObservedCase const* Observable::of(CaseRecord const& record) const {
    auto const found = std::ranges::find(cases, record.id, &ObservedCase::id);
    return found == cases.end() || found->result != mark_of(record) ? nullptr : &*found;
}

bool is_observable_name(std::string_view name) {
    bool const is_word = name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == name.npos;
    return is_word && !name.empty() && name.size() <= longest_name && letters.find(name.front()) != name.npos;
}

bool is_plain_unit(std::string const& unit) {
    constexpr std::size_t longest = 40;
    if (unit == "1") return true;
    bool const is_plain = std::ranges::all_of(unit, [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               std::string_view(" /-^.").find(c) != std::string_view::npos;
    });
    if (!is_plain || unit.empty() || unit.size() > longest) return false;
    try {
        core::parse_quantity("1 " + unit, unit);
        return true;
    } catch (core::QuantityError const&) {
        return false;
    }
}

std::string mark_of(CaseRecord const& record) {
    std::string facts = record.id;
    for (PackingRecord const& packing : record.packings) {
        facts += fmt::format(" {} {} {} {}", packing.seed, packing.estimate.discarded,
                             packing.estimate.measured, packing.estimate.mean);
    }
    return core::sha256_hex(facts);
}

std::string_view name_of(measure::Steadiness steadiness) {
    switch (steadiness) {
        case measure::Steadiness::drifting:
            return "drifting";
        case measure::Steadiness::branching:
            return "branching";
        case measure::Steadiness::steady:
            break;
    }
    return "steady";
}

void add_observables(Hdf5Writer& file, std::span<CaseRecord const> cases,
                     std::span<Observable const> observables) {
    for (Observable const& one : observables) Group(file, cases, one).write();
}

std::span<ObservableEntry const> observable_entries() {
    return known_observables;
}

}  // namespace vibrotrough::store
