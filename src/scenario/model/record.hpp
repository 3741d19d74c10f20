#pragma once

#include <string_view>

#include <Eigen/Dense>

namespace vibrotrough::scenario {

inline constexpr Eigen::Index fewest_samples = 8;  ///< of a record

/// The samples of a file, evenly spaced in time.
struct Record {
    double start = 0;              ///< s, of the first sample
    double spacing = 0;            ///< s
    Eigen::MatrixXd samples;       ///< along and normal to the trough, m or m/s2
    bool is_acceleration = false;  ///< otherwise positions
    double across = 0;  ///< half the range of the motion across the trough; 0 where it is not given

    /// Number of samples.
    Eigen::Index count() const { return samples.rows(); }
    /// The unit in which messages give its samples.
    char const* unit() const { return is_acceleration ? "m/s2" : "mm"; }
    /// A sample, m or m/s2, in unit().
    double in_unit(double value) const { return is_acceleration ? value : 1e3 * value; }
};

/// Reads a record, as described at read_waveform().
/// @throws std::invalid_argument with one line that describes what is wrong with the text
Record read_record(std::string_view text);

}  // namespace vibrotrough::scenario
