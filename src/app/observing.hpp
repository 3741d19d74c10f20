#pragma once

#include "campaign/state/plan.hpp"
#include "store/observable.hpp"

#include <string>
#include <vector>

namespace vibrotrough::app {

/// A file with functions of Python that the person has allowed to run: the very text that is run is the one
/// that is stored.
struct ObservableSource {
    std::string file;    ///< absolute path
    std::string text;    ///< of it
    std::string sha256;  ///< of the text
};

/// The observables that ship with the program.
/// @throws core::MissingError when they are not installed
ObservableSource shipped_observables();

/// A file that a person has written.
/// @param allowed  the file that --allow-python names; empty when it was not given
/// @throws core::InputError when they are not the same file, or the text is not UTF-8
ObservableSource read_observable_source(std::string const& file, std::string const& allowed);

/// What became of an observable.
struct Observed {
    store::Observable observable;  ///< with the cases in which it was measured
    std::string missing = {};      ///< what no packing has that it needs; empty when it was measured
    std::vector<std::string> left_out = {};  ///< ids of the cases without a value
};

/// What was measured, or the exit code of Python, which has then said why.
struct Observing {
    int exit_code = 0;                    ///< of Python
    std::vector<Observed> observed = {};  ///< in the order of the file
};

/// Calls the functions with the packings of all cases that have a result, and makes means with intervals.
/// @param only    names of the functions that are wanted; empty: all
/// @param python  path of the Python to use; empty: see run_script()
/// @throws core::InputError when no case has a result, or a function has a name or a unit that it cannot have
/// @throws core::MissingError when there is no Python
Observing observe(campaign::Plan const& plan, ObservableSource const& source,
                  std::vector<std::string> const& only, std::string const& python);

}  // namespace vibrotrough::app
