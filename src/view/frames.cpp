#include "view/frames.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "view/contact_reader.hpp"
#include "view/dump_reader.hpp"
#include "view/frame_writers.hpp"
#include "view/point_mass.hpp"
#include "view/scene.hpp"
#include "view/trough_motion.hpp"
#include "view/vtk_files.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace vibrotrough::view {
namespace {

namespace fs = std::filesystem;

struct Dump {
    long step;
    fs::path path;
};

/// The step of "frames.<step>.dump".
std::optional<long> step_of(std::string const& name) {
    std::string_view constexpr prefix = "frames.";
    std::string_view constexpr suffix = ".dump";
    if (!name.starts_with(prefix) || !name.ends_with(suffix) || name.size() <= prefix.size() + suffix.size())
        return {};
    long step = 0;
    char const* const stop = name.data() + name.size() - suffix.size();
    auto const [after, failure] = std::from_chars(name.data() + prefix.size(), stop, step);
    return failure == std::errc{} && after == stop ? std::optional(step) : std::nullopt;
}

/// All dumps in the folder, sorted by step.
std::vector<Dump> find_dumps(fs::path const& folder) {
    std::error_code failure;
    fs::directory_iterator const files(folder, failure);
    if (failure) {
        throw core::MissingError(
            fmt::format("cannot open the folder {} ({}); set output.frames_per_cycle to at least 1 "
                        "and run the case",
                        folder.string(), failure.message()));
    }
    std::vector<Dump> dumps;
    for (fs::directory_entry const& file : files) {
        if (auto const step = step_of(file.path().filename().string())) dumps.push_back({*step, file.path()});
    }
    std::sort(dumps.begin(), dumps.end(), [](Dump const& a, Dump const& b) { return a.step < b.step; });
    return dumps;
}

/// The position of the trough at every dump. Only the last dump may lack a row, or the last row a dump,
/// because the engine may still be writing them.
std::vector<TroughPosition> match(std::vector<Dump>& dumps, fs::path const& table) {
    std::vector<TroughPosition> positions = read_trough_motion(table);
    std::size_t const frames = std::min(dumps.size(), positions.size());
    for (std::size_t i = 0; i < frames; ++i) {
        if (dumps[i].step != positions[i].step) {
            throw core::InputError(
                fmt::format("{} does not match the dumps in its folder (frame {} is at step {} in the table "
                            "and at step {} in the dumps); run the case again",
                            table.string(), i + 1, positions[i].step, dumps[i].step));
        }
    }
    if (dumps.size() > frames + 1 || positions.size() > frames + 1) {
        throw core::InputError(fmt::format("{} has {} rows, but its folder has {} dumps; run the case again",
                                           table.string(), positions.size(), dumps.size()));
    }
    dumps.resize(frames);
    positions.resize(frames);
    return positions;
}

/// The engine moves the trough step by step with an error of at most about A pi / n for n steps per cycle
/// (0.6 % of A at n = 500). A deviation larger than this fraction of the drive's excursion means that the
/// frames belong to another drive.
constexpr double motion_tolerance = 0.05;

void check_motion(FrameSource const& source, TroughPosition const& position) {
    TroughState const trough = trough_state(source, source.time_of(position.step));
    double const miss = std::hypot(position.x - trough.x, position.z - trough.z);
    double excursion = largest_excursion(source.drive);
    for (scenario::DrivePart const& part : source.parts)
        excursion = std::max(excursion, largest_excursion(part.to));
    if (miss > motion_tolerance * excursion) {
        throw core::InputError(
            fmt::format("{}: at step {} the trough is {:.3g} m away from its position according to the drive "
                        "(the frames belong to another drive); run the case again",
                        (source.folder / "frames.csv").string(), position.step, miss));
    }
}

/// Writes all objects of one frame after another and their collections.
class FrameExport {
  public:
    FrameExport(FrameSource const& source, fs::path const& target)
        : source_(source),
          target_(target),
          trough_(source, source.trough),
          grains_(source),
          block_(trough_.bounds()) {
        if (source.point_mass) point_mass_.emplace(source, *source.point_mass);
        for (char const* const object : objects) core::make_folder(target / object);
        if (!source.walls.empty()) {
            walls_.emplace(source, source.walls);
            core::make_folder(target / "walls");
        }
        if (has_contacts(source.folder)) {
            contacts_.emplace();
            core::make_folder(target / "contacts");
        }
    }

