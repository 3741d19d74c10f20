#include "store/hdf5_values.hpp"

#include <algorithm>
#include <utility>

namespace vibrotrough::store {
namespace {

template <typename Number>
Packed pack_numbers(std::vector<Number> const& values, hid_t type) {
    return {Hdf5Handle(H5Tcopy(type), H5Tclose, "copy a number type"),
            std::string(reinterpret_cast<char const*>(values.data()), values.size() * sizeof(Number))};
}

Packed pack_all(std::vector<int> const& values) {
    static_assert(sizeof(int) == 4);
    return pack_numbers(values, H5T_STD_I32LE);
}

Packed pack_all(std::vector<double> const& values) {
    return pack_numbers(values, H5T_IEEE_F64LE);
}

Packed pack_all(std::vector<std::string> const& values) {
    std::size_t length = 1;
    for (std::string const& text : values) length = std::max(length, text.size());
    std::string bytes;
    for (std::string const& text : values) bytes += text + std::string(length - text.size(), '\0');
    return {text_type(length), std::move(bytes)};
}

}  // namespace

Hdf5Handle::Hdf5Handle(hid_t id, Close closer, std::string const& action) : id_(id), close_(closer) {
    require(id >= 0, action);
}

Hdf5Handle::Hdf5Handle(Hdf5Handle&& other) noexcept
    : id_(std::exchange(other.id_, -1)), close_(other.close_) {}

Hdf5Handle::~Hdf5Handle() {
    if (id_ >= 0) close_(id_);
}

void require(bool success, std::string const& action) {
    if (!success) throw Hdf5Error(action);
}

Hdf5Handle text_type(std::size_t length) {
    Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "make a text type");
    require(H5Tset_size(type.id(), std::max<std::size_t>(length, 1)) >= 0, "size a text type");
    require(H5Tset_cset(type.id(), H5T_CSET_UTF8) >= 0, "set a text type to UTF-8");
    require(H5Tset_strpad(type.id(), H5T_STR_NULLPAD) >= 0, "pad a text type");
    return type;
}

Hdf5Handle data_space(std::size_t count, Rank rank) {
    hsize_t const extent = count;
    return Hdf5Handle(rank == Rank::scalar ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &extent, nullptr),
                      H5Sclose, "make a data space");
}

Packed pack(Values const& values) {
    return std::visit([](auto const& all) { return pack_all(all); }, values);
}

std::size_t count(Values const& values) {
    return std::visit([](auto const& all) { return all.size(); }, values);
}

Hdf5CreationProperties::Hdf5CreationProperties()
    : text_type(store::text_type(H5T_VARIABLE)),
      scalar_space(data_space(1, Rank::scalar)),
      with_parent_groups(H5Pcreate(H5P_LINK_CREATE), H5Pclose, "make link properties"),
      without_time_stamps(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "make dataset properties") {
    require(H5Pset_create_intermediate_group(with_parent_groups.id(), 1) >= 0, "ask for groups");
    require(H5Pset_obj_track_times(without_time_stamps.id(), 0) >= 0, "leave out times");
}

void write_attribute(hid_t object, std::string const& name, hid_t type, Hdf5Handle const& space,
                     void const* value) {
    Hdf5Handle const attribute(H5Acreate2(object, name.c_str(), type, space.id(), H5P_DEFAULT, H5P_DEFAULT),
                               H5Aclose, "make the attribute " + name);
    require(H5Awrite(attribute.id(), type, value) >= 0, "write the attribute " + name);
}

Hdf5Handle write_dataset(hid_t file, Hdf5CreationProperties const& properties, std::string const& path,
                         Hdf5Handle const& type, Hdf5Handle const& space, std::string const& bytes) {
    Hdf5Handle data(H5Dcreate2(file, path.c_str(), type.id(), space.id(), properties.with_parent_groups.id(),
                               properties.without_time_stamps.id(), H5P_DEFAULT),
                    H5Dclose, "make the dataset " + path);
    if (!bytes.empty()) {
        require(H5Dwrite(data.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) >= 0,
                "write the dataset " + path);
    }
    return data;
}

}  // namespace vibrotrough::store
