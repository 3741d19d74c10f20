#pragma once

namespace vibrotrough::app {

/// The exit codes of the program. Scripts rely on them.
enum ExitCode : int {
    all_well = 0,           ///< everything succeeded
    some_cases_failed = 1,  ///< the other cases are finished and kept
    wrong_input = 2,        ///< the command line or a file is wrong
    something_missing = 3,  ///< no engine, no disk space, or no permission
    internal_error = 70,    ///< an error in the program; please report it
    interrupted = 130,      ///< by Ctrl-C or another signal
};

}  // namespace vibrotrough::app
