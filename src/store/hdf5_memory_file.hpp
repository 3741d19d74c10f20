#pragma once

#include <mutex>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <hdf5.h>

namespace vibrotrough::store {

/// HDF5 failed, or the file does not have the content that the schema demands. The message is "cannot
/// <action>". It names the object in the file, but not the file.
class Hdf5Error : public std::runtime_error {
  public:
    /// @param action  what failed, e.g. "read the dataset packings"
    explicit Hdf5Error(std::string const& action) : std::runtime_error("cannot " + action) {}
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

/// The shape of a dataset.
enum class Rank {
    scalar,  ///< exactly one value
    array,   ///< one dimension, which may be empty
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

/// The types and properties with which all datasets and attributes of a file are made.
struct Hdf5CreationProperties {
    /// @throws Hdf5Error when HDF5 cannot make them
    Hdf5CreationProperties();
    Hdf5Handle text_type;            ///< of attributes
    Hdf5Handle scalar_space;         ///< shape of a single value
    Hdf5Handle with_parent_groups;   ///< link properties: missing groups are made on the way
    Hdf5Handle without_time_stamps;  ///< dataset properties: the same values always give the same bytes
};

/// Lets one thread at a time use HDF5, whose usual builds are not thread-safe, and switches off the messages
/// that HDF5 itself prints about errors.
class Hdf5Session {
  public:
    /// Waits until no other thread has a session.
    Hdf5Session();

  private:
    std::lock_guard<std::mutex> lock_;
};

/// Makes an HDF5 file in memory. Its bytes are then written like those of any other file, so that a full disk
/// is an ordinary error and not one inside HDF5. Every function throws Hdf5Error when HDF5 fails.
class Hdf5MemoryFileWriter {
  public:
    /// Begins an empty file.
    Hdf5MemoryFileWriter();
    /// Writes an attribute of the root.
    void attribute(std::string const& name, int value);
    /// Writes an attribute of the root as UTF-8.
    void attribute(std::string const& name, std::string const& value);

    /// Writes a dataset with its attributes `units` and `description`. Missing groups on the path are made.
    void dataset(std::string const& path, Values const& values, Rank rank, std::string_view units,
                 std::string_view description);

    /// Writes a table: one dataset of compound type, a field per column, with the attributes `units` and
    /// `description`, a text for each field in order.
    void table(std::string const& path, std::vector<Hdf5Column> const& columns, Rank rank);

    /// Writes values in two dimensions, row by row, with the attributes `units` and `description`.
    void grid(std::string const& path, Values const& values, std::size_t rows, std::size_t columns,
              std::string_view units, std::string_view description);

    /// The bytes of the file, followed by a line with their SHA-256. HDF5's readers ignore that line. Ours
    /// checks it, because HDF5 may crash on a damaged file.
    std::string bytes() const;

  private:
    void write(std::string const& path, Values const& values, Hdf5Handle const& space, std::string_view units,
               std::string_view description);

    Hdf5Session session_;
    Hdf5CreationProperties properties_;
    Hdf5Handle file_;
};

/// A table of an HDF5 file.
class Hdf5Table {
  public:
    /// Reads the table.
    /// @param limit  largest size that the table may have, bytes
    /// @throws Hdf5Error when it is missing, too large, or of another shape or type
    Hdf5Table(hid_t file, std::string const& path, Rank rank, std::size_t limit);
    /// Number of rows.
    std::size_t rows() const { return rows_; }

    /// Whether there is a column with this name.
    bool has(std::string const& name) const;

    /// Values of a column: int, double or std::string.
    /// @throws Hdf5Error when the column is missing or of another type
    template <typename Value>
    std::vector<Value> values(std::string const& name) const;

  private:
    /// A column's bytes, `size` for each row.
    struct Place {
        std::size_t offset, size;
    };
    Place find(std::string const& name, H5T_class_t kind) const;

    std::string path_;
    Hdf5Handle data_, type_;
    std::size_t rows_ = 0;
    std::size_t row_size_ = 0;
    std::string bytes_;
};

/// Reads an HDF5 file from memory. Every function throws Hdf5Error when the object is missing or of another
/// type.
class Hdf5MemoryFileReader {
  public:
    /// @throws Hdf5Error when the bytes are not as Hdf5MemoryFileWriter gave them
    explicit Hdf5MemoryFileReader(std::string bytes);
    /// Whether the root has such an attribute.
    bool has_attribute(std::string const& name) const;
    /// An attribute of the root that is a whole number.
    int integer_attribute(std::string const& name) const;
    /// An attribute of the root that is a text.
    std::string text_attribute(std::string const& name) const;

    /// Reads a table.
    Hdf5Table table(std::string const& path, Rank rank) const {
        return Hdf5Table(file_.id(), path, rank, size_);
    }

    /// Values of a dataset: int, double or std::string.
    template <typename Value>
    std::vector<Value> values(std::string const& path, Rank rank) const;

  private:
    Hdf5Session session_;
    std::size_t size_;  ///< of the file, bytes; no dataset can be larger
    Hdf5Handle file_;
};

/// @cond  The specialisations are documented at their templates.
template <>
std::vector<int> Hdf5MemoryFileReader::values(std::string const& path, Rank rank) const;
template <>
std::vector<double> Hdf5MemoryFileReader::values(std::string const& path, Rank rank) const;
template <>
std::vector<std::string> Hdf5MemoryFileReader::values(std::string const& path, Rank rank) const;

template <>
std::vector<int> Hdf5Table::values(std::string const& name) const;
template <>
std::vector<double> Hdf5Table::values(std::string const& name) const;
template <>
std::vector<std::string> Hdf5Table::values(std::string const& name) const;
/// @endcond

}  // namespace vibrotrough::store
