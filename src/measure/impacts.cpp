#include "measure/impacts.hpp"

#include "core/csv.hpp"
#include "core/error.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <sstream>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace vibrotrough::measure {
namespace {

constexpr std::string_view columns = "step,first,second,energy,brief", first_words = "# impacts in ";

/// A contact of a list. Contacts are sorted by their grains.
struct ListedContact {
    int first, second;  ///< 0 for the trough
    double overlap;     ///< m

    std::pair<int, int> key() const { return {first, second}; }
};

/// The contacts at one step.
struct ContactList {
    long step = 0;
    std::vector<ListedContact> contacts;

    ListedContact const* find(std::pair<int, int> key) const {
        auto const found = std::ranges::lower_bound(contacts, key, {}, &ListedContact::key);
        return found != contacts.end() && found->key() == key ? &*found : nullptr;
    }
};

/// Two periodic images of a grain, and two triangles of the trough, make one contact with the largest
/// overlap.
void merge(std::vector<ListedContact>& contacts) {
    std::ranges::sort(contacts, [](ListedContact const& a, ListedContact const& b) {
        return a.key() != b.key() ? a.key() < b.key() : a.overlap > b.overlap;
    });
    auto const rest =
        std::unique(contacts.begin(), contacts.end(),
                    [](ListedContact const& a, ListedContact const& b) { return a.key() == b.key(); });
    contacts.erase(rest, contacts.end());
}

/// Reads the lists of a file one after another.
class ContactListReader {
  public:
    ContactListReader(core::TextFile const& file, bool with_trough)
        : file_(file), rest_(file.content), with_trough_(with_trough) {}

    /// Whether there is another list.
    bool at_end() const { return rest_.empty(); }

    /// None when the file ends within it.
    std::optional<ContactList> next() {
        std::array<std::string_view, 9> head;
        for (std::string_view& line : head)
            if (!take_line(line)) return {};
        ContactList list;
        if (head[0] != "ITEM: TIMESTEP" || !head[8].starts_with("ITEM: ENTRIES ")) refuse();
        list.step = static_cast<long>(numbers_of<1>(head[1])[0]);
        double const count = numbers_of<1>(head[3])[0];
        if (!(count >= 0 && count < 1e9)) refuse();
        for (std::string_view line; static_cast<double>(list.contacts.size()) < count;) {
            if (!take_line(line)) return {};
            list.contacts.push_back(contact_of(numbers_of<4>(line)));
        }
        merge(list.contacts);
        return list;
    }

    [[noreturn]] void refuse() const {
        throw core::InputError(fmt::format("{} is damaged; run its case again", file_.path.string()));
    }

  private:
    /// Whether there is a whole line.
    bool take_line(std::string_view& line) {
        auto const end = rest_.find('\n');
        if (end == std::string_view::npos) return false;
        line = rest_.substr(0, end);
        rest_.remove_prefix(end + 1);
        return true;
    }

    template <std::size_t count>
    std::array<double, count> numbers_of(std::string_view line) const {
        std::array<double, count> numbers{};
        char const* at = line.data();
        char const* const end = line.data() + line.size();
        for (double& number : numbers) {
            while (at != end && *at == ' ') ++at;
            auto const [next, failure] = std::from_chars(at, end, number);
            if (failure != std::errc()) refuse();
            at = next;
        }
        while (at != end && *at == ' ') ++at;
        if (at != end) refuse();
        return numbers;
    }

    ListedContact contact_of(std::array<double, 4> const& numbers) const {
        auto const grain = [&](double number) {
            if (!(number >= 1 && number <= std::numeric_limits<int>::max())) refuse();
            return static_cast<int>(number);
        };
        if (!(numbers[3] >= 0)) refuse();
        if (with_trough_) return {grain(numbers[2]), 0, numbers[3]};
        int const one = grain(numbers[0]), other = grain(numbers[1]);
        return {std::min(one, other), std::max(one, other), numbers[3]};
    }

    core::TextFile const& file_;
    std::string_view rest_;
    bool with_trough_;
};

/// The impact of a contact that is new in a list.
Impact impact_of(long step, ListedContact const& contact, ContactList const& next, double time_step,
                 ImpactKinds const& kinds) {
    ImpactKind const kind = kinds(contact.first, contact.second);
    ListedContact const* const later = next.find(contact.key());
    double const between = static_cast<double>(next.step - step) * time_step;
    auto const energy = later != nullptr
                            ? kind.law->energy(kind.pair, contact.overlap, later->overlap, between)
                            : std::nullopt;
    return {step, contact.first, contact.second,
            energy.value_or(kind.law->elastic_energy(kind.pair, contact.overlap)), !energy};
}

/// The energy above which half of the energy of all impacts is; none without impacts.
std::optional<double> middle_energy(std::vector<double> energies) {
    std::ranges::sort(energies, std::greater());
    double all = 0, sum = 0;
    for (double const energy : energies) all += energy;
    for (double const energy : energies) {
        sum += energy;
        if (sum >= all / 2) return energy;
    }
    return {};
}

int class_of(double energy) {
    constexpr double least = 1e-30;
    return static_cast<int>(std::floor(classes_per_decade * std::log10(std::max(energy, least))));
}

double lower_end(int energy_class) {
    return std::pow(10, static_cast<double>(energy_class) / classes_per_decade);
}

}  // namespace

