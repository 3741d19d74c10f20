#pragma once

namespace vibrotrough::app {

/// The program's exit codes: a contract with scripts.
enum ExitCode : int {
    all_well = 0,
    some_cases_failed = 1,  ///< the rest are finished and kept
    wrong_input = 2,
    something_missing = 3,  ///< no engine, no disk, no permission
    internal_error = 70,    ///< a mistake of the program, please report it
    interrupted = 130,
};

}  // namespace vibrotrough::app
