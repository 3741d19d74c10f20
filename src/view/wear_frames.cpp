#include "view/wear_frames.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

namespace vibrotrough::view {

std::optional<measure::WearSnapshot> WearFrames::read(long cycle) const {
    auto const path = source_.wear / measure::wear_file(cycle * source_.steps_per_cycle);
    std::error_code missing;
    if (!std::filesystem::is_regular_file(path, missing)) return {};
    return measure::parse_wear(core::read_text_file(path));
}

std::vector<float>& WearFrames::at(long step, std::size_t triangles) {
    if (source_.wear.empty() || source_.steps_per_cycle == 0) return wear_;
    if (!first_) first_ = read(0);
    long const cycle = step / source_.steps_per_cycle;
    if (!first_ || cycle == cycle_) return wear_;
    auto const now = read(cycle);
    if (!now) return wear_;
    if (now->triangles() != triangles || first_->triangles() != triangles)
        throw core::InputError(
            fmt::format("the wear of {} triangles is in {}, but the trough has {}; run the case again",
                        now->triangles(), source_.wear.string(), triangles));
    cycle_ = cycle;
    wear_.resize(triangles);
    for (std::size_t i = 0; i < triangles; ++i) wear_[i] = static_cast<float>(now->wear[i] - first_->wear[i]);
    return wear_;
}

}  // namespace vibrotrough::view
