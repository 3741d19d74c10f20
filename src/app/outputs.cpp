#include "app/outputs.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"

#include <fstream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace vibrotrough::app {
namespace {

namespace fs = std::filesystem;

/// Within these bytes every file of this program has its mark: behind the first objects of an HDF5 file, and
/// behind the drawing of a PDF.
constexpr std::size_t head_size = std::size_t{1} << 20;

/// Whether something would be lost. An empty file, such as mktemp makes, holds nothing.
bool holds_something(fs::path const& file) {
    std::error_code failure;
    return fs::is_regular_file(file, failure) && fs::file_size(file, failure) > 0;
}

std::string head_of(fs::path const& file) {
    std::string head(head_size, '\0');
    std::ifstream stream(file, std::ios::binary);
    stream.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(stream.gcount()));
    return head;
}

}  // namespace

void Outputs::add_to(CLI::App& command) {
    command.add_flag("--force", force, "Replace a file that this program did not write");
}

void Outputs::refuse_inputs(std::string const& option, fs::path const& file) const {
    std::error_code failure;
    for (fs::path const& input : inputs)
        if (holds_something(file) && fs::equivalent(input, file, failure))
            throw core::InputError(
                fmt::format("{} {}: this command reads this file and would replace it; choose another name",
                            option, file.string()));
}

void Outputs::check(std::string const& option, fs::path const& file, std::string_view mark) const {
    refuse_inputs(option, file);
    if (force || !holds_something(file) || head_of(file).find(mark) != std::string::npos) return;
    throw core::InputError(
        fmt::format("{} {}: this file is there already, and this program did not write it; choose another "
                    "name, or replace it with --force",
                    option, file.string()));
}

void Outputs::write_editable(std::string const& option, fs::path const& file,
                             std::string_view content) const {
    refuse_inputs(option, file);
    if (!force && holds_something(file) && core::read_file(file) != content)
        throw core::InputError(
            fmt::format("{} {}: this file is there already and has another content, which you may have "
                        "edited; choose another name, or replace it with --force",
                        option, file.string()));
    core::write_file_atomically(file, content);
}

}  // namespace vibrotrough::app
