#include "evaluate/impacts.hpp"

#include "core/error.hpp"
#include "deck/atom_types.hpp"
#include "deck/impacts.hpp"
#include "measure/impacts.hpp"
#include "prepare/contact.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace vibrotrough::evaluate {
namespace {

namespace fs = std::filesystem;

struct Grain {
    int type;             ///< of the engine
    double radius, mass;  ///< m, kg
};

using GrainsByNumber = std::map<int, Grain>;

[[noreturn]] void refuse(fs::path const& path) {
    throw core::InputError(fmt::format("{} is damaged; run its case again", path.string()));
}

/// The grains at the beginning and at the end of a cycle.
GrainsByNumber read_grains(core::TextFile const& file) {
    GrainsByNumber grains;
    std::istringstream text(file.content);
    std::string line;
    bool in_list = false;
    while (std::getline(text, line)) {
        if (line.starts_with("ITEM: ")) {
            in_list = line.starts_with("ITEM: ATOMS id type radius mass");
            continue;
        }
        if (!in_list) continue;
        std::istringstream numbers(line);
        int number = 0;
        Grain grain{};
        if (!(numbers >> number >> grain.type >> grain.radius >> grain.mass)) refuse(file.path);
        grains[number] = grain;
    }
    return grains;
}

/// The law of a pair of atom types, made when it is first needed.
class Laws {
  public:
    explicit Laws(prepare::PreparedCase const& prepared)
        : prepared_(prepared),
          types_(deck::atom_types(prepared)),
          force_(prepared.scenario.engine.contact == scenario::ContactModel::hooke
                     ? measure::ContactForce::spring
                     : measure::ContactForce::hertz) {}

    measure::ImpactKind between(Grain const& one, Grain const* other) {
        scenario::Material const& material = material_of(one);
        double restitution = material.trough_restitution;
        prepare::ContactPair pair{one.radius, one.mass};
        if (other != nullptr) {
            restitution = contact_of(prepared_.scenario, material, material_of(*other)).restitution;
            pair = {one.radius * other->radius / (one.radius + other->radius),
                    one.mass * other->mass / (one.mass + other->mass)};
        }
        auto const law = laws_.try_emplace(restitution, force_, restitution).first;
        return {{pair.mass, stiffness_of(pair)}, &law->second};
    }

  private:
    scenario::Material const& material_of(Grain const& grain) const {
        return *types_.at(static_cast<std::size_t>(grain.type - 1)).material;
    }
    double stiffness_of(prepare::ContactPair const& pair) const {
        scenario::Grains const& grains = prepared_.scenario.grains;
        return force_ == measure::ContactForce::spring
                   ? prepare::hooke_stiffness(grains, pair, prepared_.time.impact_speed)
                   : 4.0 / 3 * prepare::effective_modulus(grains) * std::sqrt(pair.radius);
    }

    prepare::PreparedCase const& prepared_;
    std::vector<deck::AtomType> types_;
    measure::ContactForce force_;
    std::map<double, measure::ImpactLaw> laws_;  ///< by restitution
};

std::vector<fs::path> files_of_cycle(fs::path const& folder, int done) {
    return {folder / deck::grain_contacts_file(done), folder / deck::floor_contacts_file(done),
            folder / deck::masses_file(done)};
}

/// Adds the impacts of a cycle. Returns false when a file is missing or incomplete.
bool add_cycle(measure::ImpactList& list, std::vector<fs::path> const& files, double time_step, Laws& laws) {
    std::error_code missing;
    for (fs::path const& path : files)
        if (!fs::is_regular_file(path, missing)) return false;
    GrainsByNumber const grains = read_grains(core::read_text_file(files[2]));
    auto const kind = [&](int first, int second) {
        auto const one = grains.find(first), other = grains.find(second);
        if (one == grains.end() || (second != 0 && other == grains.end())) refuse(files[2]);
        return laws.between(one->second, second == 0 ? nullptr : &other->second);
    };
    double watched = 0, contacts = 0;
    for (bool const with_trough : {false, true}) {
        core::TextFile const file = core::read_text_file(files[with_trough ? 1 : 0]);
        auto seen = measure::find_impacts(file, with_trough, time_step, kind);
        if (!seen) return false;
        watched = static_cast<double>(seen->watched) * time_step;
        contacts += (with_trough ? 1 : 2) * seen->contacts / static_cast<double>(grains.size());
        list.impacts.insert(list.impacts.end(), seen->impacts.begin(), seen->impacts.end());
    }
    double const before = list.watched;
    list.watched += watched;
    list.coordination = (list.coordination * before + contacts * watched) / list.watched;
    return true;
}

}  // namespace

std::optional<std::string> find_impacts(prepare::PreparedCase const& prepared, fs::path const& folder) {
    if (!prepared.scenario.measure.impacts) return {};
    auto const [from, to] = deck::watched_cycles(prepared.scenario);
    Laws laws(prepared);
    measure::ImpactList list{{}, 0, 0};
    for (int done = from; done < to; ++done)
        if (!add_cycle(list, files_of_cycle(folder, done), prepared.time.time_step, laws)) return {};
    std::ranges::stable_sort(list.impacts, {}, &measure::Impact::step);
    return measure::impacts_text(list);
}

void keep_impacts(prepare::PreparedCase const& prepared, fs::path const& folder) {
    // A packing that goes on after its first round has its impacts already.
    if (auto const text = find_impacts(prepared, folder))
        core::write_file_atomically(folder / impacts_file, *text);
    if (!prepared.scenario.measure.impacts) return;
    auto const [from, to] = deck::watched_cycles(prepared.scenario);
    for (int done = from; done < to; ++done)
        for (fs::path const& path : files_of_cycle(folder, done)) fs::remove(path);
}

void measure_impacts(store::PackingRecord& record, prepare::PreparedCase const& prepared,
                     PackingFiles const& files) {
    auto const [from, to] = deck::watched_cycles(prepared.scenario);
    if (!prepared.scenario.measure.impacts || record.series.cycles() < to) return;
    auto const file = std::ranges::find_if(
        files.snapshots, [](core::TextFile const& one) { return one.path.filename() == impacts_file; });
    if (file == files.snapshots.end())
        throw core::InputError(
            fmt::format("{} is missing; run its case again", (files.folder / impacts_file).string()));
    double mass = record.mass;
    if (prepared.domain.open) {
        auto const& held = record.series.open.held_mass;
        mass = (held.at(static_cast<std::size_t>(from)) + held.at(static_cast<std::size_t>(to))) / 2;
    }
    measure::ImpactList const list = measure::parse_impacts(*file);
    record.impacts = measure::impacts_of(list, mass);
    if (!record.rolling.coordination_number) record.rolling.coordination_number = list.coordination;
}

}  // namespace vibrotrough::evaluate