    void write(GrainFrame& frame, TroughPosition const& position) {
        double const time = source_.time_of(frame.step);
        std::string const name = fmt::format("{:06}.vtp", files_.size());
        double const surface = trough_.bounds()[4] + position.z;
        grains_.write(target_ / "grains" / name, frame, surface, time);
        trough_.write(target_ / "trough" / name, position, time);
        if (walls_) walls_->write(target_ / "walls" / name, position, time);
        write_profile(target_ / "profile" / name, source_, frame, grains_.relative_velocity(), surface, time);
        if (point_mass_) {
            auto const block = block_.at(point_mass_->at(time), position.z, grains_.mean_velocity());
            set_time(*block, source_, time);
            write_vtp(target_ / "point_mass" / name, *block);
        }
        files_.emplace_back(time, name);
        if (!contacts_) return;
        // Older frames of a run may have none, and those of the last frame may be incomplete.
        auto contacts = read_contacts(source_.folder, frame.step, frame.box);
        if (!contacts) return;
        write_contacts(target_ / "contacts" / name, source_, *contacts, time);
        contacts_->emplace_back(time, name);
    }

    void write_collections() const {
        for (std::string const object : objects)
            write_files(object, object != "point_mass" || point_mass_ ? files_ : Files{});
        if (walls_) write_files("walls", files_);
        if (contacts_) write_files("contacts", *contacts_);
    }
    bool with_contacts() const { return contacts_.has_value(); }

    int frames() const { return static_cast<int>(files_.size()); }
    GrainWriter const& grains() const { return grains_; }

  private:
    using Files = std::vector<std::pair<double, std::string>>;

    void write_files(std::string const& object, Files const& files) const {
        std::vector<CollectionEntry> entries;
        for (auto const& [time, name] : files) entries.push_back({time, object + "/" + name});
        write_collection(target_ / (object + ".pvd"), entries);
    }

    static constexpr std::array objects{"grains", "trough", "profile", "point_mass"};

    FrameSource const& source_;
    fs::path target_;
    TroughWriter trough_;
    GrainWriter grains_;
    PointMassBlock block_;
    std::optional<PointMassMotion> point_mass_;
    std::optional<TroughWriter> walls_;
    Files files_;
    std::optional<Files> contacts_;
};

}  // namespace

ExportedFrames export_frames(FrameSource const& source, fs::path const& target,
                             std::function<void(int, int)> const& progressed) {
    std::vector<Dump> dumps = find_dumps(source.folder);
    std::vector<TroughPosition> const positions = match(dumps, source.folder / "frames.csv");
    for (TroughPosition const& position : positions) check_motion(source, position);
    FrameExport frames(source, target);
    ExportedFrames exported{.grains = target / "grains.pvd",
                            .trough = target / "trough.pvd",
                            .point_mass = target / "point_mass.pvd",
                            .profile = target / "profile.pvd",
                            .walls = source.walls.empty() ? fs::path() : target / "walls.pvd",
                            .contacts = frames.with_contacts() ? target / "contacts.pvd" : fs::path(),
                            .scene = write_scene(source, {}, {}, target)};
    frames.write_collections();

    auto written = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < dumps.size(); ++i) {
        auto frame = read_grains(dumps[i].path);
        if (!frame) {
            if (i + 1 == dumps.size()) break;
            throw core::InputError(fmt::format(
                "{} ends early although there are later frames (the file is damaged); run the case again",
                dumps[i].path.string()));
        }
        if (frame->step != dumps[i].step) {
            throw core::InputError(fmt::format(
                "{}:2: the frame is at step {}, which contradicts the name of the file; run the case again",
                dumps[i].path.string(), frame->step));
        }
        frames.write(*frame, positions[i]);
        if (auto const now = std::chrono::steady_clock::now(); now - written > std::chrono::seconds(1)) {
            frames.write_collections();
            if (progressed) progressed(frames.frames(), static_cast<int>(dumps.size()));
            written = now;
        }
    }
    frames.write_collections();
    write_scene(source, frames.grains().scales(), frames.grains().space(), target);
    exported.frames = frames.frames();
    return exported;
}

}  // namespace vibrotrough::view
