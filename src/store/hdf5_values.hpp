#pragma once

#include "store/hdf5_image.hpp"

/// What the files of this room that speak to HDF5 share.
namespace vibrotrough::store {

/// @throws Hdf5Error "cannot <action>" unless `success`
void require(bool success, std::string const& action);

/// Texts of datasets have one fixed length: HDF5's heap for others carries no checksum and bloats small
/// files. Those of attributes (length H5T_VARIABLE) are in that heap all the same, because only then h5py
/// gives them as str.
Handle text_type(std::size_t length);

Handle data_space(std::size_t count, Rank rank);

/// Values' bytes, one after the other, and the HDF5 type of one.
struct Packed {
    Handle type;
    std::string bytes;
};

Packed pack(Values const& values);

std::size_t count(Values const& values);

void write_attribute(hid_t object, std::string const& name, hid_t type, Handle const& space,
                     void const* value);

/// Makes a dataset with the groups above it and writes its bytes.
Handle write_dataset(hid_t file, Makings const& makings, std::string const& path, Handle const& type,
                     Handle const& space, std::string const& bytes);

}  // namespace vibrotrough::store
