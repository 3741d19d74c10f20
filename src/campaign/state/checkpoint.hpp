#pragma once

#include "deck/deck.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace vibrotrough::campaign {

/// A place from which a cut run of a packing goes on. The engine writes the restart file; the driver seals it
/// with checkpoint.json once it is complete, and trusts nothing that is not sealed.
struct Checkpoint {
    int cycle;             ///< the last cycle before the checkpoint
    std::string file;      ///< the restart file in the packing's folder
    std::string started;   ///< ISO 8601, UTC: when the packing's first run started
    double wall_time;      ///< s, of the engine up to here
    double core_time = 0;  ///< s, processor time of the engine up to here, all ranks
};

/// The file in the packing's folder that seals a checkpoint: what is not there is not believed.
constexpr char const* checkpoint_seal = "checkpoint.json";

/// The last cycle with a complete restart file, as the deck's own list says; none without one.
std::optional<int> last_checkpoint(std::filesystem::path const& folder);

/// Seals the checkpoint after this cycle and removes the restart files of earlier ones.
/// @throws MissingError when the disk refuses
void seal_checkpoint(std::filesystem::path const& folder, deck::Deck const& deck,
                     Checkpoint const& checkpoint);

/// The sealed checkpoint, if it belongs to this deck, its file is what was sealed, and the cycles before it
/// are all in cycles.csv.
std::optional<Checkpoint> read_checkpoint(std::filesystem::path const& folder, deck::Deck const& deck,
                                          int steps_per_cycle);

/// The same for the deck that lies in the folder.
std::optional<Checkpoint> read_own_checkpoint(std::filesystem::path const& folder, int steps_per_cycle);

/// Whether there is a sealed checkpoint, whatever it is worth.
bool has_checkpoint(std::filesystem::path const& folder);

/// Cuts what the engine wrote after the checkpoint: rows of tables and frames.
/// @throws MissingError when the disk refuses
void cut_outputs(std::filesystem::path const& folder, Checkpoint const& checkpoint, int steps_per_cycle);

/// Removes all checkpoints of a packing that will not be continued.
void remove_checkpoints(std::filesystem::path const& folder);

}  // namespace vibrotrough::campaign
