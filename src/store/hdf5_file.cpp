#include "store/hdf5_file.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

namespace vibrotrough::store {
namespace {

std::mutex one_at_a_time;

/// HDF5's limit is 4 GiB.
constexpr std::size_t largest_chunk = std::size_t{1} << 30;

void require(bool success, std::string const& action) {
    if (!success) throw Hdf5Error(action);
}

/// The HDF5 type of UTF-8 texts of at most `length` bytes.
Hdf5Handle text_type(std::size_t length) {
    Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "make a text type");
    require(H5Tset_size(type.id(), std::max<std::size_t>(length, 1)) >= 0 &&
                H5Tset_cset(type.id(), H5T_CSET_UTF8) >= 0 && H5Tset_strpad(type.id(), H5T_STR_NULLPAD) >= 0,
            "make a text type");
    return type;
}

/// Values as HDF5 stores them, one after the other.
struct Packed {
    Hdf5Handle type;  ///< of one value
    std::string bytes;
    std::size_t count;
    std::size_t size() const { return H5Tget_size(type.id()); }
};

template <typename Number>
Packed pack_numbers(std::vector<Number> const& values, hid_t type) {
    return {Hdf5Handle(H5Tcopy(type), H5Tclose, "copy a number type"),
            std::string(reinterpret_cast<char const*>(values.data()), values.size() * sizeof(Number)),
            values.size()};
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
    return {text_type(length), std::move(bytes), values.size()};
}

Packed pack(Values const& values) {
    return std::visit([](auto const& all) { return pack_all(all); }, values);
}

/// The same values make the same bytes.
Hdf5Handle without_times(hid_t kind) {
    Hdf5Handle made(H5Pcreate(kind), H5Pclose, "make properties");
    require(H5Pset_obj_track_times(made.id(), 0) >= 0, "leave out times");
    return made;
}

/// Names and attributes are in the header of the group, whatever their number: heaps and trees would leave
/// gaps, in which damage would not matter and not be noticed.
Hdf5Handle group_properties(hid_t kind) {
    Hdf5Handle made = without_times(kind);
    constexpr unsigned int most = 65535, least = 0;
    require(H5Pset_link_phase_change(made.id(), most, least) >= 0 &&
                H5Pset_attr_phase_change(made.id(), most, least) >= 0,
            "choose the place of names");
    return made;
}

/// Makes the groups on the way to a dataset.
void make_groups(hid_t file, std::string const& path) {
    for (std::size_t at = path.find('/'); at != path.npos; at = path.find('/', at + 1)) {
        std::string const group = path.substr(0, at);
        if (H5Lexists(file, group.c_str(), H5P_DEFAULT) > 0) continue;
        Hdf5Handle const made(H5Gcreate2(file, group.c_str(), H5P_DEFAULT,
                                         group_properties(H5P_GROUP_CREATE).id(), H5P_DEFAULT),
                              H5Gclose, "make the group " + group);
    }
}

Hdf5Handle space_of(std::vector<hsize_t> const& extent) {
    return Hdf5Handle(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr), H5Sclose,
                      "make a data space");
}

/// Where values have checksums. An empty dataset has none and cannot be in chunks.
Hdf5Handle with_checksums(std::vector<hsize_t> extent, std::size_t size) {
    Hdf5Handle made = without_times(H5P_DATASET_CREATE);
    if (std::ranges::find(extent, 0U) != extent.end()) return made;
    if (extent.size() > 1) size *= extent.back();
    extent.front() = std::min<hsize_t>(extent.front(), std::max<std::size_t>(largest_chunk / size, 1));
    require(H5Pset_chunk(made.id(), static_cast<int>(extent.size()), extent.data()) >= 0 &&
                H5Pset_fletcher32(made.id()) >= 0,
            "ask for checksums");
    return made;
}

