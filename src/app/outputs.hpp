#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace vibrotrough::app {

/// By which a page for browsers that this program wrote is recognised.
inline constexpr std::string_view page_mark = "Vibrotrough</title>";

/// The rule for files that a person names as outputs: one that this program did not write is replaced only
/// with --force, and one that the command reads is never replaced.
struct Outputs {
    bool force = false;                         ///< --force was given
    std::vector<std::filesystem::path> inputs;  ///< files that the command reads

    /// Adds the option --force.
    void add_to(CLI::App& command);
    /// Call it before the work begins.
    /// @param mark  words near the begin of every such file of this program
    /// @throws core::InputError when the file must not be replaced
    void check(std::string const& option, std::filesystem::path const& file, std::string_view mark) const;
    /// Writes a file that people edit once it is written: one with any other content is not replaced.
    /// @throws core::InputError when there is one, core::MissingError when the file cannot be written
    void write_editable(std::string const& option, std::filesystem::path const& file,
                        std::string_view content) const;

  private:
    void refuse_inputs(std::string const& option, std::filesystem::path const& file) const;
};

}  // namespace vibrotrough::app
