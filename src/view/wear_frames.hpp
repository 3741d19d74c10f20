#pragma once

#include "measure/wear.hpp"
#include "view/frames.hpp"

#include <optional>
#include <vector>

namespace vibrotrough::view {

/// The wear of the trough from frame to frame, which the engine writes at the end of each cycle.
class WearFrames {
  public:
    /// `source` must outlive this.
    explicit WearFrames(FrameSource const& source) : source_(source) {}

    /// J/m^2, the wear of each triangle of the trough since the drive began, at the end of the last cycle
    /// before this step or at the step. Empty when the packing has none. The next call changes it.
    /// @throws InputError when a file is damaged, or not of this trough
    std::vector<float>& at(long step, std::size_t triangles);

  private:
    /// None when there is no such file, or when the engine has not finished writing it.
    std::optional<measure::WearSnapshot> read(long cycle) const;

    FrameSource const& source_;
    std::optional<measure::WearSnapshot> first_;
    long cycle_ = -1;  ///< of `wear_`
    std::vector<float> wear_;
};

}  // namespace vibrotrough::view
