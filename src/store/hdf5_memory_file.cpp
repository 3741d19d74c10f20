#include "store/hdf5_memory_file.hpp"

#include "store/file_digest.hpp"
#include "store/hdf5_values.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

namespace vibrotrough::store {
namespace {

/// HDF5's memory driver needs the name of a file that does not exist. No file can exist below a device.
constexpr char const* path_that_cannot_exist = "/dev/null/vibrotrough";

std::mutex one_at_a_time;

/// An attribute of one value, after checking that its type is of the class wanted.
Hdf5Handle open_attribute(hid_t file, std::string const& name, H5T_class_t kind) {
    Hdf5Handle attribute(H5Aopen(file, name.c_str(), H5P_DEFAULT), H5Aclose, "find the attribute " + name);
    Hdf5Handle const space(H5Aget_space(attribute.id()), H5Sclose, "read the shape of the attribute " + name);
    Hdf5Handle const type(H5Aget_type(attribute.id()), H5Tclose, "read the type of the attribute " + name);
    require(H5Tget_class(type.id()) == kind && H5Sget_simple_extent_npoints(space.id()) == 1 &&
                (kind != H5T_STRING || H5Tis_variable_str(type.id()) > 0),
            "use the attribute " + name + ", it has another type or shape");
    return attribute;
}

Hdf5Handle make_file() {
    Hdf5Handle const access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "make access properties");
    std::size_t constexpr increment = std::size_t{1} << 16;
    require(H5Pset_fapl_core(access.id(), increment, 0) >= 0, "choose HDF5's memory driver");
    // Reserve no space, so that the file is only as long as what it holds.
    require(H5Pset_meta_block_size(access.id(), 0) >= 0 && H5Pset_small_data_block_size(access.id(), 0) >= 0,
            "switch off reserves");
    return Hdf5Handle(H5Fcreate(path_that_cannot_exist, H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), H5Fclose,
                      "make a file");
}

/// The HDF5 file without its checksum line, which must be right.
std::string without_checksum(std::string bytes) {
    require(stated_digest(bytes).has_value(), "find its last line, it is cut short or of another kind");
    require(sound_digest(bytes).has_value(), "trust it, its bytes do not match the SHA-256 in its last line");
    bytes.resize(without_digest(bytes).size());
    return bytes;
}

Hdf5Handle open_file(std::string bytes) {
    Hdf5Handle const access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "make access properties");
    std::size_t constexpr increment = std::size_t{1} << 16;
    require(H5Pset_fapl_core(access.id(), increment, 0) >= 0, "choose HDF5's memory driver");
    require(H5Pset_file_image(access.id(), bytes.data(), bytes.size()) >= 0, "hand the bytes to HDF5");
    return Hdf5Handle(H5Fopen(path_that_cannot_exist, H5F_ACC_RDONLY, access.id()), H5Fclose,
                      "open it as HDF5");
}

/// A dataset's values as bytes, `size` each, after checking type and shape.
struct RawDataset {
    std::string bytes;
    std::size_t count;
    std::size_t size;
};

RawDataset read_raw(hid_t file, std::string const& path, Rank rank, H5T_class_t kind, std::size_t limit) {
    Hdf5Handle const data(H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose, "find the dataset " + path);
    Hdf5Handle const stored(H5Dget_type(data.id()), H5Tclose, "read the type of " + path);
    require(H5Tget_class(stored.id()) == kind, "use the dataset " + path + ", it has another type");
    Hdf5Handle const space(H5Dget_space(data.id()), H5Sclose, "read the shape of " + path);
    require(H5Sget_simple_extent_ndims(space.id()) == (rank == Rank::scalar ? 0 : 1),
            "use the dataset " + path + ", it has another shape");

    auto const count =
        static_cast<std::size_t>(std::max<hssize_t>(H5Sget_simple_extent_npoints(space.id()), 0));
    std::size_t const size = kind == H5T_STRING    ? std::max<std::size_t>(H5Tget_size(stored.id()), 1)
                             : kind == H5T_INTEGER ? sizeof(int)
                                                   : sizeof(double);
    // Nothing is compressed, so a dataset cannot be larger than the file. Do not reserve memory for a wrong
    // size.
    require(count <= limit / size, "use the dataset " + path + ", it is larger than the file");
    Hdf5Handle const wanted = kind == H5T_STRING
                                  ? text_type(size)
                                  : Hdf5Handle(H5Tcopy(kind == H5T_INTEGER ? H5T_STD_I32LE : H5T_IEEE_F64LE),
                                               H5Tclose, "copy a number type");
    RawDataset raw{std::string(count * size, '\0'), count, size};
    require(H5Dread(data.id(), wanted.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, raw.bytes.data()) >= 0,
            "read the dataset " + path);
    return raw;
}

