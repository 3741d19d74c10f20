#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <hdf5.h>

/// @file
/// HDF5 files as this program writes and reads them. All that they hold has a checksum: the values that of
/// the filter Fletcher32, the rest those of HDF5's own format since version 1.10. So datasets have no scalar
/// shape, which HDF5 cannot filter, and texts have a fixed length, because HDF5 keeps those of variable
/// length in a heap without a checksum, and may crash on a damaged one.

namespace vibrotrough::store {

/// HDF5 failed, or the file does not have the content that the schema demands. The message is "cannot
/// <action>". It names the object in the file, but not the file.
class Hdf5Error : public std::runtime_error {
  public:
    /// @param action  what failed, e.g. "read the dataset packings"
    explicit Hdf5Error(std::string const& action);
    /// errno when it was thrown.
    int system_error() const { return system_error_; }

  private:
    int system_error_;
};

/// Values of one dataset: 32-bit integers, 64-bit floats or UTF-8 texts.
using Values = std::variant<std::vector<int>, std::vector<double>, std::vector<std::string>>;

/// One column of a table.
struct Hdf5Column {
    std::string_view name;         ///< of the field
    std::string_view units;        ///< in the spelling of udunits2; "1" for pure numbers and texts
    std::string_view description;  ///< meaning of the column
    Values values;                 ///< one per row
};

/// An HDF5 handle that closes itself.
class Hdf5Handle {
  public:
    /// HDF5's function that closes a handle of this kind, such as H5Dclose.
    using Close = herr_t (*)(hid_t);

    /// @throws Hdf5Error "cannot <action>" when `id` is not a valid handle
    Hdf5Handle(hid_t id, Close closer, std::string const& action);
    Hdf5Handle(Hdf5Handle const&) = delete;
    Hdf5Handle& operator=(Hdf5Handle const&) = delete;
    /// Takes the handle over.
    Hdf5Handle(Hdf5Handle&& other) noexcept;
    Hdf5Handle& operator=(Hdf5Handle&&) = delete;
    /// Closes the handle.
    ~Hdf5Handle();
    /// The handle for HDF5's functions.
    hid_t id() const { return id_; }

  private:
    hid_t id_;
    Close close_;
};

/// Lets one thread at a time use HDF5, whose usual builds are not thread-safe, and switches off what HDF5
/// itself prints about errors and does at the end of the program.
class Hdf5Session {
  public:
    /// Waits until no other thread has a session.
    Hdf5Session();

  private:
    std::lock_guard<std::mutex> lock_;
};

/// Fills an HDF5 file. Every function throws Hdf5Error when HDF5 fails. Groups on a path are made.
class Hdf5Writer {
  public:
    /// Begins a file, in place of one that is there. write_hdf5() is what calls it.
    explicit Hdf5Writer(std::filesystem::path const& path);
    /// Writes an attribute of the root.
    void attribute(std::string const& name, int value);
    /// Writes an attribute of the root as UTF-8.
    void attribute(std::string const& name, std::string const& value);

    /// Writes a dataset with its attributes `units` and `description`.
    void dataset(std::string const& path, Values const& values, std::string_view units,
                 std::string_view description);

    /// Writes a table: one dataset of compound type, a field per column, with the attributes `units` and
    /// `description`, a text for each field in order.
    void table(std::string const& path, std::vector<Hdf5Column> const& columns);

    /// Writes values in two dimensions, row by row, with the attributes `units` and `description`.
    void grid(std::string const& path, Values const& values, std::size_t rows, std::size_t columns,
              std::string_view units, std::string_view description);

    /// Hands all to the system.
    void flush();

  private:
    Hdf5Session session_;
    Hdf5Handle file_;
};

/// Writes an HDF5 file that appears whole or not at all, and stays after a power cut (core::NewFile).
/// @param fill  writes all that is in it
/// @throws core::MissingError when it cannot be written, a core::DiskFullError when the disk is full
void write_hdf5(std::filesystem::path const& path, std::function<void(Hdf5Writer&)> const& fill);

/// The rows of a dataset in memory: those of a table, or one column of values without a name.
class Hdf5Table {
  public:
    /// Reads the dataset.
    /// @param limit  largest size that it may have, bytes
    /// @throws Hdf5Error when it is damaged, too large, or of a type that this program does not write
    Hdf5Table(hid_t file, std::string const& path, std::size_t limit);
    /// Number of rows.
    std::size_t rows() const { return rows_; }

    /// Whether there is a column with this name.
    bool has(std::string const& name) const { return columns_.contains(name); }

    /// Values of a column: int, double or std::string. The name is empty for a dataset that is not a table.
    /// @throws Hdf5Error when the column is missing or of another type
    template <typename Value>
    std::vector<Value> values(std::string const& name) const;

  private:
    struct Column {
        H5T_class_t kind;
        std::size_t offset, size;  ///< in a row, bytes
    };
    void add_column(hid_t type, std::string const& name, std::size_t offset);

    std::string path_;
    std::map<std::string, Column> columns_;
    std::size_t rows_ = 0, row_size_ = 0;
    std::string bytes_;
};

/// Reads an HDF5 file.
class Hdf5Reader {
  public:
    /// Opens the file. @throws Hdf5Error when it is not an HDF5 file, or cut short, and core::MissingError
    /// when there is no such regular file
    explicit Hdf5Reader(std::filesystem::path const& path);
    /// An attribute of the root that is a whole number; none when there is none.
    std::optional<int> whole_number(std::string const& name) const;
    /// An attribute of the root that is a text. @throws Hdf5Error when there is none
    std::string text(std::string const& name) const;
    /// All datasets by their paths. @throws Hdf5Error when something in the file is damaged
    std::map<std::string, Hdf5Table> read_all() const;

  private:
    Hdf5Session session_;
    std::size_t size_;  ///< of the file, bytes; no dataset can be larger
    Hdf5Handle file_;
};

}  // namespace vibrotrough::store
