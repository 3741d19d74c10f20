#pragma once

#include <stdexcept>

namespace vibrotrough::theory {

/// A phase of the motion could not be solved. The message contains the inputs that reproduce the error. It is
/// thrown in every build type, so that a wrong number is never returned silently.
class PhaseError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace vibrotrough::theory
