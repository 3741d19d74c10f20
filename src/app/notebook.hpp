#pragma once

#include <string>
#include <string_view>

namespace vibrotrough::app {

/// A Markdown page as a Jupyter notebook for Python (nbformat 4.5): its fenced blocks of `sh` and `python`
/// are code, all else is text. A block of `sh` becomes a call of a function that the notebook defines before
/// its first block. It demands exit code 0, or what stands behind the language, as in "sh exit_code=1".
std::string notebook_of(std::string_view page);

}  // namespace vibrotrough::app
