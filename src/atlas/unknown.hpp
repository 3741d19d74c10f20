#pragma once

#include "atlas/tables.hpp"
#include "atlas/value.hpp"

#include <map>
#include <optional>
#include <span>
#include <vector>

namespace vibrotrough::atlas {

/// The middle of an input's range (of its logarithm where it is scaled so), which stands for an input that is
/// not known.
double middle_of(Input input);

/// Standard deviation, in velocity efficiency, that inputs may cause which are not known: the root mean
/// square over places of the whole atlas, at each of which they lie anywhere in their ranges while the others
/// stay.
double sd_of_unknown(std::span<Input const> unknown);

/// The numbers of a layer in the order of inputs(), as far as they are known. Those of the motion, which are
/// the first five, must be there.
using KnownNumbers = std::vector<std::optional<double>>;

/// What the atlas says of layers of which not everything is known: what is not known is in the middle of its
/// range, and what it may change widens the interval by the root of the sum of squares. It may be used by
/// several threads at once after prepare().
class PartlyKnown {
  public:
    /// Finds what the inputs that `numbers` lacks may change, which takes milliseconds for each set of them.
    void prepare(KnownNumbers const& numbers);

    /// The place of a layer, with what is not known in the middle of its range.
    static Place place_of(KnownNumbers const& numbers);

    /// As value_at(). @throws std::logic_error without prepare() for this set of unknown inputs
    std::optional<SurfaceValue> operator()(KnownNumbers const& numbers) const;

  private:
    std::map<std::vector<Input>, double> sd_;  ///< of each set of unknown inputs that came up
};

}  // namespace vibrotrough::atlas
