#include "app/notebook.hpp"

#include <optional>
#include <sstream>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vibrotrough::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view fence = "```";

constexpr char const* shell_function = R"(import subprocess


def sh(commands, exit_code=0):
    """Runs commands of the shell, and shows what they print as it comes."""
    with subprocess.Popen("set -e\n" + commands, shell=True, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT) as process:
        for line in process.stdout:
            print(line, end="", flush=True)
    assert process.returncode == exit_code, f"exit code {process.returncode}"
)";

/// Lines as a notebook has them: each with its end, but the last.
Json source_of(std::string text) {
    while (text.ends_with('\n')) text.pop_back();
    Json lines = Json::array();
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(stream.eof() ? line : line + "\n");
    return lines;
}

class Notebook {
  public:
    void add_text(std::string& text) {
        std::size_t const begin = text.find_first_not_of('\n');
        if (begin != std::string::npos) add("markdown", text.substr(begin));
        text.clear();
    }

    /// @param info  what stands behind the fence
    void add_block(std::string const& info, std::string const& code) {
        if (info == "python") return add("code", code);
        if (!std::exchange(has_shell_, true)) add("code", shell_function);
        std::string const condition = info == "sh" ? "" : ", " + info.substr(info.find(' ') + 1);
        add("code", fmt::format("sh(r\"\"\"\n{}\"\"\"{})", code, condition));
    }

    std::string text() const {
        Json const notebook{
            {"cells", cells_},
            {"metadata",
             {{"kernelspec", {{"display_name", "Python 3"}, {"language", "python"}, {"name", "python3"}}},
              {"language_info", {{"name", "python"}}}}},
            {"nbformat", 4},
            {"nbformat_minor", 5}};
        return notebook.dump(1) + "\n";
    }

  private:
    void add(char const* type, std::string const& source) {
        Json cell{{"cell_type", type},
                  {"id", fmt::format("cell-{}", cells_.size() + 1)},
                  {"metadata", Json::object()}};
        if (std::string_view(type) == "code") {
            cell["execution_count"] = nullptr;
            cell["outputs"] = Json::array();
        }
        cell["source"] = source_of(source);
        cells_.push_back(cell);
    }

    Json cells_ = Json::array();
    bool has_shell_ = false;
};

}  // namespace

std::string notebook_of(std::string_view page) {
    Notebook notebook;
    std::string text, code;
    std::optional<std::string> info;  // of the block of code that a line is in
    bool is_shown = false;            // whether it is in a block that is text
    std::istringstream lines{std::string(page)};
    for (std::string line; std::getline(lines, line);) {
        bool const is_fence = line.starts_with(fence);
        std::string const behind = is_fence ? line.substr(fence.size()) : "";
        bool const begins_code =
            !is_shown && !info && (behind == "python" || behind == "sh" || behind.starts_with("sh "));
        if (begins_code) {
            notebook.add_text(text);
            info = behind;
        } else if (info && is_fence) {
            notebook.add_block(*std::exchange(info, {}), std::exchange(code, ""));
        } else {
            is_shown = is_shown != is_fence;
            (info ? code : text) += line + "\n";
        }
    }
    notebook.add_text(text);
    return notebook.text();
}

}  // namespace vibrotrough::app
