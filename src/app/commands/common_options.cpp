#include "app/commands/common_options.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace vibrotrough::app {

void add_campaign_file(CLI::App& command, std::string& file) {
    command.add_option("CAMPAIGN.toml", file, "The campaign file; 'vibrotrough keys' lists its keys")
        ->required();
}

void add_campaign_folder(CLI::App& command, std::string& folder) {
    command.add_option("DIR", folder, "Folder of the campaign's results, as given to run --output")
        ->required();
}

void add_results_folder(CLI::App& command, std::string& folder) {
    command.add_option("--output", folder, "Folder of the campaign's results; default runs/<name>")
        ->type_name("DIR");
}

void add_engine(CLI::App& command, std::string& engine) {
    command.add_option("--liggghts", engine, "The LIGGGHTS program; default: liggghts on the PATH")
        ->type_name("PATH");
}

void add_python(CLI::App& command, std::string& python, std::string const& modules) {
    command
        .add_option(
            "--python", python,
            fmt::format("Python with {}; default: /usr/bin/python3, else python3 on the PATH", modules))
        ->type_name("PATH");
}

}  // namespace vibrotrough::app
