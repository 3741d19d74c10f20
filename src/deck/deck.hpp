#pragma once

#include "prepare/prepared_case.hpp"

#include <filesystem>
#include <map>
#include <string>

namespace vibrotrough::deck {

/// One packing's input for the engine: a folder in which `liggghts -in settle.liggghts` and then
/// `liggghts -in in.liggghts` run by hand.
struct Deck {
    std::map<std::string, std::string> settle_files;  ///< of the first deck, which knows nothing of the drive
    std::map<std::string, std::string> files;         ///< of both, name and content
};

/// Lines that the decks print and the driver looks for.
constexpr char const* end_marker = "VIBROTROUGH DONE";
constexpr char const* failure_marker = "VIBROTROUGH FAILED";
constexpr char const* settled_marker = "VIBROTROUGH SETTLED";
constexpr char const* begin_marker = "VIBROTROUGH BEGIN";

constexpr char const* settle_file = "settle.liggghts";
constexpr char const* drive_file = "in.liggghts";
constexpr char const* settled_file = "settled.restart";
constexpr char const* checkpoint_list = "checkpoints.txt";  ///< a line with its cycle per checkpoint

/// The file that the deck reads after each cycle, and its two contents.
constexpr char const* control_file = "control.in";
constexpr char const* control_go_on = "variable stop equal 0\n";
constexpr char const* control_stop = "variable stop equal 1\n";

/// The deck of packing number `packing` (from 1). Different packings differ by their seeds only.
/// @throws std::invalid_argument when `packing` is below 1 or above 1000
Deck make_deck(prepare::PreparedCase const& prepared, int packing);

/// The seed of packing number `packing` (from 1), a prime as the engine wants it.
int packing_seed(int packing);

/// Name of the restart file that the deck writes after this cycle.
std::string checkpoint_file(int cycle);

/// The same files for several MPI ranks: each gets a piece of the floor. The engine would cut the box where
/// its faces are smallest; it is tall and empty above, so that all grains would be one rank's. Files for one
/// rank are as they were.
std::map<std::string, std::string> for_ranks(std::map<std::string, std::string> files, int ranks);

/// The deck for one rank again, from one that for_ranks made.
std::string for_one_rank(std::string content);

/// Writes files into the folder, which is made.
/// @throws MissingError when the disk refuses
void write_files(std::map<std::string, std::string> const& files, std::filesystem::path const& folder);

/// Writes the deck's files into the folder, which is made.
/// @throws MissingError when the disk refuses
void write_deck(Deck const& deck, std::filesystem::path const& folder, int ranks = 1);

}  // namespace vibrotrough::deck
