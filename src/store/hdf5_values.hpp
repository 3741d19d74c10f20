#pragma once

#include "store/hdf5_memory_file.hpp"

/// @file
/// Functions that the files of this room which call HDF5 share.

namespace vibrotrough::store {

/// @throws Hdf5Error "cannot <action>" unless `success`
void require(bool success, std::string const& action);

/// The HDF5 type of UTF-8 texts of at most `length` bytes. Texts of datasets have a fixed length, because
/// HDF5's heap for texts of variable length has no checksum and makes small files larger. Attributes have the
/// length H5T_VARIABLE nevertheless, because only then does h5py read them as str.
Hdf5Handle text_type(std::size_t length);

/// The HDF5 shape of `count` values; `count` must be 1 for a scalar.
Hdf5Handle data_space(std::size_t count, Rank rank);

/// Values as HDF5 stores them.
struct Packed {
    Hdf5Handle type;    ///< of one value
    std::string bytes;  ///< of all values, one after the other
};

/// Converts values to bytes.
Packed pack(Values const& values);

/// Number of values.
std::size_t count(Values const& values);

/// Writes an attribute of a file or dataset.
/// @param value  address of the value or values, of the HDF5 type `type`
/// @throws Hdf5Error when HDF5 fails
void write_attribute(hid_t object, std::string const& name, hid_t type, Hdf5Handle const& space,
                     void const* value);

/// Makes a dataset and the missing groups on its path, and writes its bytes. @throws Hdf5Error when HDF5
/// fails
Hdf5Handle write_dataset(hid_t file, Hdf5CreationProperties const& properties, std::string const& path,
                         Hdf5Handle const& type, Hdf5Handle const& space, std::string const& bytes);

}  // namespace vibrotrough::store
