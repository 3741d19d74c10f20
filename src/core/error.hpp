#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace vibrotrough::core {

/// What the user can do about an error; `app` turns it into the exit code.
enum class ErrorKind {
    input,    ///< the user's input is wrong (a campaign file, an option, a damaged folder)
    missing,  ///< something that the program needs is missing (an engine, disk space, a permission)
};

/// An error that a user sees. The message is one line: what happened, why, and what to do. Several mistakes
/// in one file are several such lines.
class Error : public std::runtime_error {
  public:
    /// @param kind     what the user can do about it
    /// @param message  one line without a line end
    Error(ErrorKind kind, std::string const& message)
        : std::runtime_error(message), kind_(kind), problems_{message} {}
    /// @param problems  a line for each, at least one
    Error(ErrorKind kind, std::vector<std::string> problems)
        : std::runtime_error(joined(problems)), kind_(kind), problems_(std::move(problems)) {}
    /// The lines of the message.
    std::vector<std::string> const& problems() const { return problems_; }
    /// What the user can do about the error.
    ErrorKind kind() const { return kind_; }

  private:
    static std::string joined(std::vector<std::string> const& lines) {
        std::string text;
        for (std::string const& line : lines) text += (text.empty() ? "" : "\n") + line;
        return text;
    }

    ErrorKind kind_;
    std::vector<std::string> problems_;
};

/// The user's input is wrong.
class InputError : public Error {
  public:
    /// @param message  one line without a line end
    explicit InputError(std::string const& message) : Error(ErrorKind::input, message) {}
    /// @param problems  a line for each mistake, at least one
    explicit InputError(std::vector<std::string> problems) : Error(ErrorKind::input, std::move(problems)) {}
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
