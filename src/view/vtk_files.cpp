#include "view/vtk_files.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"

#include <fmt/format.h>
#include <vtkAlgorithm.h>
#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkExecutive.h>
#include <vtkSTLReader.h>
#include <vtkXMLPolyDataWriter.h>

namespace vibrotrough::view {
namespace {

/// Stores the first error message of a VTK reader or writer, which VTK would otherwise print.
class ErrorWatch {
  public:
    explicit ErrorWatch(vtkAlgorithm& watched) {
        command_->SetClientData(&message_);
        command_->SetCallback([](vtkObject*, unsigned long, void* kept, void* text) {
            std::string message = text == nullptr ? "" : static_cast<char const*>(text);
            while (!message.empty() && message.back() == '\n') message.pop_back();
            auto& first = *static_cast<std::string*>(kept);  // later messages are consequences
            if (first.empty()) first = message.substr(message.rfind('\n') + 1);
        });
        watched.AddObserver(vtkCommand::ErrorEvent, command_);
        watched.GetExecutive()->AddObserver(vtkCommand::ErrorEvent, command_);
    }
    std::string const& message() const { return message_; }

  private:
    std::string message_;
    vtkNew<vtkCallbackCommand> command_;
};

}  // namespace

vtkSmartPointer<vtkPolyData> read_stl(std::filesystem::path const& path) {
    core::read_file(path);  // its error message says why the file cannot be read
    vtkNew<vtkSTLReader> reader;
    ErrorWatch const errors(*reader);
    reader->SetFileName(path.c_str());
    reader->Update();
    if (!errors.message().empty() || reader->GetOutput()->GetNumberOfCells() == 0) {
        throw core::InputError(
            fmt::format("{} is not an STL mesh ({}); run the case again", path.string(),
                        errors.message().empty() ? "it does not contain triangles" : errors.message()));
    }
    return reader->GetOutput();
}

void write_vtp(std::filesystem::path const& path, vtkPolyData& data) {
    vtkNew<vtkXMLPolyDataWriter> writer;
    ErrorWatch const errors(*writer);
    writer->SetInputData(&data);
    writer->SetDataModeToBinary();
    writer->SetCompressorTypeToZLib();
    writer->SetCompressionLevel(1);
    writer->WriteToOutputStringOn();
    if (writer->Write() == 0 || !errors.message().empty()) {
        throw core::MissingError(fmt::format("cannot write {} (VTK: {})", path.string(), errors.message()));
    }
    // Unlike a result, a frame is not synced to disk, because it can be exported again.
    core::replace_file(path, writer->GetOutputString());
}

void write_collection(std::filesystem::path const& path, std::vector<CollectionEntry> const& entries) {
    std::string text =
        "<?xml version=\"1.0\"?>\n"
        "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
        "  <Collection>\n";
    for (CollectionEntry const& entry : entries) {
        text +=
            fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", entry.time, entry.file);
    }
    core::write_file_atomically(path, text + "  </Collection>\n</VTKFile>\n");
}

}  // namespace vibrotrough::view
