#pragma once

#include <stdexcept>
#include <string>

namespace vibrotrough::core {

/// What the user can do about an error; `app` turns it into the exit code.
enum class ErrorKind {
    input,    ///< the user's input is wrong (a campaign file, an option, a damaged folder)
    missing,  ///< something the program needs is not there (no engine, no disk, no permission)
};

/// An error that a user sees. The message is one line: problem (why), what to do.
class Error : public std::runtime_error {
  public:
    Error(ErrorKind kind, std::string const& message) : std::runtime_error(message), kind_(kind) {}
    ErrorKind kind() const { return kind_; }

  private:
    ErrorKind kind_;
};

/// The user's input is wrong.
class InputError : public Error {
  public:
    explicit InputError(std::string const& message) : Error(ErrorKind::input, message) {}
};

/// Something the program needs is missing.
class MissingError : public Error {
  public:
    explicit MissingError(std::string const& message) : Error(ErrorKind::missing, message) {}
};

}  // namespace vibrotrough::core
