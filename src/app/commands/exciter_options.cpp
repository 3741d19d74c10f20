#include "app/commands/exciter_options.hpp"

#include "app/commands/command.hpp"
#include "core/text.hpp"

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
    std::string const group = "What moves the trough";
    quantities_.add_to(command, {{"--trough-mass"}, {"--spring"}, {"--added-mass"}}, group);
    command
        .add_option("--exciter", exciter_,
                    "Unbalanced motors, all together, from which the stroke follows: their static moment, "
                    "\"static 840 kg mm\", working moment, \"working 168 kg cm\", or centrifugal force, "
                    "\"8.5 kN at 960 rpm\"")
        ->group(group);
}

std::optional<learn::MovedMachine> ExciterOptions::machine() const {
    auto const mass = quantities_.value("--trough-mass");
    if (!mass) {
        for (auto const& [name, text] : {std::pair{"--exciter", exciter_},
                                         {"--spring", quantities_.text("--spring")},
                                         {"--added-mass", quantities_.text("--added-mass")}})
            if (text)
                throw core::InputError(fmt::format(
                    "{} {}: needs the mass that moves; write --trough-mass \"180 kg\"", name, *text));
        return {};
    }
    learn::MovedMachine machine{};
    machine.mass = *mass;
    if (quantities_.has("--spring") && !exciter_)
        throw core::InputError(fmt::format("--spring: needs the exciter; {}", ways));
    if (exciter_) machine.exciter = read_exciter(std::string(core::trimmed(*exciter_)));
    machine.spring = quantities_.value("--spring").value_or(machine.spring);
    if (auto const added = quantities_.uncertain("--added-mass")) {
        machine.added_mass = *added;
        machine.added_mass_source = learn::AddedMassSource::given;
    }
    return machine;
}

}  // namespace vibrotrough::app