/// Writes an attribute of a file or dataset: one value, or a list of them.
void write_attribute(hid_t object, std::string const& name, Packed const& value, bool is_list) {
    Hdf5Handle const space =
        is_list ? space_of({value.count}) : Hdf5Handle(H5Screate(H5S_SCALAR), H5Sclose, "make a data space");
    Hdf5Handle const attribute(
        H5Acreate2(object, name.c_str(), value.type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
        "make the attribute " + name);
    require(H5Awrite(attribute.id(), value.type.id(), value.bytes.data()) >= 0,
            "write the attribute " + name);
}

void describe(Hdf5Handle const& dataset, std::vector<std::string> const& units,
              std::vector<std::string> const& descriptions, bool is_list) {
    write_attribute(dataset.id(), "units", pack_all(units), is_list);
    write_attribute(dataset.id(), "description", pack_all(descriptions), is_list);
}

Hdf5Handle write_dataset(hid_t file, std::string const& path, Packed const& values,
                         std::vector<hsize_t> const& extent) {
    make_groups(file, path);
    Hdf5Handle const properties = with_checksums(extent, values.size()), space = space_of(extent);
    Hdf5Handle data(H5Dcreate2(file, path.c_str(), values.type.id(), space.id(), H5P_DEFAULT, properties.id(),
                               H5P_DEFAULT),
                    H5Dclose, "make the dataset " + path);
    bool const is_written = values.bytes.empty() || H5Dwrite(data.id(), values.type.id(), H5S_ALL, H5S_ALL,
                                                             H5P_DEFAULT, values.bytes.data()) >= 0;
    require(is_written, "write the dataset " + path);
    return data;
}

/// The columns side by side, row by row.
Packed pack_rows(std::string const& path, std::vector<Hdf5Column> const& columns) {
    std::vector<Packed> packed;
    std::size_t row_size = 0;
    for (Hdf5Column const& column : columns) {
        packed.push_back(pack(column.values));
        require(packed.back().count == packed.front().count,
                "write " + path + ", its columns differ in length");
        row_size += packed.back().size();
    }
    std::size_t const rows = packed.at(0).count;
    Packed all{Hdf5Handle(H5Tcreate(H5T_COMPOUND, row_size), H5Tclose, "make the type of " + path),
               std::string(rows * row_size, '\0'), rows};
    std::size_t offset = 0;
    for (std::size_t c = 0; c < columns.size(); ++c) {
        std::string const name(columns[c].name);
        require(H5Tinsert(all.type.id(), name.c_str(), offset, packed[c].type.id()) >= 0,
                "add a column to " + path);
        std::size_t const size = packed[c].size();
        for (std::size_t row = 0; row < rows; ++row)
            std::memcpy(&all.bytes[row * row_size + offset], &packed[c].bytes[row * size], size);
        offset += size;
    }
    return all;
}

Hdf5Handle make_file(std::filesystem::path const& path) {
    Hdf5Handle const access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "make access properties");
    require(H5Pset_file_locking(access.id(), false, true) >= 0, "do without locks");
    // The headers of older formats have no checksum.
    require(H5Pset_libver_bounds(access.id(), H5F_LIBVER_V110, H5F_LIBVER_V110) >= 0, "choose the format");
    // Reserve no space, so that the file is only as long as what it holds.
    require(H5Pset_meta_block_size(access.id(), 0) >= 0 && H5Pset_small_data_block_size(access.id(), 0) >= 0,
            "switch off reserves");
    return Hdf5Handle(
        H5Fcreate(path.c_str(), H5F_ACC_TRUNC, group_properties(H5P_FILE_CREATE).id(), access.id()), H5Fclose,
        "make the file");
}

/// Some network disks have no locks, which files that are renamed into their place do not need.
Hdf5Handle open_file(std::filesystem::path const& path) {
    Hdf5Handle const access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "make access properties");
    require(H5Pset_file_locking(access.id(), false, true) >= 0, "do without locks");
    return Hdf5Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.id()), H5Fclose, "open it as HDF5");
}

Hdf5Handle open_attribute(hid_t file, std::string const& name, H5T_class_t kind) {
    Hdf5Handle attribute(H5Aopen(file, name.c_str(), H5P_DEFAULT), H5Aclose, "find the attribute " + name);
    Hdf5Handle const space(H5Aget_space(attribute.id()), H5Sclose, "read the shape of the attribute " + name);
    Hdf5Handle const type(H5Aget_type(attribute.id()), H5Tclose, "read the type of the attribute " + name);
    require(H5Tget_class(type.id()) == kind && H5Sget_simple_extent_npoints(space.id()) == 1 &&
                (kind != H5T_STRING || H5Tis_variable_str(type.id()) == 0),
            "use the attribute " + name + ", it has another type or shape");
    return attribute;
}

/// A text that ends at its first zero, or at its last byte.
std::string text_of(char const* bytes, std::size_t size) {
    return std::string(bytes, ::strnlen(bytes, size));
}

