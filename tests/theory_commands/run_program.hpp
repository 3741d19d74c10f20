#pragma once

#include <array>
#include <cstdio>
#include <stdexcept>
#include <string>

#include <sys/wait.h>

namespace vibrotrough {

struct Answer {
    int exit_code;
    std::string text;  ///< what was printed on standard output and standard error
};

enum class StandardError { together, dropped };

/// Runs the program that was built, through the shell.
inline Answer run_program(std::string const& arguments, StandardError error = StandardError::together) {
    std::string const line = std::string("'") + VIBROTROUGH_PROGRAM + "' " + arguments +
                             (error == StandardError::together ? " 2>&1" : " 2>/dev/null");
    std::FILE* const pipe = popen(line.c_str(), "r");
    if (pipe == nullptr) throw std::runtime_error("cannot start " + line);
    Answer answer{};
    std::array<char, 4096> buffer;
    for (std::size_t n = 0; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) {
        answer.text.append(buffer.data(), n);
    }
    int const status = pclose(pipe);
    answer.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return answer;
}

}  // namespace vibrotrough
