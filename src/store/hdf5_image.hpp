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
struct Column {
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
class Handle {
  public:
    using Close = herr_t (*)(hid_t);

    /// @throws Hdf5Error "cannot <action>" when `id` is no valid handle
    Handle(hid_t id, Close closer, std::string const& action);
    Handle(Handle const&) = delete;
    Handle& operator=(Handle const&) = delete;
    Handle(Handle&& other) noexcept;
    Handle& operator=(Handle&&) = delete;
    ~Handle();
    hid_t id() const { return id_; }

  private:
    hid_t id_;
    Close close_;
};

/// What all datasets and attributes of a file are made with.
struct Makings {
    Makings();
    Handle text;       ///< type of attributes
    Handle one;        ///< shape of one value
    Handle in_groups;  ///< link properties: groups are made on the way
    Handle timeless;   ///< dataset properties: same values, same bytes
};

/// One thread at a time is inside HDF5, whose usual builds are not thread-safe; its own error print is off.
class Hdf5Session {
  public:
    Hdf5Session();

  private:
    std::lock_guard<std::mutex> lock_;
};

/// Makes an HDF5 file in memory, so that a refusing disk is met by a plain write and not inside HDF5.
class ImageWriter {
  public:
    ImageWriter();
    void attribute(std::string const& name, int value);
    void attribute(std::string const& name, std::string const& value);

    /// Writes a dataset with its groups and the attributes `units` and `description`.
    void dataset(std::string const& path, Values const& values, Rank rank, std::string_view units,
                 std::string_view description);

    /// Writes a table: one dataset of compound type, a field per column, with the attributes `units` and
    /// `description`, a text for each field in order.
    void table(std::string const& path, std::vector<Column> const& columns, Rank rank);

    /// Writes numbers of one kind in two dimensions, row by row, and the attributes of dataset().
    void grid(std::string const& path, Values const& values, std::size_t rows, std::size_t columns,
              std::string_view units, std::string_view description);

    /// The bytes of the file, and after HDF5's end a line with their SHA-256. HDF5's
    /// readers do not look there; ours does, because HDF5 itself may crash on a damaged file.
    std::string bytes() const;

  private:
    void write(std::string const& path, Values const& values, Handle const& space, std::string_view units,
               std::string_view description);

    Hdf5Session session_;
    Makings makings_;
    Handle file_;
};

/// A table that was read. Every function throws Hdf5Error when the column is missing or of another kind.
class ImageTable {
  public:
    /// @param limit  bytes; the table must not claim more
    ImageTable(hid_t file, std::string const& path, Rank rank, std::size_t limit);
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
    Handle data_, type_;
    std::size_t rows_ = 0;
    std::size_t row_size_ = 0;
    std::string bytes_;
};

/// Reads an HDF5 file from memory. Every function throws Hdf5Error when the object is missing or of another
/// kind.
class ImageReader {
  public:
    /// @throws Hdf5Error when the bytes are not as ImageWriter gave them
    explicit ImageReader(std::string bytes);
    bool has_attribute(std::string const& name) const;
    int integer_attribute(std::string const& name) const;
    std::string text_attribute(std::string const& name) const;

    ImageTable table(std::string const& path, Rank rank) const {
        return ImageTable(file_.id(), path, rank, size_);
    }

    /// Values of a dataset: int, double or std::string.
    template <typename Value>
    std::vector<Value> values(std::string const& path, Rank rank) const;

  private:
    Hdf5Session session_;
    std::size_t size_;  ///< of the file, no dataset may claim more
    Handle file_;
};

template <>
std::vector<int> ImageReader::values(std::string const& path, Rank rank) const;
template <>
std::vector<double> ImageReader::values(std::string const& path, Rank rank) const;
template <>
std::vector<std::string> ImageReader::values(std::string const& path, Rank rank) const;

template <>
std::vector<int> ImageTable::values(std::string const& name) const;
template <>
std::vector<double> ImageTable::values(std::string const& name) const;
template <>
std::vector<std::string> ImageTable::values(std::string const& name) const;

}  // namespace vibrotrough::store
