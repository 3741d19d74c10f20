#pragma once

namespace vibrotrough::app {

/// The exit codes of the program. Scripts rely on them.
enum ExitCode : int {
    all_well = 0,           ///< everything succeeded
    some_cases_failed = 1,  ///< the other cases are finished and kept; or what was asked for was not reached
    wrong_input = 2,        ///< the command line or a file is wrong
    something_missing = 3,  ///< no engine, no disk space, or no permission
    internal_error = 70,    ///< an error in the program; please report it
    interrupted = 130,      ///< by Ctrl-C or another signal
};

/// What they mean, for the help.
inline constexpr char const* exit_codes_help = R"(Exit codes of all commands:
    0  everything succeeded
    1  some cases failed, or were not precise, not steady, or bistable or slow; the rest is kept.
       Or what was asked for was not reached: a mass runs away, a machine or a surface is not as
       sure as it should be, chains have not converged, a validation case did not pass
    2  the input is wrong
    3  something is missing: LIGGGHTS, or it failed its probes; Python with its modules; disk space;
       or another driver works in the folder
   70  an error in the program; please report it
  130  interrupted)";

}  // namespace vibrotrough::app
