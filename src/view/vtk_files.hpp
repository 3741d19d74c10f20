#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

/// The files that this module reads and writes with VTK.
namespace vibrotrough::view {

/// Reads an STL file, ASCII or binary. @throws InputError if it does not contain triangles; MissingError if
/// it cannot be read
vtkSmartPointer<vtkPolyData> read_stl(std::filesystem::path const& path);

/// Writes a .vtp file, inline binary and zlib-compressed, under a temporary name and renames it. Appended
/// data must not be used: Debian's ParaView 5.11 reads them as an empty scene without an error.
/// @throws MissingError when the disk refuses
void write_vtp(std::filesystem::path const& path, vtkPolyData& data);

/// A file of a collection.
struct CollectionEntry {
    double time;       ///< s
    std::string file;  ///< relative to the collection
};

/// Writes a .pvd collection atomically. @throws MissingError when it cannot be written
void write_collection(std::filesystem::path const& path, std::vector<CollectionEntry> const& entries);

}  // namespace vibrotrough::view
