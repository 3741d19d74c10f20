#pragma once

#include "app/commands.hpp"
#include "app/commands/common_options.hpp"
#include "app/commands/option_table.hpp"
#include "app/exit_code.hpp"
#include "app/json_list.hpp"
#include "app/standard_streams.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/shell.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

/// @file
/// What nearly every command needs: its declaration, options, files, errors, exit codes and printing.

namespace vibrotrough::app {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;  ///< members stay in the order in which they are made

}  // namespace vibrotrough::app