template <typename Number>
std::vector<Number> numbers(RawDataset const& raw) {
    std::vector<Number> values(raw.count);
    std::copy(raw.bytes.begin(), raw.bytes.end(), reinterpret_cast<char*>(values.data()));
    return values;
}

}  // namespace

Hdf5Session::Hdf5Session() : lock_(one_at_a_time) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Hdf5MemoryFileWriter::Hdf5MemoryFileWriter() : file_(make_file()) {}

void Hdf5MemoryFileWriter::attribute(std::string const& name, int value) {
    write_attribute(file_.id(), name, H5T_NATIVE_INT, properties_.scalar_space, &value);
}

void Hdf5MemoryFileWriter::attribute(std::string const& name, std::string const& value) {
    char const* const text = value.c_str();
    write_attribute(file_.id(), name, properties_.text_type.id(), properties_.scalar_space, &text);
}

void Hdf5MemoryFileWriter::dataset(std::string const& path, Values const& values, Rank rank,
                                   std::string_view units, std::string_view description) {
    require(rank == Rank::array || count(values) == 1, "write " + path + ", a scalar is one value");
    write(path, values, data_space(count(values), rank), units, description);
}

void Hdf5MemoryFileWriter::grid(std::string const& path, Values const& values, std::size_t rows,
                                std::size_t columns, std::string_view units, std::string_view description) {
    require(count(values) == rows * columns, "write " + path + ", it has not rows times columns values");
    std::array<hsize_t, 2> const extent{rows, columns};
    write(path, values,
          Hdf5Handle(H5Screate_simple(2, extent.data(), nullptr), H5Sclose, "make the shape of " + path),
          units, description);
}

void Hdf5MemoryFileWriter::write(std::string const& path, Values const& values, Hdf5Handle const& space,
                                 std::string_view units, std::string_view description) {
    Packed const packed = pack(values);
    Hdf5Handle const data = write_dataset(file_.id(), properties_, path, packed.type, space, packed.bytes);
    for (auto const& [name, value] : {std::pair("units", units), std::pair("description", description)}) {
        std::string const words(value);
        char const* const text = words.c_str();
        write_attribute(data.id(), name, properties_.text_type.id(), properties_.scalar_space, &text);
    }
}

std::string Hdf5MemoryFileWriter::bytes() const {
    // The format is HDF5's oldest, the default: of newer ones H5Fget_file_image gives a wrong checksum in all
    // releases before 2025 (HDF5 issue 1915).
    require(H5Fflush(file_.id(), H5F_SCOPE_GLOBAL) >= 0, "flush the file");
    ssize_t const size = H5Fget_file_image(file_.id(), nullptr, 0);
    require(size > 0, "size the file");
    std::string hdf5_file(static_cast<std::size_t>(size), '\0');
    require(H5Fget_file_image(file_.id(), hdf5_file.data(), hdf5_file.size()) == size, "take the file");
    return with_digest(std::move(hdf5_file));
}

Hdf5MemoryFileReader::Hdf5MemoryFileReader(std::string bytes)
    : size_(bytes.size()), file_(open_file(without_checksum(std::move(bytes)))) {}

bool Hdf5MemoryFileReader::has_attribute(std::string const& name) const {
    return H5Aexists(file_.id(), name.c_str()) > 0;
}

int Hdf5MemoryFileReader::integer_attribute(std::string const& name) const {
    int value = 0;
    require(H5Aread(open_attribute(file_.id(), name, H5T_INTEGER).id(), H5T_NATIVE_INT, &value) >= 0,
            "read the attribute " + name);
    return value;
}

std::string Hdf5MemoryFileReader::text_attribute(std::string const& name) const {
    char* text = nullptr;
    require(
        H5Aread(open_attribute(file_.id(), name, H5T_STRING).id(), text_type(H5T_VARIABLE).id(), &text) >= 0,
        "read the attribute " + name);
    std::string value = text == nullptr ? "" : text;
    H5free_memory(text);
    return value;
}

template <>
std::vector<int> Hdf5MemoryFileReader::values(std::string const& path, Rank rank) const {
    RawDataset const raw = read_raw(file_.id(), path, rank, H5T_INTEGER, size_);
    return numbers<int>(raw);
}

template <>
std::vector<double> Hdf5MemoryFileReader::values(std::string const& path, Rank rank) const {
    RawDataset const raw = read_raw(file_.id(), path, rank, H5T_FLOAT, size_);
    return numbers<double>(raw);
}

template <>
std::vector<std::string> Hdf5MemoryFileReader::values(std::string const& path, Rank rank) const {
    RawDataset const raw = read_raw(file_.id(), path, rank, H5T_STRING, size_);
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < raw.count; ++i) {
        std::string text = raw.bytes.substr(i * raw.size, raw.size);
        text.resize(std::min(text.find('\0'), text.size()));
        texts.push_back(std::move(text));
    }
    return texts;
}

}  // namespace vibrotrough::store
