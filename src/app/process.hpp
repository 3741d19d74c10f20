#pragma once

namespace vibrotrough::app {

/// Makes the process independent of how it was started, before it does anything else and before there is a
/// second thread. What is set here holds for all threads and for the programs that this one starts.
///
/// - Standard input, output and error are open, so that no file that is opened later takes the number of one
///   of them.
/// - The locale is C. No number that this program, LIGGGHTS or Python writes may have a decimal comma, paths
///   are bytes, and a locale that is not installed, as ssh brings it from another machine, is never asked
///   for.
/// - SIGCHLD arrives: a parent may have ignored or blocked it, and the end of an engine would not be noticed.
/// - A file beyond the limit of `ulimit -f` is an error that is reported, and not a silent end. Programs that
///   this one starts are ended by the signal.
void prepare_process();

}  // namespace vibrotrough::app
