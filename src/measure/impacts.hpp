#pragma once

#include "core/atomic_file.hpp"
#include "measure/impact_law.hpp"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

/// @file
/// The impacts between grains and of grains with the trough, from lists of the contacts that follow each
/// other so closely that no contact is shorter.
///
/// An impact is a contact that one list has and the list before it has not. Its energy is m* v^2 / 2 with the
/// speed v along the normal at the first touch, relative to the other grain or to the trough.

namespace vibrotrough::measure {

/// One impact.
struct Impact {
    long step;      ///< of the first list that has it
    int first;      ///< number of a grain
    int second;     ///< number of the other grain, 0 for the trough
    double energy;  ///< J
    /// Whether it was seen only once, or parted at once. Then a third body took part in it, and the energy is
    /// what was in the spring, less than the impact's.
    bool brief;
};

/// What the impacts of two grains, or of one with the trough (0), depend on.
struct ImpactKind {
    ImpactingPair pair;    ///< of these two
    ImpactLaw const* law;  ///< of their materials
};

/// Finds the kind of an impact by the numbers of the grains.
using ImpactKinds = std::function<ImpactKind(int first, int second)>;

/// Impacts that begin in a file of contacts.
struct SeenImpacts {
    std::vector<Impact> impacts;  ///< in the order of their steps
    long watched = 0;             ///< steps in which an impact that begins is among them
    double contacts = 0;          ///< in a list, mean over the lists
};

/// Reads a file of the engine's dump of contacts: "other number-1 number-2 flag overlap" of two grains, or
/// mesh, triangle, grain and overlap.
/// @param with_trough  which of the two
/// @param time_step    s
/// @returns none when the file is incomplete, as while the engine is writing it
/// @throws InputError naming the file when it is damaged
std::optional<SeenImpacts> find_impacts(core::TextFile const& file, bool with_trough, double time_step,
                                        ImpactKinds const& kinds);

/// Impacts of a packing and for how long they were watched.
struct ImpactList {
    std::vector<Impact> impacts;  ///< of all watched cycles
    double watched;               ///< s
    /// Contacts of a grain with others and with the trough in the mean over the lists; a contact of two
    /// grains is one of both.
    double coordination;
};

/// The text of impacts.csv.
std::string impacts_text(ImpactList const& list);

/// Reads impacts.csv. @throws InputError naming file and line when it is damaged
ImpactList parse_impacts(core::TextFile const& file);

/// Rates of impacts by energy, and what they come to; empty when they were not asked for.
struct Impacts {
    std::optional<double> number;  ///< of impacts that were seen
    std::optional<double> power;   ///< W/kg, energy of impacts between grains per time and mass of the layer
    std::optional<double> energy;  ///< J, half of that power is in impacts with more energy
    std::optional<double> trough_power;   ///< W/kg, the same of impacts with the trough
    std::optional<double> trough_energy;  ///< J
    std::optional<double> brief_share;    ///< of all impacts
    /// Energy classes: lower and upper end (J), and the impacts per time and mass of the layer (1/(kg s))
    /// between grains and with the trough.
    std::vector<double> from, to, rate, trough_rate;
};

/// How many classes of energy there are in a decade.
constexpr int classes_per_decade = 5;

/// @param mass  kg, of the layer
Impacts impacts_of(ImpactList const& list, double mass);

}  // namespace vibrotrough::measure
