#pragma once

#include <stdexcept>
#include <string>

namespace vibrotrough::core {

/// What the user can do about an error; `app` turns it into the exit code.
enum class ErrorKind {
    input,    ///< the user's input is wrong (a campaign file, an option, a damaged folder)
    missing,  ///< something that the program needs is missing (an engine, disk space, a permission)
};

/// An error that a user sees. The message is one line: what happened, why, and what to do.
class Error : public std::runtime_error {
  public:
    /// @param kind     what the user can do about it
    /// @param message  one line without a line end
    Error(ErrorKind kind, std::string const& message) : std::runtime_error(message), kind_(kind) {}
    /// What the user can do about the error.
    ErrorKind kind() const { return kind_; }

  private:
    ErrorKind kind_;
};

/// The user's input is wrong.
class InputError : public Error {
  public:
    /// @param message  one line without a line end
    explicit InputError(std::string const& message) : Error(ErrorKind::input, message) {}
};

/// Something that the program needs is missing.
class MissingError : public Error {
  public:
    /// @param message  one line without a line end
    explicit MissingError(std::string const& message) : Error(ErrorKind::missing, message) {}
};

/// A file system takes no more: it is full, or a quota or the limit of a file's size (ulimit -f) is reached.
class DiskFullError : public MissingError {
  public:
    using MissingError::MissingError;
};

}  // namespace vibrotrough::core