template <typename Number>
void read_value(char const* bytes, std::size_t /*size*/, Number& value) {
    std::memcpy(&value, bytes, sizeof value);
}

void read_value(char const* bytes, std::size_t size, std::string& value) {
    value = text_of(bytes, size);
}

/// Notes the path of a dataset. HDF5 calls it, so it must not throw.
herr_t note_dataset(hid_t, char const* name, H5O_info_t const* info, void* names) noexcept {
    if (info->type == H5O_TYPE_DATASET) static_cast<std::vector<std::string>*>(names)->emplace_back(name);
    return 0;
}

/// @return bytes
std::size_t size_of_regular(std::filesystem::path const& path) {
    std::error_code failure;
    bool const is_file = std::filesystem::is_regular_file(path, failure);
    auto const size = is_file ? std::filesystem::file_size(path, failure) : 0;
    if (is_file && !failure) return size;
    throw core::MissingError(
        fmt::format("cannot open {} (no such file, or not a regular one)", path.string()));
}

}  // namespace

Hdf5Error::Hdf5Error(std::string const& action)
    : std::runtime_error("cannot " + action), system_error_(errno) {}

Hdf5Handle::Hdf5Handle(hid_t id, Close closer, std::string const& action) : id_(id), close_(closer) {
    require(id >= 0, action);
}

Hdf5Handle::Hdf5Handle(Hdf5Handle&& other) noexcept
    : id_(std::exchange(other.id_, -1)), close_(other.close_) {}

Hdf5Handle::~Hdf5Handle() {
    if (id_ >= 0) close_(id_);
}

