#pragma once

#include "prepare/prepared_case.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace vibrotrough::deck {

/// One packing's input for the engine: a folder in which `liggghts -in settle.liggghts` and then
/// `liggghts -in in.liggghts` run by hand.
struct Deck {
    std::map<std::string, std::string>
        settle_files;                          ///< of the first deck, which does not depend on the drive
    std::map<std::string, std::string> files;  ///< of both decks: content by name
};

/// Line that the deck prints when the run has ended as planned.
constexpr char const* end_marker = "VIBROTROUGH DONE";
/// Beginning of the line that a deck prints when it ends the run because of a problem.
constexpr char const* failure_marker = "VIBROTROUGH FAILED";
/// Line that the first deck prints when the packing has settled.
constexpr char const* settled_marker = "VIBROTROUGH SETTLED";
/// Line that the deck prints before its first cycle.
constexpr char const* begin_marker = "VIBROTROUGH BEGIN";

constexpr char const* settle_file = "settle.liggghts";  ///< Deck that pours and settles the packing.
constexpr char const* drive_file = "in.liggghts";       ///< Deck that moves the trough.
constexpr char const* settled_file =
    "settled.restart";  ///< Settled packing, from the first deck to the second.
constexpr char const* checkpoint_list =
    "checkpoints.txt";  ///< List of checkpoints: one line with its cycle each.

constexpr char const* control_file = "control.in";  ///< File that the deck reads after each cycle.
constexpr char const* control_go_on =
    "variable stop equal 0\n";  ///< Its content when only max_cycles ends the run.

/// Number of phases of a cycle at which the engine averages the layer in bins.
constexpr int profiles_per_cycle = 10;
/// A snapshot is taken at every third of these phases, so that each phase is reached once in three cycles.
constexpr int profile_stride = 3;

/// How one packing of a case is run.
struct PackingPlan {
    int number;      ///< from 1 to 1000
    int cycles = 0;  ///< after which the run ends; 0: after measure.max_cycles
    /// Velocity efficiency with which all grains start; none: at rest.
    std::optional<double> start_efficiency{};
    /// A longer run pauses after this many cycles, twice as many, four times ..., and continues from the
    /// checkpoint there, so that it gives the same digits as a run that is continued later; 0: it never
    /// pauses.
    int first_pause = 0;

    /// The cycles after which a run that has `done` cycles pauses or ends.
    int next_stop(int done) const;
};

/// The deck of one packing. The packings of a case differ in their seeds, in how they start, and in whether
/// they write frames. The number of cycles stands in control.in only, with a checkpoint after the last of
/// them, so that the same run can be continued later.
/// @throws std::invalid_argument when the number is below 1 or above 1000
Deck make_deck(prepare::PreparedCase const& prepared, PackingPlan const& packing);

/// The content of control.in that ends a run after so many cycles, with a checkpoint; 0: after max_cycles,
/// without one.
std::string control_until(int cycles);

/// The content of control.in that ends a run after the cycle that it is in, with a checkpoint.
std::string control_at_once();

/// The seed of packing number `packing` (from 1), a prime as the engine requires.
int packing_seed(int packing);

/// Name of the restart file that the deck writes after this cycle.
std::string checkpoint_file(int cycle);

/// The same files for several MPI ranks, each of which gets a part of the floor. The engine would divide the
/// box where the cut is smallest; because the box is high and mostly empty, one rank would then hold all
/// grains. Files for one rank stay as they are.
std::map<std::string, std::string> for_ranks(std::map<std::string, std::string> files, int ranks);

/// Reverts for_ranks() in the content of one file.
std::string for_one_rank(std::string content);

/// SHA-256 over the names and contents of files.
std::string digest_of(std::map<std::string, std::string> const& files);

/// The files of a folder, for one rank. @param names  the files to read; only the names are used, and files
/// that do not exist are left out
/// @throws core::MissingError when a file cannot be read
std::map<std::string, std::string> read_files(std::filesystem::path const& folder,
                                              std::map<std::string, std::string> const& names);

/// Writes files into a folder, which is made if necessary.
/// @throws core::MissingError when the folder or a file cannot be written
void write_files(std::map<std::string, std::string> const& files, std::filesystem::path const& folder);

/// Writes the files of a case that a person will run by hand. No file is replaced.
/// @param folder  of the case; it is made
/// @param files   contents by path below the folder
/// @throws core::InputError when a file is there already with another content; nothing is written then
/// @throws core::MissingError when something cannot be written
void write_case(std::filesystem::path const& folder, std::map<std::string, std::string> const& files);

/// Makes the folder to which the engine writes frames, if the deck asks for them: the engine makes no folder.
/// @throws core::MissingError when it cannot be made
void make_frame_folder(Deck const& deck, std::filesystem::path const& folder);

/// Writes the files of a deck into a folder, which is made if necessary.
/// @throws core::MissingError when the folder or a file cannot be written
void write_deck(Deck const& deck, std::filesystem::path const& folder, int ranks = 1);

}  // namespace vibrotrough::deck
