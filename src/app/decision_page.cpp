#include "app/decision_page.hpp"

#include "app/python.hpp"
#include "core/atomic_file.hpp"
#include "core/temporary_folder.hpp"
#include "core/time.hpp"
#include "core/version.hpp"

#include <filesystem>

#include <nlohmann/json.hpp>

namespace vibrotrough::app {

void write_decision_page(nlohmann::ordered_json data, std::string const& kind, std::string const& file,
                         std::string const& python) {
    data["kind"] = kind;
    data["made"] = {{"program_version", core::program_version()},
                    {"git_commit", core::program_commit()},
                    {"written", core::utc_now()}};
    core::TemporaryFolder const folder("vibrotrough-page");
    auto const path = folder.path() / "decision.json";
    core::write_file_atomically(path, data.dump());
    run_script("decision_page.py", {path.string(), "--output", std::filesystem::absolute(file).string()},
               python, {"numpy", "matplotlib", "jinja2"});
}

}  // namespace vibrotrough::app
