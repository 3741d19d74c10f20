#pragma once

#include <filesystem>
#include <utility>

namespace vibrotrough::core {

/// An open file that closes itself.
class Descriptor {
  public:
    /// Takes an open file over; -1 is none.
    explicit Descriptor(int number = -1) : number_(number) {}
    /// Closes the file and leaves errno as it is.
    ~Descriptor();
    /// Takes the file of another object over.
    Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
    /// The same; the other object closes the file that this one had.
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(number_, other.number_);
        return *this;
    }

    bool is_open() const { return number_ >= 0; }  ///< otherwise errno said why not
    int number() const { return number_; }         ///< for the functions of the system
    /// Closes the file at once. @return false with errno when what was written did not reach it
    bool close();

  private:
    int number_;
};

/// The kinds of files that a reader takes.
enum class Kinds {
    regular,  ///< regular files only
    given,    ///< also pipes and devices, which a person may name on the command line; the opening may wait
};

/// Opens a file for reading. Nothing is waited for unless the person gave the file.
/// @returns not open, with errno, when the file cannot be opened; errno is ESPIPE when it is of another kind.
/// Folders are opened; reading from them fails.
Descriptor open_to_read(std::filesystem::path const& path, Kinds kinds);

}  // namespace vibrotrough::core
