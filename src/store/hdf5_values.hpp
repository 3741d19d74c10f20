#pragma once

#include "store/hdf5_memory_file.hpp"

/// What the files of this room that speak to HDF5 share.
namespace vibrotrough::store {

/// @throws Hdf5Error "cannot <action>" unless `success`
void require(bool success, std::string const& action);

/// Texts of datasets have one fixed length: HDF5's heap for others carries no checksum and bloats small
/// files. Those of attributes (length H5T_VARIABLE) are in that heap all the same, because only then h5py
/// gives them as str.
Hdf5Handle text_type(std::size_t length);

Hdf5Handle data_space(std::size_t count, Rank rank);

/// Values' bytes, one after the other, and the HDF5 type of one.
struct Packed {
    Hdf5Handle type;
    std::string bytes;
};

Packed pack(Values const& values);

std::size_t count(Values const& values);

void write_attribute(hid_t object, std::string const& name, hid_t type, Hdf5Handle const& space,
                     void const* value);

/// Makes a dataset with the groups above it and writes its bytes.
Hdf5Handle write_dataset(hid_t file, Hdf5CreationProperties const& properties, std::string const& path,
                         Hdf5Handle const& type, Hdf5Handle const& space, std::string const& bytes);

}  // namespace vibrotrough::store