std::optional<SeenImpacts> find_impacts(core::TextFile const& file, bool with_trough, double time_step,
                                        ImpactKinds const& kinds) {
    ContactListReader reader(file, with_trough);
    SeenImpacts seen;
    std::optional<ContactList> before = reader.at_end() ? std::nullopt : reader.next();
    std::optional<ContactList> now = !before || reader.at_end() ? std::nullopt : reader.next();
    if (!now) return {};
    long const start = before->step;
    double contacts = static_cast<double>(before->contacts.size()), lists = 1;
    while (!reader.at_end()) {
        std::optional<ContactList> next = reader.next();
        if (!next) return {};
        if (!(before->step < now->step && now->step < next->step)) reader.refuse();
        for (ListedContact const& contact : now->contacts)
            if (contact.overlap > 0 && before->find(contact.key()) == nullptr)
                seen.impacts.push_back(impact_of(now->step, contact, *next, time_step, kinds));
        seen.watched = now->step - start;
        contacts += static_cast<double>(now->contacts.size());
        lists += 1;
        before = std::move(now);
        now = std::move(next);
    }
    seen.contacts = contacts / lists;
    return seen;
}

std::string impacts_text(ImpactList const& list) {
    std::string text =
        fmt::format("{}{} s with {} contacts of a grain; energies in J; second is 0 for the trough\n{}\n",
                    first_words, list.watched, list.coordination, columns);
    for (Impact const& one : list.impacts)
        text += fmt::format("{},{},{},{:.6g},{:d}\n", one.step, one.first, one.second, one.energy, one.brief);
    return text;
}

ImpactList parse_impacts(core::TextFile const& file) {
    std::string const name = file.path.string();
    ImpactList list{{}, 0, 0};
    std::istringstream head(file.content.substr(0, file.content.find('\n')));
    std::string words(first_words.size(), ' '), unit, with;
    head.read(words.data(), static_cast<std::streamsize>(words.size()));
    head >> list.watched >> unit >> with >> list.coordination;
    if (!head || words != first_words || !(list.watched > 0) || !file.content.ends_with('\n'))
        throw core::InputError(fmt::format("{} is damaged; run its case again", name));
    core::CsvReader table(file.content, name, {.comments = true, .cure = "run its case again"});
    std::array<double, 5> row{};
    if (table.columns().size() != row.size()) table.fail("the columns are not those of impacts", {});
    while (table.next(row))
        list.impacts.push_back({static_cast<long>(row[0]), static_cast<int>(row[1]), static_cast<int>(row[2]),
                                row[3], row[4] != 0});
    return list;
}

Impacts impacts_of(ImpactList const& list, double mass) {
    Impacts impacts;
    std::array<std::vector<double>, 2> energies;  // between grains, with the trough
    int lowest = std::numeric_limits<int>::max(), highest = std::numeric_limits<int>::min();
    double brief = 0;
    for (Impact const& one : list.impacts) {
        energies.at(one.second == 0 ? 1 : 0).push_back(one.energy);
        lowest = std::min(lowest, class_of(one.energy));
        highest = std::max(highest, class_of(one.energy));
        brief += one.brief ? 1 : 0;
    }
    double const per_time_and_mass = 1 / (list.watched * mass);
    auto const power = [&](std::vector<double> const& values) {
        double sum = 0;
        for (double const energy : values) sum += energy;
        return sum * per_time_and_mass;
    };
    auto const count = static_cast<double>(list.impacts.size());
    impacts.number = count;
    impacts.power = power(energies[0]);
    impacts.trough_power = power(energies[1]);
    impacts.energy = middle_energy(energies[0]);
    impacts.trough_energy = middle_energy(energies[1]);
    if (count == 0) return impacts;
    impacts.brief_share = brief / count;
    for (int i = lowest; i <= highest; ++i) {
        impacts.from.push_back(lower_end(i));
        impacts.to.push_back(lower_end(i + 1));
    }
    impacts.rate.resize(impacts.from.size());
    impacts.trough_rate.resize(impacts.from.size());
    for (Impact const& one : list.impacts) {
        auto const place = static_cast<std::size_t>(class_of(one.energy) - lowest);
        (one.second == 0 ? impacts.trough_rate : impacts.rate)[place] += per_time_and_mass;
    }
    return impacts;
}

}  // namespace vibrotrough::measure
