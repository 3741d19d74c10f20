#include "app/commands/exciter_options.hpp"

#include "app/commands/command.hpp"
#include "app/commands/material_options.hpp"
#include "core/text.hpp"

namespace vibrotrough::app {
namespace {

constexpr char const* ways =
    "write \"static 840 kg mm\" (unbalanced mass times its radius, as Italvibras), \"working 168 kg cm\" "
    "(twice as much, as NetterVibration), \"8.5 kN at 960 rpm\" or \"2 x 8 kN at 960 rpm\"";

/// How many motors "2 x 8 kN at 960 rpm" names; the rest of the text without them.
int take_count(std::string& text) {
    auto const times = text.find(" x ");
    if (times == std::string::npos) return 1;
    constexpr int most_motors = 16;
    int const count =
        read_count("--exciter", text.substr(0, times), "\"2 x 8 kN at 960 rpm\"", 1, most_motors);
    text = text.substr(times + 3);
    return count;
}

/// What follows a word at the beginning; nothing where another word stands there.
std::optional<std::string> after(std::string const& text, std::string const& word) {
    if (text.rfind(word + " ", 0) != 0) return {};
    return text.substr(word.size() + 1);
}

learn::Exciter read_exciter(std::string text) {
    char const* const option = "--exciter";
    int const count = take_count(text);
    if (auto const moment = after(text, "static"))
        return {count * read_positive_quantity(option, *moment, "kg m", "static 840 kg mm")};
    if (auto const moment = after(text, "working"))
        return {count * read_positive_quantity(option, *moment, "kg m", "working 168 kg cm") / 2};
    auto const at = text.find(" at ");
    if (at == std::string::npos) throw core::InputError(fmt::format("{} {}: {}", option, text, ways));
    double const force = read_positive_quantity(option, text.substr(0, at), "N", "8.5 kN at 960 rpm");
    return learn::exciter_of_force(count * force, read_turns(option, text.substr(at + 4)));
}

/// @throws core::InputError where springs sag further than any of such machines
void check_sag(learn::MovedMachine const& machine, std::string const& spring) {
    if (machine.spring <= 0) return;
    double const sag = learn::sag_of(machine, 0);
    if (sag <= learn::largest_sag) return;
    double const needed = machine.spring * sag / learn::largest_sag;
    throw core::InputError(
        fmt::format("--spring {}: sags by {:.0f} mm under {:g} kg, and springs of such machines by {:g} mm "
                    "at most; write at "
                    "least \"{:.0f} N/mm\", of all springs together",
                    spring, 1e3 * sag, machine.mass, 1e3 * learn::largest_sag, std::ceil(1e-3 * needed)));
}

}  // namespace

std::vector<learn::DriveKind> const& ExciterOptions::drive_kinds() {
    static auto const kinds = learn::read_drives(plant_table("drives.csv"), "drives.csv");
    return kinds;
}

void ExciterOptions::add_to(CLI::App& command) {
    std::string const group = "What moves the trough";
    quantities_.add_to(command, {{"--trough-mass"}, {"--spring"}, {"--added-mass"}}, group);
    command
        .add_option("--exciter", exciter_,
                    "Unbalance motors, all together, from which the stroke follows: their static moment, "
                    "\"static 840 kg mm\", working moment, \"working 168 kg cm\", or centrifugal force, "
                    "\"8.5 kN at 960 rpm\"; or each of several, \"2 x 8 kN at 960 rpm\"")
        ->group(group);
    command
        .add_option("--motors", motors_,
                    "Table of the unbalance motors among which a pair is chosen, with the columns rpm, "
                    "static_moment_kg_mm, force_kN and power_kW; default: generic classes "
                    "(input_templates/plant/motors.csv)")
        ->type_name("FILE")
        ->group(group);
    std::vector<std::string> kinds;
    for (auto const& one : drive_kinds()) kinds.push_back(one.name);
    command
        .add_option(
            "--drive", drive_,
            "Kind of the drive, whose usual limits hold where --stroke, --rpm and --machine-number are "
            "not given (input_templates/plant/drives.csv); default: any, and with --exciter or --motors "
            "unbalance motors")
        ->check(CLI::IsMember(kinds))
        ->group(group);
}

std::optional<learn::DriveKind> ExciterOptions::drive() const {
    if (!drive_ && !exciter_ && !motors_) return {};
    return *std::ranges::find(drive_kinds(), drive_.value_or(drive_kinds().front().name),
                              &learn::DriveKind::name);
}

std::optional<learn::MovedMachine> ExciterOptions::machine() const {
    auto const mass = quantities_.value("--trough-mass");
    if (!mass) {
        for (auto const& [name, text] : {std::pair{"--exciter", exciter_},
                                         {"--spring", quantities_.text("--spring")},
                                         {"--motors", motors_},
                                         {"--added-mass", quantities_.text("--added-mass")}})
            if (text)
                throw core::InputError(fmt::format(
                    "{} {}: needs the mass that moves; write --trough-mass \"180 kg\"", name, *text));
        return {};
    }
    learn::MovedMachine machine{};
    machine.mass = *mass;
    if (exciter_) machine.exciter = read_exciter(std::string(core::trimmed(*exciter_)));
    machine.spring = quantities_.value("--spring").value_or(machine.spring);
    check_sag(machine, quantities_.text("--spring").value_or(""));
    machine.motors = motors_ ? learn::read_motors(core::read_text_file(*motors_).content, *motors_)
                             : learn::read_motors(plant_table("motors.csv"), "motors.csv");
    if (auto const added = quantities_.uncertain("--added-mass")) {
        machine.added_mass = *added;
        machine.added_mass_source = learn::AddedMassSource::given;
    }
    return machine;
}

}  // namespace vibrotrough::app
