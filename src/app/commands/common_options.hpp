#pragma once

#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace vibrotrough::app {

/// Help of the flag --accept-failed-probes.
inline constexpr char const* accept_failed_probes_help = "Run although the engine failed its probes";

/// Adds an option that takes a text. @param type  how the help calls it, such as FILE
void add_text(CLI::App& command, char const* name, std::string& value, std::string const& help,
              char const* type);
/// The same of one that may be left out.
void add_text(CLI::App& command, char const* name, std::optional<std::string>& value, std::string const& help,
              char const* type);

/// Adds an option that may be given several times.
void add_repeated(CLI::App& command, char const* name, std::vector<std::string>& values,
                  std::string const& help, char const* type);

/// Adds the required argument CAMPAIGN.toml.
void add_campaign_file(CLI::App& command, std::string& file);

/// Adds the required argument DIR, the folder of a campaign that was run.
void add_campaign_folder(CLI::App& command, std::string& folder);

/// Adds the option --output for the folder of a campaign's results.
void add_results_folder(CLI::App& command, std::string& folder);

/// Adds the option --liggghts for the path of the engine.
void add_engine(CLI::App& command, std::string& engine);

/// Adds the option --python for the path of a Python that has the modules, which are those of the figures
/// unless others are named.
void add_python(CLI::App& command, std::string& python,
                std::string const& modules = "numpy, h5py and matplotlib");

}  // namespace vibrotrough::app
