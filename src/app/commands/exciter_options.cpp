#include "app/commands/exciter_options.hpp"

#include "app/commands/uncertain_options.hpp"
#include "core/error.hpp"
#include "core/text.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace vibrotrough::app {
namespace {

constexpr char const* ways =
    "write \"static 840 kg mm\" (unbalanced mass times its radius, as Italvibras), \"working 168 kg cm\" "
    "(twice as much, as NetterVibration) or \"8.5 kN at 960 rpm\"";

/// What follows a word at the beginning; nothing where another word stands there.
std::optional<std::string> after(std::string const& text, std::string const& word) {
    if (text.rfind(word + " ", 0) != 0) return {};
    return text.substr(word.size() + 1);
}

learn::Exciter read_exciter(std::string const& text) {
    char const* const option = "--exciter";
    if (auto const moment = after(text, "static"))
        return {read_positive_quantity(option, *moment, "kg m", "static 840 kg mm")};
    if (auto const moment = after(text, "working"))
        return {read_positive_quantity(option, *moment, "kg m", "working 168 kg cm") / 2};
    auto const at = text.find(" at ");
    if (at == std::string::npos) throw core::InputError(fmt::format("{} {}: {}", option, text, ways));
    double const force = read_positive_quantity(option, text.substr(0, at), "N", "8.5 kN at 960 rpm");
    return learn::exciter_of_force(force, read_turns(option, text.substr(at + 4)));
}

}  // namespace

void ExciterOptions::add_to(CLI::App& command) {
    auto const add = [&](char const* name, Text& text, char const* help) {
        command.add_option(name, text, help)->group("What moves the trough");
    };
    add("--trough-mass", trough_mass_,
        "Of all that moves, with the motors and without material, for example \"180 kg\"; with --length, the "
        "exciter that the stroke needs is told");
    add("--exciter", exciter_,
        "Unbalanced motors, all together, from which the stroke follows: their static moment, "
        "\"static 840 kg mm\", working moment, \"working 168 kg cm\", or centrifugal force, "
        "\"8.5 kN at 960 rpm\"");
    add("--spring", spring_,
        "Stiffness of all springs in the direction of vibration, for example \"200 N/mm\"; default: so soft "
        "that it does not count");
    add("--added-mass", added_mass_,
        "Part of the material's mass that moves with the trough, from added_mass_fraction of a campaign or "
        "written like --friction; default: that of the atlas' layers, else \"0.10 to 0.25\" "
        "(NetterVibration)");
}

std::optional<learn::MovedMachine> ExciterOptions::machine() const {
    if (!trough_mass_) {
        for (auto const& [name, text] :
             {std::pair{"--exciter", exciter_}, {"--spring", spring_}, {"--added-mass", added_mass_}})
            if (text)
                throw core::InputError(fmt::format(
                    "{} {}: needs the mass that moves; write --trough-mass \"180 kg\"", name, *text));
        return {};
    }
    learn::MovedMachine machine{};
    machine.mass = read_positive_quantity("--trough-mass", *trough_mass_, "kg", "180 kg");
    if (spring_ && !exciter_)
        throw core::InputError(fmt::format("--spring {}: needs the exciter; {}", *spring_, ways));
    if (exciter_) machine.exciter = read_exciter(std::string(core::trimmed(*exciter_)));
    if (spring_) machine.spring = read_positive_quantity("--spring", *spring_, "N/m", "200 N/mm");
    if (added_mass_) {
        machine.added_mass = read_uncertain_number("--added-mass", *added_mass_, "0.17", -1, 1);
        machine.added_mass_source = learn::AddedMassSource::given;
    }
    return machine;
}

}  // namespace vibrotrough::app
