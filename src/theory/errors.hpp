#pragma once

#include <stdexcept>

namespace vibrotrough::theory {

/// A phase of the motion could not be solved. The message repeats the inputs that reproduce it.
/// Thrown in every build type: a wrong number is never handed on silently.
class PhaseError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace vibrotrough::theory
