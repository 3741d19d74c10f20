#pragma once

#include "scenario/model/grains.hpp"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace vibrotrough::scenario {

/// The normal force of a contact.
enum class ContactModel {
    hertz,  ///< proportional to overlap^(3/2), as elasticity theory says; what the engine's probes test
    hooke,  ///< proportional to the overlap
};

/// The word of the campaign file, such as "hertz".
std::string_view name_of(ContactModel model);

/// Commands of the engine that a person adds to the decks, by the place at which the engine reads them. Each
/// text is empty or ends with a line feed.
struct ExtraLines {
    NamedFile file;                  ///< name and text
    std::string after_contact;       ///< of both decks, behind the contact model
    std::string before_first_cycle;  ///< of the driven deck; read again after each checkpoint
    std::string at_cycle_end;        ///< of the driven deck, behind every cycle
};

/// Reads a file of extra lines. A line `[after-contact]`, `[before-first-cycle]` or `[at-cycle-end]` says
/// where the lines below it are read.
/// @throws std::invalid_argument with one line that describes what is wrong with the text
std::shared_ptr<ExtraLines const> read_extra_lines(NamedFile file);

/// Templates that replace those of input_templates/. Cases with the same templates share one object.
struct DeckTemplates {
    std::vector<NamedFile> files;  ///< such as "contact.mustache", sorted by name
};

/// The first word in commands of the engine that leads out of the deck's folder, as a path with "/" or "~" at
/// its beginning or ".." in it does; empty when there is none. What lies there is not part of a case's id, so
/// that a case would stay finished when it changes. Comments and texts that are printed are left out.
std::string outside_path(std::string_view commands);

/// Whether a text is the name of a template: letters, digits, '.', '_' or '-', with the ending ".mustache".
bool is_template_name(std::string_view name);

/// What a case asks of the engine beyond what its probes test. Without it, decks are as they always were.
struct EnginePlan {
    ContactModel contact = ContactModel::hertz;         ///< normal force
    double cohesion = 0;                                ///< J/m^3, energy density of the model sjkr; 0: none
    std::shared_ptr<ExtraLines const> extra = nullptr;  ///< further commands, if any
    /// Templates in place of the program's own, if any.
    std::shared_ptr<DeckTemplates const> templates = nullptr;
};

/// What the engine's certificate does not cover in cases with this plan, in words such as "contact hooke,
/// cohesion sjkr"; empty when it covers everything that these keys ask for.
std::string not_covered(EnginePlan const& plan);

}  // namespace vibrotrough::scenario
