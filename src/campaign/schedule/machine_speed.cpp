#include "campaign/schedule/machine_speed.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/note.hpp"
#include "deck/estimates.hpp"
#include "engine/certificate.hpp"

#include <optional>

namespace vibrotrough::campaign {
namespace {

namespace fs = std::filesystem;
namespace note = core::note;

constexpr char const* entry = "grain_steps_per_s";
constexpr double least_core_time = 10;  // s

std::optional<fs::path> speed_file() {
    auto const folder = engine::certificate_folder();
    return folder ? std::optional(folder->parent_path() / "speed.json") : std::nullopt;
}

}  // namespace

MachineSpeed machine_speed() {
    constexpr double least = 1e4, most = 1e9;  // anything else is damage
    try {
        if (auto const file = speed_file(); file && fs::exists(*file)) {
            double const speed = note::number(note::parse(core::read_file(*file, core::largest_note)), entry);
            if (speed >= least && speed <= most) return {speed, true};
        }
    } catch (std::exception const&) {
        // As if nothing had been noted.
    }
    return {deck::usual_speed, false};
}

void note_machine_speed(WorkOfRun const& work) {
    auto const file = speed_file();
    if (!file || !work.is_plain || work.core_time < least_core_time || work.driven <= 0) return;
    try {
        core::make_folder(file->parent_path());
        core::write_file_atomically(*file, note::Json{{entry, work.driven / work.core_time}}.dump() + "\n");
    } catch (std::exception const&) {
        // The next campaign notes it.
    }
}

}  // namespace vibrotrough::campaign
