#pragma once

#include <mutex>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <hdf5.h>

namespace vibrotrough::store {

/// HDF5 refused, or the file does not hold what the schema says. The message, "cannot <action>", names the
/// object in the file, not the file.
class Hdf5Error : public std::runtime_error {
  public:
    explicit Hdf5Error(std::string const& action) : std::runtime_error("cannot " + action) {}
};

/// Values of one dataset: 32-bit integers, 64-bit floats or UTF-8 texts.
using Values = std::variant<std::vector<int>, std::vector<double>, std::vector<std::string>>;

/// One column of a table.
struct Hdf5Column {
    std::string_view name;
    std::string_view units;
    std::string_view description;
    Values values;
};

enum class Rank {
    scalar,  ///< exactly one value
    array,   ///< one dimension, may be empty
};

/// An HDF5 handle that closes itself.
class Hdf5Handle {
  public:
    using Close = herr_t (*)(hid_t);

    /// @throws Hdf5Error "cannot <action>" when `id` is not a valid handle
    Hdf5Handle(hid_t id, Close closer, std::string const& action);
    Hdf5Handle(Hdf5Handle const&) = delete;
    Hdf5Handle& operator=(Hdf5Handle const&) = delete;
    Hdf5Handle(Hdf5Handle&& other) noexcept;
    Hdf5Handle& operator=(Hdf5Handle&&) = delete;
    ~Hdf5Handle();
    hid_t id() const { return id_; }

  private:
    hid_t id_;
    Close close_;
};

/// What all datasets and attributes of a file are made with.
struct Hdf5CreationProperties {
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
    Hdf5Session();

  private:
    std::lock_guard<std::mutex> lock_;
};

/// Makes an HDF5 file in memory. The bytes are then written like those of any other file, so that a full disk
/// is an ordinary error and not one inside HDF5.
class Hdf5MemoryFileWriter {
  public:
    Hdf5MemoryFileWriter();
    void attribute(std::string const& name, int value);
    void attribute(std::string const& name, std::string const& value);

    /// Writes a dataset with its groups and the attributes `units` and `description`.
    void dataset(std::string const& path, Values const& values, Rank rank, std::string_view units,
                 std::string_view description);

    /// Writes a table: one dataset of compound type, a field per column, with the attributes `units` and
    /// `description`, a text for each field in order.
    void table(std::string const& path, std::vector<Hdf5Column> const& columns, Rank rank);

    /// Writes numbers of one kind in two dimensions, row by row, and the attributes of dataset().
    void grid(std::string const& path, Values const& values, std::size_t rows, std::size_t columns,
              std::string_view units, std::string_view description);

    /// The bytes of the file, and after HDF5's end a line with their SHA-256. HDF5's
    /// readers do not look there; ours does, because HDF5 itself may crash on a damaged file.
    std::string bytes() const;

  private:
    void write(std::string const& path, Values const& values, Hdf5Handle const& space, std::string_view units,
               std::string_view description);

    Hdf5Session session_;
    Hdf5CreationProperties properties_;
    Hdf5Handle file_;
};

/// A table that was read. Every function throws Hdf5Error when the column is missing or of another kind.
class Hdf5Table {
  public:
    /// @param limit  bytes; the table must not claim more
    Hdf5Table(hid_t file, std::string const& path, Rank rank, std::size_t limit);
    std::size_t rows() const { return rows_; }

    /// Values of a column: int, double or std::string.
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
/// kind.
class Hdf5MemoryFileReader {
  public:
    /// @throws Hdf5Error when the bytes are not as Hdf5MemoryFileWriter gave them
    explicit Hdf5MemoryFileReader(std::string bytes);
    bool has_attribute(std::string const& name) const;
    int integer_attribute(std::string const& name) const;
    std::string text_attribute(std::string const& name) const;

    Hdf5Table table(std::string const& path, Rank rank) const {
        return Hdf5Table(file_.id(), path, rank, size_);
    }

    /// Values of a dataset: int, double or std::string.
    template <typename Value>
    std::vector<Value> values(std::string const& path, Rank rank) const;

  private:
    Hdf5Session session_;
    std::size_t size_;  ///< of the file, no dataset may claim more
    Hdf5Handle file_;
};

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

}  // namespace vibrotrough::store
