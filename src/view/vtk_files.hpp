#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

/// What this room writes and reads through VTK.
namespace vibrotrough::view {

/// Reads an STL file, ASCII or binary. @throws InputError when it holds no triangle; MissingError when
/// unreadable
vtkSmartPointer<vtkPolyData> read_stl(std::filesystem::path const& path);

/// Writes a .vtp file, inline binary and zlib-compressed, under a temporary name and renames it.
/// Never appended data: Debian's ParaView 5.11 reads it as an empty scene, without an error.
/// @throws MissingError when the disk refuses
void write_vtp(std::filesystem::path const& path, vtkPolyData& data);

/// One file of a collection.
struct CollectionEntry {
    double time;       ///< s
    std::string file;  ///< relative to the collection
};

/// Writes a .pvd collection, atomically. @throws MissingError when the disk refuses
void write_collection(std::filesystem::path const& path, std::vector<CollectionEntry> const& entries);

}  // namespace vibrotrough::view