Hdf5Session::Hdf5Session() : lock_(one_at_a_time) {
    // HDF5 would try again in the end to write what a full disk has refused, and crash.
    static auto const never_at_exit = H5dont_atexit();
    static_cast<void>(never_at_exit);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Hdf5Writer::Hdf5Writer(std::filesystem::path const& path) : file_(make_file(path)) {}

void Hdf5Writer::attribute(std::string const& name, int value) {
    write_attribute(file_.id(), name, pack_all(std::vector{value}), false);
}

void Hdf5Writer::attribute(std::string const& name, std::string const& value) {
    write_attribute(file_.id(), name, pack_all(std::vector{value}), false);
}

void Hdf5Writer::dataset(std::string const& path, Values const& values, std::string_view units,
                         std::string_view description) {
    Packed const packed = pack(values);
    describe(write_dataset(file_.id(), path, packed, {packed.count}), {std::string(units)},
             {std::string(description)}, false);
}

void Hdf5Writer::grid(std::string const& path, Values const& values, std::size_t rows, std::size_t columns,
                      std::string_view units, std::string_view description) {
    Packed const packed = pack(values);
    require(packed.count == rows * columns, "write " + path + ", it has not rows times columns values");
    describe(write_dataset(file_.id(), path, packed, {rows, columns}), {std::string(units)},
             {std::string(description)}, false);
}

void Hdf5Writer::table(std::string const& path, std::vector<Hdf5Column> const& columns) {
    Packed const rows = pack_rows(path, columns);
    std::vector<std::string> units, descriptions;
    for (Hdf5Column const& column : columns) {
        units.emplace_back(column.units);
        descriptions.emplace_back(column.description);
    }
    describe(write_dataset(file_.id(), path, rows, {rows.count}), units, descriptions, true);
}

void Hdf5Writer::flush() {
    require(H5Fflush(file_.id(), H5F_SCOPE_GLOBAL) >= 0, "write the file");
}

void write_hdf5(std::filesystem::path const& path, std::function<void(Hdf5Writer&)> const& fill) {
    core::NewFile file(path);
    try {
        Hdf5Writer writer(file.temporary());
        fill(writer);
        writer.flush();
    } catch (Hdf5Error const& error) {
        errno = error.system_error();
        file.refuse();
    }
    file.finish(core::Sync::yes);
}

Hdf5Table::Hdf5Table(hid_t file, std::string const& path, std::size_t limit) : path_(path) {
    Hdf5Handle const data(H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose, "open the dataset " + path);
    Hdf5Handle const type(H5Dget_type(data.id()), H5Tclose, "read the type of " + path);
    Hdf5Handle const space(H5Dget_space(data.id()), H5Sclose, "read the shape of " + path);
    if (H5Tget_class(type.id()) != H5T_COMPOUND) {
        add_column(type.id(), "", 0);
    } else {
        for (int c = 0; c < H5Tget_nmembers(type.id()); ++c) {
            auto const index = static_cast<unsigned int>(c);
            char* const name = H5Tget_member_name(type.id(), index);
            Hdf5Handle const member(H5Tget_member_type(type.id(), index), H5Tclose,
                                    "read the columns of " + path);
            add_column(member.id(), name == nullptr ? "" : name, H5Tget_member_offset(type.id(), index));
            H5free_memory(name);
        }
    }
    rows_ = static_cast<std::size_t>(std::max<hssize_t>(H5Sget_simple_extent_npoints(space.id()), 0));
    row_size_ = std::max<std::size_t>(H5Tget_size(type.id()), 1);
    // Nothing is compressed, so a dataset cannot be larger than the file. Do not reserve memory for a wrong
    // size.
    require(rows_ <= limit / row_size_, "use the dataset " + path + ", it is larger than the file");
    bytes_.resize(rows_ * row_size_);
    require(H5Dread(data.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes_.data()) >= 0,
            "read the dataset " + path);
}

/// HDF5 would read other types than those that this program writes as addresses.
void Hdf5Table::add_column(hid_t type, std::string const& name, std::size_t offset) {
    Column const column{H5Tget_class(type), offset, H5Tget_size(type)};
    bool const is_known = (column.kind == H5T_INTEGER && H5Tequal(type, H5T_STD_I32LE) > 0) ||
                          (column.kind == H5T_FLOAT && H5Tequal(type, H5T_IEEE_F64LE) > 0) ||
                          (column.kind == H5T_STRING && H5Tis_variable_str(type) == 0);
    require(is_known, fmt::format("use {} of {}, it has another type", name, path_));
    columns_.emplace(name, column);
}

template <typename Value>
std::vector<Value> Hdf5Table::values(std::string const& name) const {
    auto const found = columns_.find(name);
    require(found != columns_.end(), fmt::format("find the column {} of {}", name, path_));
    Column const& column = found->second;
    constexpr auto kind = std::is_same_v<Value, int>      ? H5T_INTEGER
                          : std::is_same_v<Value, double> ? H5T_FLOAT
                                                          : H5T_STRING;
    require(column.kind == kind, fmt::format("use the column {} of {}, it has another type", name, path_));
    std::vector<Value> all(rows_);
    for (std::size_t row = 0; row < rows_; ++row)
        read_value(bytes_.data() + row * row_size_ + column.offset, column.size, all[row]);
    return all;
}

template std::vector<int> Hdf5Table::values(std::string const& name) const;
template std::vector<double> Hdf5Table::values(std::string const& name) const;
template std::vector<std::string> Hdf5Table::values(std::string const& name) const;

Hdf5Reader::Hdf5Reader(std::filesystem::path const& path)
    : size_(size_of_regular(path)), file_(open_file(path)) {}

std::optional<int> Hdf5Reader::whole_number(std::string const& name) const {
    auto const exists = H5Aexists(file_.id(), name.c_str());
    require(exists >= 0, "read the attributes");
    if (exists == 0) return {};
    int value = 0;
    require(H5Aread(open_attribute(file_.id(), name, H5T_INTEGER).id(), H5T_NATIVE_INT, &value) >= 0,
            "read the attribute " + name);
    return value;
}

std::string Hdf5Reader::text(std::string const& name) const {
    Hdf5Handle const attribute = open_attribute(file_.id(), name, H5T_STRING);
    std::string bytes(H5Aget_storage_size(attribute.id()), '\0');
    require(H5Aread(attribute.id(), text_type(bytes.size()).id(), bytes.data()) >= 0,
            "read the attribute " + name);
    return text_of(bytes.data(), bytes.size());
}

std::map<std::string, Hdf5Table> Hdf5Reader::read_all() const {
    std::vector<std::string> names;
    require(H5Ovisit2(file_.id(), H5_INDEX_NAME, H5_ITER_NATIVE, note_dataset, &names, H5O_INFO_BASIC) >= 0,
            "list what is in it");
    std::map<std::string, Hdf5Table> tables;
    for (std::string const& name : names) tables.emplace(name, Hdf5Table(file_.id(), name, size_));
    return tables;
}

}  // namespace vibrotrough::store
