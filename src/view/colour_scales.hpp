#pragma once

#include <vector>

namespace vibrotrough::view {

/// What the grains of a scene are coloured by.
enum class Colour {
    velocity,  ///< velocity along the trough minus the layer's mean
    spin,      ///< spin about y over the angular frequency of the vibration
    height,    ///< height of the centre above the trough
    trough,    ///< velocity along the trough, relative to it
    size,      ///< radius
    material,  ///< of a mixture
};

/// How far the values of the frames reach, so that colours mean the same in every frame of a case and yet
/// show what happens in most of them. A range is the mean over the frames of the size below which 95 % of the
/// frame's values are, rounded up to 1, 2 or 5 times a power of ten.
class ColourScales {
  public:
    /// Adds the values of one frame, one for each grain; `spin` may be empty.
    /// @param velocity  m/s, minus the layer's mean
    /// @param spin      over the angular frequency of the vibration
    /// @param height    m, above the trough
    void add(std::vector<float> const& velocity, std::vector<float> const& spin,
             std::vector<float> const& height);

    /// m/s; nothing but zeros, or no frame: 0. The same for the others.
    double velocity() const;
    double spin() const;    ///< over the angular frequency of the vibration
    double height() const;  ///< m

  private:
    struct Mean {
        double sum = 0;
        int frames = 0;
        void add(std::vector<float> const& values);
        double rounded() const;
    };
    Mean velocity_, spin_, height_;
};

/// The smallest of 1, 2 and 5 times a power of ten that is at least `value`; 0 when it is not positive.
double rounded_up(double value);

}  // namespace vibrotrough::view
