#include "store/hdf5_values.hpp"

#include <algorithm>
#include <cstring>

namespace vibrotrough::store {
namespace {

void write_texts(hid_t object, Hdf5CreationProperties const& properties, std::string const& name,
                 std::vector<std::string> const& texts) {
    std::vector<char const*> pointers;
    for (std::string const& text : texts) pointers.push_back(text.c_str());
    write_attribute(object, name, properties.text_type.id(), data_space(texts.size(), Rank::array),
                    pointers.data());
}

/// Whether a column has a type that this program writes: its kinds of numbers, or texts of fixed length. HDF5
/// would read other types as addresses.
bool is_known(hid_t type) {
    switch (H5Tget_class(type)) {
        case H5T_INTEGER:
            return H5Tequal(type, H5T_STD_I32LE) > 0;
        case H5T_FLOAT:
            return H5Tequal(type, H5T_IEEE_F64LE) > 0;
        case H5T_STRING:
            return H5Tis_variable_str(type) == 0;
        default:
            return false;
    }
}

Hdf5Handle member(hid_t type, unsigned int index, std::string const& path) {
    return Hdf5Handle(H5Tget_member_type(type, index), H5Tclose, "read the columns of " + path);
}

}  // namespace

void Hdf5MemoryFileWriter::table(std::string const& path, std::vector<Hdf5Column> const& columns, Rank rank) {
    std::size_t const rows = count(columns.at(0).values);
    require(rank == Rank::array || rows == 1, "write " + path + ", a scalar is one row");
    std::vector<Packed> packed;
    std::vector<std::size_t> sizes;
    std::vector<std::string> units, descriptions;
    std::size_t row_size = 0;
    for (Hdf5Column const& column : columns) {
        require(count(column.values) == rows, "write " + path + ", its columns differ in length");
        packed.push_back(pack(column.values));
        sizes.push_back(H5Tget_size(packed.back().type.id()));
        row_size += sizes.back();
        units.emplace_back(column.units);
        descriptions.emplace_back(column.description);
    }
    Hdf5Handle const type(H5Tcreate(H5T_COMPOUND, row_size), H5Tclose, "make the type of " + path);
    std::string bytes(rows * row_size, '\0');
    std::size_t offset = 0;
    for (std::size_t c = 0; c < columns.size(); ++c) {
        require(H5Tinsert(type.id(), std::string(columns[c].name).c_str(), offset, packed[c].type.id()) >= 0,
                "add a column to " + path);
        for (std::size_t row = 0; row < rows; ++row) {
            std::memcpy(bytes.data() + row * row_size + offset, packed[c].bytes.data() + row * sizes[c],
                        sizes[c]);
        }
        offset += sizes[c];
    }
    Hdf5Handle const data = write_dataset(file_.id(), properties_, path, type, data_space(rows, rank), bytes);
    write_texts(data.id(), properties_, "units", units);
    write_texts(data.id(), properties_, "description", descriptions);
}

Hdf5Table::Hdf5Table(hid_t file, std::string const& path, Rank rank, std::size_t limit)
    : path_(path),
      data_(H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose, "find the table " + path),
      type_(H5Dget_type(data_.id()), H5Tclose, "read the type of " + path) {
    require(H5Tget_class(type_.id()) == H5T_COMPOUND, "use the dataset " + path + ", it is not a table");
    int const columns = H5Tget_nmembers(type_.id());
    for (int c = 0; c < columns; ++c) {
        require(is_known(member(type_.id(), static_cast<unsigned int>(c), path).id()),
                "use the table " + path + ", one of its columns has another type");
    }
    Hdf5Handle const space(H5Dget_space(data_.id()), H5Sclose, "read the shape of " + path);
    require(H5Sget_simple_extent_ndims(space.id()) == (rank == Rank::scalar ? 0 : 1),
            "use the table " + path + ", it has another shape");
    rows_ = static_cast<std::size_t>(std::max<hssize_t>(H5Sget_simple_extent_npoints(space.id()), 0));
    row_size_ = std::max<std::size_t>(H5Tget_size(type_.id()), 1);
    // Nothing is compressed, so a table cannot be larger than the file. Do not reserve memory for a wrong
    // size.
    require(rows_ <= limit / row_size_, "use the table " + path + ", it is larger than the file");
    bytes_.resize(rows_ * row_size_);
    require(H5Dread(data_.id(), type_.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes_.data()) >= 0,
            "read the table " + path);
}

Hdf5Table::Place Hdf5Table::find(std::string const& name, H5T_class_t kind) const {
    int const index = H5Tget_member_index(type_.id(), name.c_str());
    require(index >= 0, "find the column " + name + " of " + path_);
    auto const column = static_cast<unsigned int>(index);
    Hdf5Handle const type = member(type_.id(), column, path_);
    Place const place{H5Tget_member_offset(type_.id(), column), H5Tget_size(type.id())};
    require(H5Tget_class(type.id()) == kind && place.offset <= row_size_ &&
                place.size <= row_size_ - place.offset,
            "use the column " + name + " of " + path_ + ", it has another type");
    return place;
}

bool Hdf5Table::has(std::string const& name) const {
    int const columns = H5Tget_nmembers(type_.id());
    for (int c = 0; c < columns; ++c) {
        char* const found = H5Tget_member_name(type_.id(), static_cast<unsigned int>(c));
        bool const is_it = found != nullptr && name == found;
        H5free_memory(found);
        if (is_it) return true;
    }
    return false;
}

template <>
std::vector<int> Hdf5Table::values(std::string const& name) const {
    Place const place = find(name, H5T_INTEGER);
    std::vector<int> values(rows_);
    for (std::size_t row = 0; row < rows_; ++row)
        std::memcpy(&values[row], bytes_.data() + row * row_size_ + place.offset, sizeof(int));
    return values;
}

template <>
std::vector<double> Hdf5Table::values(std::string const& name) const {
    Place const place = find(name, H5T_FLOAT);
    std::vector<double> values(rows_);
    for (std::size_t row = 0; row < rows_; ++row)
        std::memcpy(&values[row], bytes_.data() + row * row_size_ + place.offset, sizeof(double));
    return values;
}

template <>
std::vector<std::string> Hdf5Table::values(std::string const& name) const {
    Place const place = find(name, H5T_STRING);
    std::vector<std::string> texts(rows_);
    for (std::size_t row = 0; row < rows_; ++row) {
        texts[row] = bytes_.substr(row * row_size_ + place.offset, place.size);
        texts[row].resize(std::min(texts[row].find('\0'), texts[row].size()));
    }
    return texts;
}

}  // namespace vibrotrough::store
