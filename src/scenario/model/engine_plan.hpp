#pragma once

#include "scenario/model/grains.hpp"

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace vibrotrough::scenario {

/// The normal force of a contact; prepare/contact.cpp has a class for each. The engine's probes test Hertz'.
enum class ContactModel { hertz, hooke };
/// Their words in the campaign file and in LIGGGHTS.
inline constexpr std::array<std::string_view, 4> contact_words{"hertz", "hooke"};
/// What the key engine.contact means, for its help.
inline constexpr std::string_view contact_meaning =
    "normal force of the contacts; hertz: proportional to overlap^(3/2), as elasticity theory says; "
    "hooke: a linear spring as stiff as a Hertz contact in the fastest expected impact";

/// The word of the campaign file, such as "hertz".
std::string_view name_of(ContactModel model);

/// Templates that replace those of input_templates/. Cases with the same templates share one object.
struct DeckTemplates {
    std::vector<NamedFile> files;  ///< such as "contact.mustache", sorted by name
};

/// Whether a text is the name of a template: letters, digits, '.', '_' or '-', with the ending ".mustache".
bool is_template_name(std::string_view name);

/// What a case asks of the engine beyond what its probes test. Without it, decks are as they always were.
struct EnginePlan {
    ContactModel contact = ContactModel::hertz;  ///< normal force
    double cohesion = 0;                         ///< J/m^3, energy density of the model sjkr; 0: none
    bool tangential_damping = false;             ///< beside the tangential spring; Coulomb's limit stays
    /// Templates in place of the program's own, if any.
    std::shared_ptr<DeckTemplates const> templates = nullptr;
};

/// What the engine's certificate does not cover in cases with this plan, in words such as "contact hooke,
/// cohesion sjkr"; empty when it covers everything that these keys ask for.
std::string not_covered(EnginePlan const& plan);

}  // namespace vibrotrough::scenario
