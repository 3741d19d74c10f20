#include "app/commands/common_options.hpp"

#include "app/commands/command.hpp"

namespace vibrotrough::app {

void add_text(CLI::App& command, char const* name, std::string& value, std::string const& help,
              char const* type) {
    command.add_option(name, value, help)->type_name(type);
}

void add_text(CLI::App& command, char const* name, std::optional<std::string>& value, std::string const& help,
              char const* type) {
    command.add_option(name, value, help)->type_name(type);
}

void add_repeated(CLI::App& command, char const* name, std::vector<std::string>& values,
                  std::string const& help, char const* type) {
    command.add_option(name, values, help)
        ->type_name(type)
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void add_campaign_file(CLI::App& command, std::string& file) {
    command.add_option("CAMPAIGN.toml", file, "The campaign file; 'vibrotrough keys' lists its keys")
        ->required();
}

void add_campaign_folder(CLI::App& command, std::string& folder) {
    command.add_option("DIR", folder, "Folder of the campaign's results, as given to run --output")
        ->required();
}

void add_results_folder(CLI::App& command, std::string& folder) {
    add_text(command, "--output", folder, "Folder of the campaign's results; default runs/<name>", "DIR");
}

void add_engine(CLI::App& command, std::string& engine) {
    add_text(command, "--liggghts", engine, "The LIGGGHTS program; default: liggghts on the PATH", "PATH");
}

void add_python(CLI::App& command, std::string& python, std::string const& modules) {
    add_text(command, "--python", python,
             fmt::format("Python with {}; default: /usr/bin/python3, else python3 on the PATH", modules),
             "PATH");
}

}  // namespace vibrotrough::app
