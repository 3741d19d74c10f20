#pragma once

#include "core/error.hpp"
#include "core/temporary_folder.hpp"
#include "view/frames.hpp"

#include <filesystem>
#include <string>
#include <utility>

#include <gtest/gtest.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkXMLPolyDataReader.h>

namespace vibrotrough::view {

/// Frames of a real run, copied so that a test may damage them, and the folder to which they are exported.
class FrameExport : public testing::Test {
  protected:
    /// @param data    the folder with the frames and the trough's mesh
    /// @param values  what else is known of the run; its folder and mesh are set here
    FrameExport(std::filesystem::path const& data, FrameSource values) : source(std::move(values)) {
        source.folder = own_folder.path() / "dump";
        std::filesystem::copy(data, source.folder);
        source.trough = {source.folder / "trough.stl"};
    }

    /// An exported file, as VTK reads it.
    vtkSmartPointer<vtkPolyData> read(std::string const& file) const {
        auto reader = vtkSmartPointer<vtkXMLPolyDataReader>::New();
        reader->SetFileName((target / file).c_str());
        reader->Update();
        return reader->GetOutput();
    }

    /// What the export says of the frames when it refuses them.
    std::string refusal() const {
        try {
            export_frames(source, target);
        } catch (core::InputError const& error) {
            return error.what();
        }
        return "no error";
    }

    core::TemporaryFolder const own_folder;
    std::filesystem::path target = own_folder.path() / "target";
    FrameSource source;
};

}  // namespace vibrotrough::view
